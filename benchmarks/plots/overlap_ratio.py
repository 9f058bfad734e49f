# SPDX-License-Identifier: BSD-3-Clause
"""Fig. 15 of [HT] rebuilt: polygonization time over overlap ratio, from the table that
`LocalBlendBenchmark pairs FILE` writes. Plain SVG, no library needed.

    overlap_ratio.py FILE.csv FILE.svg
"""
import csv
import math
import sys

WIDTH, HEIGHT = 720, 440
LEFT, RIGHT, TOP, BOTTOM = 70, 20, 50, 60
SERIES = (("global", "Global", "#1f77b4"), ("local", "Node-based", "#d62728"), ("automatic", "Automatic", "#2ca02c"))


def median(values):
    values = sorted(values)
    return values[len(values) // 2]


def main(source, target):
    with open(source) as table:
        rows = [{name: float(text) for name, text in row.items()} for row in csv.DictReader(table)]
    times = [1e3 * row[name] for row in rows for name, _, _ in SERIES]
    low = math.floor(math.log10(min(times)))
    high = math.ceil(math.log10(max(times)))

    def x(ratio):
        return LEFT + ratio * (WIDTH - LEFT - RIGHT)

    def y(milliseconds):
        return HEIGHT - BOTTOM - (math.log10(milliseconds) - low) / (high - low) * (HEIGHT - TOP - BOTTOM)

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" font-family="sans-serif" font-size="13">',
        f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>']
    for k in range(11):
        out.append(f'<text x="{x(k / 10):.1f}" y="{HEIGHT - BOTTOM + 20}" text-anchor="middle">{k / 10:g}</text>')
    for power in range(low, high + 1):
        level = y(10.0 ** power)
        out.append(f'<line x1="{LEFT}" x2="{WIDTH - RIGHT}" y1="{level:.1f}" y2="{level:.1f}" stroke="#ddd"/>')
        out.append(f'<text x="{LEFT - 8}" y="{level + 4:.1f}" text-anchor="end">{10.0 ** power:g} ms</text>')
    out.append(f'<text x="{(LEFT + WIDTH - RIGHT) / 2}" y="{HEIGHT - 15}" text-anchor="middle">overlap ratio of two balls</text>')
    for number, (name, label, colour) in enumerate(SERIES):
        dots = "".join(f"M{x(row['ratio']):.0f} {y(1e3 * row[name]):.1f}h0" for row in rows)
        out.append(f'<path d="{dots}" stroke="{colour}" stroke-width="2.5" stroke-linecap="round" stroke-opacity="0.3"/>')
        line = []
        for step in range(20):
            near = [1e3 * row[name] for row in rows if step / 20 <= row["ratio"] <= (step + 1) / 20]
            if near:
                line.append(f"{x((step + 0.5) / 20):.1f},{y(median(near)):.1f}")
        out.append(f'<polyline points="{" ".join(line)}" fill="none" stroke="{colour}" stroke-width="2"/>')
        out.append(f'<text x="{LEFT + 150 * number}" y="28" fill="{colour}" font-weight="bold">{label}</text>')
    out.append("</svg>")
    with open(target, "w") as svg:
        svg.write("\n".join(out) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
