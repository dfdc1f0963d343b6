# SPDX-License-Identifier: GPL-3.0-or-later
"""The tables of a measurement, and the bars that they are held to."""
import csv
import json
import math
import statistics

QUALITIES = ("draft", "standard", "fine")
ITEMS_WANTED = 24  # twelve real ones, twelve generated
COLUMNS = {
    "runs": ("item", "source", "garment", "setting", "knob", "value", "nodes", "cpu_ms", "status", "mean_mm", "p95_mm",
             "max_mm", "hem_mm", "waist_mm", "chest_mm", "estimate_mm", "spread_mm", "peak_mb"),
    "effects": ("item", "effect", "reason", "change_mean_mm", "change_max_mm", "extra_ms"),
    "budget": ("item", "asked_mm", "estimated_mm", "true_mm", "cpu_ms", "fine_cpu_ms", "met"),
    "extremes": ("group", "case", "status_or_code", "residual", "penetration_mm", "finite", "cpu_ms", "note"),
    "fidelity": ("item", "garment", "status", "iou_posed", "turn_deg", "leg_swing", "iou", "iou_marked", "iou_uniform", "iou_true_size", "width", "height",
                 "landmark_mean_mm"),
}
MACHINE = ("date", "processor", "cores", "memory_gb", "compiler", "build", "version")
BROKEN = {"", "CRASH", "CPU_LIMIT", "NO_ANSWER", "EXCEPTION", "DIFFERS"}


class TableError(Exception):
    """A table that cannot be read, with its name and the cause."""


def number(text):
    """A finite number, or None where the cell is empty or none."""
    try:
        value = float(text)
    except (TypeError, ValueError):
        return None
    return value if math.isfinite(value) else None


def read(folder):
    """Each table as a list of rows (None where there is no such file), and the machine."""
    data = {}
    for name, columns in COLUMNS.items():
        path = folder / f"{name}.csv"
        data[name] = None
        if not path.exists():
            continue
        with path.open(encoding="utf-8", newline="") as file:
            reader = csv.DictReader(file)
            missing = [c for c in columns if c not in (reader.fieldnames or ())]
            if missing:
                raise TableError(f"{path} lacks the columns {', '.join(missing)}; measure again")
            data[name] = list(reader)
    path = folder / "machine.json"
    try:
        data["machine"] = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}
    except json.JSONDecodeError as error:
        raise TableError(f"{path}: {error}; write it with benchmarks/accuracy/machine") from error
    return data


def numbers(rows, column):
    return [v for v in (number(r[column]) for r in rows) if v is not None]


def mean(values):
    return statistics.fmean(values) if values else None


def runs_of(data, setting):
    return [r for r in data["runs"] or [] if r["setting"] == setting]


def by_item(rows, column):
    return {r["item"]: number(r[column]) for r in rows if number(r[column]) is not None}


def sound(row):
    """A case of the extremes that ended as it should: believable, named, or refused."""
    if row["status_or_code"] in BROKEN or row["finite"] == "0":
        return False
    depth = number(row["penetration_mm"])
    return row["status_or_code"] != "OK" or depth is None or depth <= 0.5


def bar(what, bar_text, figure, met):
    return {"what": what, "bar": bar_text, "figure": figure, "met": met}


def share(part, whole):
    return f"{part} of {whole} ({100 * part / whole:.0f} %)" if whole else "none"


def error_bars(data):
    """Error against the reference, by quality."""
    errors = {q: by_item(runs_of(data, q), "mean_mm") for q in QUALITIES}
    spread = by_item(runs_of(data, "fine"), "spread_mm")
    common = sorted(set.intersection(*(set(e) for e in errors.values())))
    bars = []
    falling = [i for i in common if errors["draft"][i] > errors["standard"][i] > errors["fine"][i]]
    means = [mean([errors[q][i] for i in common]) for q in QUALITIES]
    if common:
        bars.append(bar("error against the reference, mean of all items", "falls draft → standard → fine",
                        " → ".join(f"{m:.2f}" for m in means) + " mm", means[0] > means[1] > means[2]))
        bars.append(bar("the same item by item", "falls for every item", share(len(falling), len(common)),
                        len(falling) == len(common)))
    for quality, limit in (("standard", 4), ("draft", 10)):
        values = list(errors[quality].values())
        if values:
            bars.append(bar(f"{quality}: mean error", f"≤ {limit} mm", f"{mean(values):.2f} mm; half of the items "
                            f"below {statistics.median(values):.2f}, worst {max(values):.2f} mm", mean(values) <= limit))
    known = [i for i in errors["fine"] if i in spread]
    if known:
        within = [i for i in known if errors["fine"][i] <= spread[i]]
        fine, floor = mean([errors["fine"][i] for i in known]), mean([spread[i] for i in known])
        bars.append(bar("fine: mean error", "within the spread of equally converged ways to rest",
                        f"{fine:.2f} mm; spread {floor:.2f} mm; within it {share(len(within), len(known))}",
                        fine <= floor))
    return bars


