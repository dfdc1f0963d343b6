# SPDX-License-Identifier: GPL-3.0-or-later
"""The plots, as SVG."""
import math
from xml.sax.saxutils import escape

from . import tables

COLOURS = {"draft": "#e07b20", "standard": "#3366bb", "fine": "#2a8a55"}


def page(width, height, body):
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" '
            f'font-size="12"><rect width="100%" height="100%" fill="#fff"/>\n' + "\n".join(body) + "\n</svg>\n")


def text(x, y, words, anchor="start", size=12, extra=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" font-size="{size}"{extra}>{escape(words)}</text>'


def line(x1, y1, x2, y2, colour="#ccc", dash=""):
    style = f' stroke-dasharray="{dash}"' if dash else ""
    return f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{colour}"{style}/>'


class LogAxis:
    """Powers of ten from below the least to above the largest value."""

    def __init__(self, values, start, end):
        low, high = math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))
        self.low, self.high, self.start, self.end = low, max(high, low + 1), start, end

    def at(self, value):
        return self.start + (math.log10(value) - self.low) / (self.high - self.low) * (self.end - self.start)

    def ticks(self):
        return [10.0 ** e for e in range(self.low, self.high + 1)]


def trade(data):
    """Error over processor time, a dot for each item and quality, and the means."""
    dots = [(q, r["item"], tables.number(r["cpu_ms"]), tables.number(r["mean_mm"]))
            for q in tables.QUALITIES for r in tables.runs_of(data, q)]
    dots = [d for d in dots if d[2] and d[3] and d[2] > 0 and d[3] > 0]
    if not dots:
        return None
    x, y = LogAxis([d[2] for d in dots], 70, 760), LogAxis([d[3] for d in dots], 400, 30)
    body = []
    for tick in x.ticks():
        body += [line(x.at(tick), 30, x.at(tick), 400), text(x.at(tick), 418, f"{tick / 1000:g} s", "middle")]
    for tick in y.ticks():
        body += [line(70, y.at(tick), 760, y.at(tick)), text(62, y.at(tick) + 4, f"{tick:g} mm", "end")]
    for quality, item, ms, error in dots:
        body.append(f'<circle cx="{x.at(ms):.1f}" cy="{y.at(error):.1f}" r="4" fill="{COLOURS[quality]}" '
                    f'fill-opacity="0.7"><title>{escape(item)}, {quality}: {error:.2f} mm for {ms:.0f} ms</title></circle>')
    for k, quality in enumerate(tables.QUALITIES):
        own = [d for d in dots if d[0] == quality]
        body.append(text(90 + 130 * k, 20, f"● {quality}", extra=f' fill="{COLOURS[quality]}"'))
        if own:
            mx, my = x.at(tables.mean([d[2] for d in own])), y.at(tables.mean([d[3] for d in own]))
            body += [line(mx - 9, my, mx + 9, my, "#000"), line(mx, my - 9, mx, my + 9, "#000")]
    body.append(text(415, 440, "processor time of an item; cross: mean; up: farther from the reference", "middle"))
    return page(800, 455, body)


def fidelity(data):
    rows = [r for r in data["fidelity"] or [] if tables.number(r["iou_posed"]) is not None]
    if not rows:
        return None
    rows.sort(key=lambda r: (tables.number(r["iou_posed"]), r["item"]))
    step, left, right = 19, 130, 740
    bottom = 40 + step * len(rows)
    at = lambda v: left + (v - 0.5) / 0.5 * (right - left)  # noqa: E731
    body = [text(left, 16, "● posed, width and height fitted", extra=' fill="#3366bb"'),
            text(left + 230, 16, "● one scale", extra=' fill="#e07b20"'),
            text(left + 330, 16, "● true size", extra=' fill="#999"')]
    for v in (0.5, 0.6, 0.7, 0.8, 0.9, 1.0):
        body += [line(at(v), 26, at(v), bottom, "#000" if v == 0.9 else "#ccc", "4 3" if v == 0.9 else ""),
                 text(at(v), bottom + 16, f"{v:.1f}", "middle")]
    for k, row in enumerate(rows):
        y = 40 + step * k
        body.append(text(left - 10, y + 4, row["item"], "end"))
        for column, colour in (("iou_true_size", "#999"), ("iou_uniform", "#e07b20"), ("iou_posed", "#3366bb")):
            value = tables.number(row[column])
            if value is not None:
                body.append(f'<circle cx="{at(max(0.5, value)):.1f}" cy="{y}" r="4.5" fill="{colour}">'
                            f"<title>{escape(row['item'])} {column} {value:.3f}</title></circle>")
    return page(780, bottom + 30, body)


def constants(data):
    """The paper's k and m: what became of each pair."""
    cells = {}
    for row in data["extremes"] or []:
        words = row["case"].split()
        if row["group"] == "k and m" and len(words) == 2 and words[0].startswith("k=1e") and words[1].startswith("m=1e"):
            cells[int(words[0][4:]), int(words[1][4:])] = row
    if not cells:
        return None
    ks, ms = sorted({k for k, _ in cells}), sorted({m for _, m in cells})
    left, top, w, h = 90, 40, 64, 34
    body = [text(left, 22, "green: at rest; yellow: at rest or not, with a status that names it; grey: refused; red: a bug")]
    for i, k in enumerate(ks):
        body.append(text(left + w * (i + 0.5), top + h * len(ms) + 18, f"k = 1e{k}", "middle", 11))
    for j, m in enumerate(ms):
        y = top + h * (len(ms) - 1 - j)
        body.append(text(left - 8, y + h / 2 + 4, f"m = 1e{m}", "end", 11))
        for i, k in enumerate(ks):
            row = cells.get((k, m))
            if row is None:
                continue
            refused = row["finite"] == ""
            colour = ("#d33" if not tables.sound(row) else "#ddd" if refused
                      else "#7cc08a" if row["status_or_code"] == "OK" else "#f0d060")
            stretch = tables.number(row.get("stretch_p99", ""))
            body.append(f'<rect x="{left + w * i}" y="{y}" width="{w - 2}" height="{h - 2}" fill="{colour}"><title>'
                        f"{escape(row['case'])}: {escape(row['status_or_code'])}</title></rect>")
            if stretch is not None:
                body.append(text(left + w * (i + 0.5) - 1, y + h / 2 + 4, f"{100 * stretch:.0f} %", "middle", 11))
    body.append(text(left, top + h * len(ms) + 40, "k in N/m, m in kg a node; figures: how far an edge in a hundred is stretched"))
    return page(left + w * len(ks) + 20, top + h * len(ms) + 55, body)


def draw(data):
    made = {"accuracy-trade.svg": trade(data), "accuracy-fidelity.svg": fidelity(data),
            "accuracy-constants.svg": constants(data)}
    return {name: svg for name, svg in made.items() if svg is not None}
