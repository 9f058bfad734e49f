# SPDX-License-Identifier: BSD-3-Clause
"""A snake of 250 spline primitives in one pipeline object (section 6.3 of the HybridTree paper).

    xvfb-run -a pvpython examples/python/snake.py [output folder]

Writes snake-curves.vtp, 250 polylines with a radius at each point: a coiled body in 190 short splines, a
head, a forked tongue and a crest of spines. HybridTree Curve Skeletons makes one blended shape of it.
"""
import math
import os

from figures import *  # paraview.simple and our helpers

BODY = 190
SPINES = 48


def spine_of_snake(t):
    """Middle of the body, t from 0 (tail) to 1 (neck): two and a half coils that narrow and rise."""
    turn = 5.6 * math.pi * t
    width = 1.15 - 0.55 * t
    height = 0.25 * t + 1.5 * max(0.0, t - 0.72) ** 1.3 * 3.0
    lean = 1.1 * max(0.0, t - 0.86) / 0.14
    return (width * math.cos(turn) + 0.12 * lean, height, width * math.sin(turn) + 0.25 * lean)


def thickness(t):
    """Radius of the body: a thin tail, a thick middle, a neck."""
    return 0.02 + 0.15 * math.sin(math.pi * min(t / 0.75, 1.0) * 0.5) - 0.05 * max(0.0, t - 0.75) / 0.25


def unit(v):
    length = math.sqrt(sum(c * c for c in v))
    return tuple(c / length for c in v)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def curves():
    """All splines, each a list of (point, radius)."""
    at = lambda k: (spine_of_snake(k / (2 * BODY)), thickness(k / (2 * BODY)))
    for k in range(BODY):
        yield [at(2 * k), at(2 * k + 1), at(2 * k + 2)]

    head = spine_of_snake(1.0)
    forward = unit(add(head, spine_of_snake(0.985), -1.0))
    forward = unit(add(forward, (0, -0.75, 0)))  # the head bows
    side = unit(cross(forward, (0, 1, 0)))
    up = cross(side, forward)
    place = lambda f, s, u: tuple(h + f * a + s * b + u * c for h, a, b, c in zip(head, forward, side, up))
    yield [(head, 0.12), (place(0.14, 0, 0.05), 0.16), (place(0.34, 0, 0.0), 0.11)]  # skull
    yield [(place(0.2, 0, -0.02), 0.11), (place(0.36, 0, -0.03), 0.09), (place(0.46, 0, -0.05), 0.06)]  # snout
    for s in (-1, 1):
        yield [(place(0.06, 0.09 * s, 0), 0.07), (place(0.14, 0.13 * s, -0.02), 0.07), (place(0.26, 0.08 * s, -0.03), 0.06)]
        yield [(place(0.16, 0.1 * s, 0.12), 0.045), (place(0.2, 0.11 * s, 0.13), 0.05), (place(0.24, 0.1 * s, 0.12), 0.04)]
        yield [(place(0.48, 0, -0.06), 0.02), (place(0.62, 0.01 * s, -0.09), 0.018), (place(0.75, 0.07 * s, -0.05), 0.016)]
        yield [(place(0.02, 0.08 * s, 0.08), 0.05), (place(-0.06, 0.2 * s, 0.16), 0.03), (place(-0.18, 0.27 * s, 0.28), 0.018)]
        yield [(place(0.43, 0.05 * s, -0.06), 0.02), (place(0.44, 0.05 * s, -0.12), 0.015), (place(0.42, 0.04 * s, -0.18), 0.014)]

    for k in range(SPINES):
        t = 0.3 + 0.68 * k / SPINES
        base, r = spine_of_snake(t), thickness(t)
        back = unit(add(spine_of_snake(t - 0.01), spine_of_snake(t + 0.01), -1.0))
        top = add(base, (0, r, 0), 0.9)
        tip = add(add(top, (0, 1, 0), 0.11), back, 0.06)
        yield [(top, 0.035), (add(add(top, (0, 1, 0), 0.07), back, 0.015), 0.026), (tip, 0.018)]


folder = output_folder("snake")
view = make_view()
splines_of_snake = list(curves())
print(f"{len(splines_of_snake)} spline primitives")
snake = splines("snake", splines_of_snake, folder, SurfaceRadius=0.1, InfluenceRadius=0.16, EdgeLength=0.013)
look(view, direction=(0.55, 0.55, 1.0), focus=(0.0, 0.55, 0.0), distance=5.4)
picture(view, snake, os.path.join(folder, "snake.png"), colour=[0.42, 0.58, 0.38])
check_closed(snake, "snake")
SaveData(os.path.join(folder, "snake.vtp"), proxy=snake, DataMode="Binary")
