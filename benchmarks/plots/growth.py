# SPDX-License-Identifier: BSD-3-Clause
"""How reconstruction grows with the number of points, from the table of ReconstructionGrowth: time
of the processor and peak of memory, both axes logarithmic. Plain SVG, no library needed.

    growth.py FILE.csv FILE.svg
"""
import csv
import math
import sys

WIDTH, HEIGHT = 760, 380
TOP, BOTTOM, LEFT, GAP = 60, 50, 60, 70
PANEL = (WIDTH - LEFT - GAP - 20) / 2
SERIES = (("level", "at a level of detail", "#2ca02c"), ("all", "all points", "#1f77b4"), ("cgal", "bare Delaunay of CGAL", "#d62728"))
SUPERSCRIPTS = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")
PANELS = (("cpu", "Processor time, s"), ("peakMiB", "Peak memory, MiB"))


def decades(values):
    return math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))


def panel(out, rows, left, column, title):
    """One diagram of a column over the number of points."""
    first, last = decades([row["points"] for row in rows])
    low, high = decades([row[column] for row in rows])

    def x(points):
        return left + (math.log10(points) - first) / (last - first) * PANEL

    def y(value):
        return HEIGHT - BOTTOM - (math.log10(value) - low) / (high - low) * (HEIGHT - TOP - BOTTOM)

    for power in range(first, last + 1):
        out.append(f'<line x1="{x(10 ** power):.1f}" x2="{x(10 ** power):.1f}" y1="{TOP}" y2="{HEIGHT - BOTTOM}" stroke="#ddd"/>')
        out.append(f'<text x="{x(10 ** power):.1f}" y="{HEIGHT - BOTTOM + 18}" text-anchor="middle">10{str(power).translate(SUPERSCRIPTS)}</text>')
    for power in range(low, high + 1):
        level = y(10.0 ** power)
        out.append(f'<line x1="{left}" x2="{left + PANEL}" y1="{level:.1f}" y2="{level:.1f}" stroke="#ddd"/>')
        out.append(f'<text x="{left - 6}" y="{level + 4:.1f}" text-anchor="end">{10.0 ** power:g}</text>')
    out.append(f'<text x="{left}" y="{TOP - 10}">{title}</text>')
    out.append(f'<text x="{left + PANEL / 2}" y="{HEIGHT - 12}" text-anchor="middle">points</text>')
    for way, _, colour in SERIES:
        line = [(x(row["points"]), y(row[column])) for row in rows if row["way"] == way]
        out.append(f'<polyline fill="none" stroke="{colour}" stroke-width="2" points="' +
            " ".join(f"{a:.1f},{b:.1f}" for a, b in line) + '"/>')
        out += [f'<circle cx="{a:.1f}" cy="{b:.1f}" r="3" fill="{colour}"/>' for a, b in line]


def main(source, target):
    with open(source) as table:
        rows = [{name: text if name == "way" else float(text) for name, text in row.items()} for row in csv.DictReader(table)]
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" font-family="sans-serif" font-size="12">',
        f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>']
    for k, (_, name, colour) in enumerate(SERIES):
        out.append(f'<text x="{LEFT + 200 * k}" y="22" fill="{colour}">{name}</text>')
    for k, (column, title) in enumerate(PANELS):
        panel(out, rows, LEFT + k * (PANEL + GAP), column, title)
    with open(target, "w") as picture:
        picture.write("\n".join(out) + "\n</svg>\n")


if __name__ == "__main__":
    main(*sys.argv[1:3])