def estimate_bar(data):
    pairs = [(number(r["estimate_mm"]), number(r["mean_mm"])) for q in QUALITIES for r in runs_of(data, q)]
    pairs = [(e, t) for e, t in pairs if e is not None and t]
    if not pairs:
        return []
    near = sum(0.5 <= e / t <= 2 for e, t in pairs)
    below = sum(e < t / 2 for e, t in pairs)
    return [bar("the estimate against the true error", "within a factor of 2 for ≥ 90 %", share(near, len(pairs)),
                near >= 0.9 * len(pairs)),
            bar("the estimate below half of the true error", "never", share(below, len(pairs)), below == 0)]


def budget_bars(data):
    rows = [r for r in data["budget"] or [] if number(r["asked_mm"]) is not None]
    if not rows:
        return []
    met = sum((number(r["true_mm"]) or math.inf) <= number(r["asked_mm"]) for r in rows)
    spent, fine = sum(numbers(rows, "cpu_ms")), sum(numbers(rows, "fine_cpu_ms"))
    asked = ", ".join(f"{v:g}" for v in sorted(set(numbers(rows, "asked_mm"))))
    bars = [bar(f"--max-error {asked}", "met on ≥ 95 % of the items", share(met, len(rows)), met >= 0.95 * len(rows))]
    if fine > 0:
        bars.append(bar(f"--max-error {asked}: processor time", "≤ 1/3 of all at fine", f"{spent / fine:.2f} of it",
                        spent <= fine / 3))
    return bars


def effects_of(data):
    """Per effect: name, items, mean and largest change, extra ms; only effects that could be turned on."""
    found = []
    for name in sorted({r["effect"] for r in data["effects"] or []}):
        rows = [r for r in data["effects"] if r["effect"] == name and number(r["change_mean_mm"]) is not None]
        if rows:
            changes = numbers(rows, "change_mean_mm")
            found.append((name, len(rows), mean(changes), max(changes), mean(numbers(rows, "extra_ms"))))
    return found


def effect_bars(data):
    return [bar(f"skipped: {name}", "would change ≤ 0.5 mm mean", f"{change:.2f} mm, worst item {worst:.2f} mm",
                change <= 0.5) for name, _, change, worst, _ in effects_of(data)]


def fidelity_bar(data):
    values = numbers(data["fidelity"] or [], "iou_posed")
    if not values:
        return []
    return [bar("real items: silhouette of the dressed garment over the photo's", "IoU ≥ 0.90 mean",
                f"{mean(values):.3f} over {len(values)} items, from {min(values):.3f} to {max(values):.3f}",
                mean(values) >= 0.90)]


def extremes_bar(data):
    rows = data["extremes"] or []
    if not rows:
        return []
    good = sum(sound(r) for r in rows)
    return [bar("extremes: a believable result, a named status or a refusal", "every case", share(good, len(rows)),
                good == len(rows))]


def all_bars(data):
    unmeasured = lambda what, text: [bar(what, text, "not measured", None)]  # noqa: E731
    complete = [key for key in MACHINE if data["machine"].get(key)]
    return ((error_bars(data) or unmeasured("error against the reference", "falls; ≤ 10, 4 mm, spread"))
            + (estimate_bar(data) or unmeasured("the estimate against the true error", "within a factor of 2"))
            + (budget_bars(data) or unmeasured("--max-error 3", "met on ≥ 95 % at ≤ 1/3 of fine's time"))
            + (effect_bars(data) or unmeasured("effects that were skipped", "≤ 0.5 mm mean"))
            + (fidelity_bar(data) or unmeasured("silhouette over the photo's", "IoU ≥ 0.90 mean"))
            + (extremes_bar(data) or unmeasured("extremes", "every case named"))
            + [bar("this page", "from one command, with machine and date",
                   f"{len(complete)} of {len(MACHINE)} facts of the machine known", len(complete) == len(MACHINE))])
