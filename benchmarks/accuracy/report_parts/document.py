# SPDX-License-Identifier: GPL-3.0-or-later
"""The document: prose around figures that are all taken from the tables."""
from . import tables
from .tables import mean, number, numbers

HEAD = """# How accurate, and at what price

*Written by `benchmarks/accuracy/report` from the tables in `benchmarks/accuracy/`; change those or the script, not this page.
`benchmarks/accuracy/run BUILD-FOLDER` measures everything anew and writes this page.*

A mannequin dressed by Vitrine is the result of a calculation that can be made coarsely in a moment or finely in a long while.
This page says what the time buys: by how many millimetres the cloth lies somewhere else than it would after all the
computing that is worth doing. It also says what is not promised.
"""


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    lines += ["| " + " | ".join(str(c).replace("|", "/") for c in row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def figure(value, form="{:.2f}"):
    return "-" if value is None else form.format(value)


def machine(data):
    m = data["machine"]
    if not m:
        return "What machine the figures come from was not written down.\n"
    return (f"Measured on {m.get('date')} with Vitrine {m.get('version')} ({m.get('compiler')}, build {m.get('build')}) on a machine with "
            f"{m.get('cores')} cores ({m.get('processor')}) and {m.get('memory_gb')} GB. Times are seconds of a processor, which "
            "other programs on the machine change by up to a fifth.\n")


def bars(data):
    word = {True: "met", False: "**missed**", None: "not measured"}
    found = tables.all_bars(data)
    missed = sum(b["met"] is False for b in found)
    unknown = sum(b["met"] is None for b in found)
    text = f"## What was asked, and what came out\n\n{sum(b['met'] is True for b in found)} met, {missed} missed, {unknown} not measured.\n\n"
    wanted = tables.ITEMS_WANTED
    known = sum(number(r["mean_mm"]) is not None for r in tables.runs_of(data, "standard"))
    if 0 < known < wanted:
        text += f"The errors below are those of {known} items; the bars ask for {wanted}, so their verdicts may still turn.\n\n"
    return text + table(("figure", "bar", "measured", ""),
                        [(b["what"], b["bar"], b["figure"], word[b["met"]]) for b in found])


def trade(data, plots):
    if not data["runs"]:
        return ""
    rows = []
    for quality in tables.QUALITIES:
        own = tables.runs_of(data, quality)
        known = [r for r in own if number(r["mean_mm"]) is not None]
        if own:
            average = lambda column: mean(numbers(known, column))  # noqa: E731
            rows.append((quality, len(known), figure(average("nodes"), "{:.0f}"),
                         figure(average("cpu_ms") and average("cpu_ms") / 1000) + " s", figure(average("mean_mm")),
                         figure(average("p95_mm"), "{:.1f}"), figure(average("hem_mm"), "{:.1f}"),
                         figure(average("waist_mm"), "{:.1f}"), figure(average("chest_mm"), "{:.1f}"),
                         figure(average("peak_mb"), "{:.0f}")))
    spread = mean(numbers(tables.runs_of(data, "fine"), "spread_mm"))
    text = """## Draft, standard, fine

Draft is for checking photos and sizes, standard for the shop, fine for a close look at single pieces. The reference is a mesh
finer still, balanced until nothing moves. *mean* is how far the cloth lies from there on average, *p95* what nineteen of twenty
places stay below; hem, waist and chest are the differences that a tape measure would find.

"""
    text += table(("quality", "items", "nodes", "time", "mean mm", "p95 mm", "hem mm", "waist mm", "chest mm", "memory MB"), rows)
    if spread is not None:
        text += (f"\nCloth has more than one way to lie: the reference itself, reached from two starts, differs by {spread:.2f} mm on the "
                 "mean. Below that there is nothing left to buy.\n")
    if "accuracy-trade.svg" in plots:
        text += "\n![Error over processor time, item by item](accuracy-trade.svg)\n"
    return text + knobs(data)


def knobs(data):
    names = []
    for row in data["runs"]:
        if row["knob"] and row["setting"] not in names:
            names.append(row["setting"])
    standard = tables.by_item(tables.runs_of(data, "standard"), "mean_mm")
    cost = tables.by_item(tables.runs_of(data, "standard"), "cpu_ms")
    rows = []
    for name in names:
        error, time = (tables.by_item(tables.runs_of(data, name), c) for c in ("mean_mm", "cpu_ms"))
        common = sorted(set(error) & set(standard) & set(time) & set(cost))
        if common:
            rows.append((name, len(common), figure(mean([error[i] for i in common])), figure(mean([standard[i] for i in common])),
                         figure(sum(time[i] for i in common) / sum(cost[i] for i in common), "{:.2f} x")))
    if not rows:
        return ""
    return ("\n### Turning one knob at a time\n\nStandard quality with a single setting changed; the same items on both sides.\n\n"
            + table(("setting", "items", "mean mm", "standard's mean mm", "time"), rows))


def estimate(data):
    rows = []
    for quality in tables.QUALITIES:
        pairs = [(number(r["estimate_mm"]), number(r["mean_mm"])) for r in tables.runs_of(data, quality)]
        ratios = sorted(e / t for e, t in pairs if e is not None and t)
        if ratios:
            rows.append((quality, len(ratios), figure(ratios[0]), figure(ratios[len(ratios) // 2]), figure(ratios[-1])))
    if not rows:
        return ""
    return ("## Does the program know how wrong it is?\n\nEvery report states an estimated error. Here it is divided by the true one: 1 is right, "
            "2 is twice too careful, 0.5 promises twice too much.\n\n"
            + table(("quality", "items", "least", "median", "largest"), rows))


def budget(data):
    rows = [r for r in data["budget"] or [] if number(r["asked_mm"]) is not None]
    if not rows:
        return ""
    rows = [(r["item"], r["asked_mm"], figure(number(r["estimated_mm"])), figure(number(r["true_mm"])), r["met"],
             figure(number(r["cpu_ms"]) and number(r["cpu_ms"]) / 1000) + " s",
             figure(number(r["fine_cpu_ms"]) and number(r["fine_cpu_ms"]) / 1000) + " s") for r in rows]
    return ("## Asking for millimetres\n\n`--max-error` names the error that may be left; the program chooses how much to compute.\n\n"
            + table(("item", "asked mm", "estimated mm", "true mm", "met", "time", "time at fine"), rows))


def effects(data):
    found = tables.effects_of(data)
    if not found:
        return ""
    rows = [(name, items, figure(change), figure(worst), figure(extra, "{:.0f}")) for name, items, change, worst, extra in found]
    return ("## What is left out, and what that changes\n\nOnly what a scene requires is modelled. Each effect that was left out was turned on "
            "for comparison: how far the cloth moved, and what it cost.\n\n"
            + table(("effect", "items", "mean change mm", "worst item mm", "extra ms"), rows))


def fidelity(data, plots):
    rows = [r for r in data["fidelity"] or [] if number(r["iou"]) is not None]
    refused = [f"{r['item']} ({r['status']})" for r in data["fidelity"] or [] if number(r["iou"]) is None]
    if not rows:
        return ""
    text = f"""## Does the dressed garment look like the photo?

The garment is seen from the front, as the camera saw it on the table, and its silhouette laid over the photo's. The share of their
common area in the area that either covers (IoU) is 1 where they are the same. Sleeves are left out, as arms and boards hold them
differently. Cloth that goes around a body shows less of its width than cloth on a table, so width and height are scaled apart, one
figure each for the whole garment: the width seen is {mean(numbers(rows, "width")):.2f} of the flat one on the mean, the height {mean(numbers(rows, "height")):.2f}. And the photo is posed as the
mannequin: the camera is turned by up to six degrees, as many garments lie or hang a little askew (*turned*), and legs are swung until their
hems are as far apart as the worn ones. Nothing else is fitted. Without that pose the mean is {mean(numbers(rows, "iou")):.3f} (*as it lies*), with one scale for both
{mean(numbers(rows, "iou_uniform")):.3f}, at the photo's own size {mean(numbers(rows, "iou_true_size")):.3f}: so much is the going round. *by hand* takes the silhouette that a person marked in place of the one the program
found. *points* is how far shoulders, armpits, waist, hem and neckline lie from where the fitted photo has them.

What remains is mostly that one figure for the width cannot be right for the whole of a garment: straps and shoulders lie open and
show their full width, while everything below the armpits goes round.

"""
    text += table(("item", "garment", "status", "IoU", "by hand", "turned", "as it lies", "one scale", "true size", "points mm"),
                  [(r["item"], r["garment"], r["status"])
                   + tuple(figure(number(r[c]), "{:.3f}") for c in ("iou_posed", "iou_marked"))
                   + (figure(number(r["turn_deg"]), "{:.1f}°"),)
                   + tuple(figure(number(r[c]), "{:.3f}") for c in ("iou", "iou_uniform", "iou_true_size"))
                   + (figure(number(r["landmark_mean_mm"]), "{:.0f}"),) for r in rows])
    if refused:
        text += f"\nRefused before they were dressed, and in no mean: {', '.join(refused)}.\n"
    if "accuracy-fidelity.svg" in plots:
        text += "\n![Silhouettes of the dressed garments against the photos](accuracy-fidelity.svg)\n"
    return text


def extremes(data, plots):
    rows = data["extremes"] or []
    if not rows:
        return ""
    groups = list(dict.fromkeys(r["group"] for r in rows))
    summary = []
    for group in groups:
        own = [r for r in rows if r["group"] == group]
        good = [r for r in own if tables.sound(r)]
        refused = sum(r["finite"] == "" for r in good)
        rested = sum(r["status_or_code"] == "OK" for r in good)
        summary.append((group, len(own), rested, len(good) - refused - rested, refused, len(own) - len(good)))
    text = """## At the extremes

Constants, meshes, bodies and photos that nobody means, on purpose. Each case runs in a process of its own and has to end in a result
that can be believed, in a status that says what is wrong with it, or in a refusal that says why. A crash, a figure that is none or a
run without end would be a bug.

"""
    text += table(("group", "cases", "at rest", "a status that names what is wrong", "refused", "bugs"), summary)
    if "accuracy-constants.svg" in plots:
        text += "\n![What became of each pair of k and m](accuracy-constants.svg)\n"
    text += "\n<details><summary>Every case</summary>\n\n"
    text += table(("group", "case", "status or code", "residual", "inside mm", "ms"),
                  [(r["group"], r["case"], r["status_or_code"], r["residual"], r["penetration_mm"], r["cpu_ms"]) for r in rows])
    return text + "\n</details>\n"


def write(data, plots):
    parts = [HEAD, machine(data), bars(data), trade(data, plots), estimate(data), budget(data), effects(data),
             fidelity(data, plots), extremes(data, plots)]
    return "\n".join(part for part in parts if part)
