# SPDX-License-Identifier: BSD-3-Clause
"""The winged snake-woman, after Figures 1 and 19 of the HybridTree paper.

    xvfb-run -a pvpython examples/python/snake_woman.py [output folder]

A body of 250 spline primitives, blended, loses its head to a ball and gets that of Igea by a blend; wings are cut
out of a winged mesh by boxes, and blended with all the rest. The paper cuts them from the Victory of
Samothrace; a mesh made of spline feathers stands in.
"""
import math
import os

from figures import *  # heads, wings, arms; paraview.simple and our helpers

folder = output_folder("snake-woman")
view = make_view()
portrait_light(view)
EDGE = 0.013
TAIL = 175  # splines; with the torso and two arms of 18 there are 250


def smooth(a, b, t):
    u = min(max((t - a) / (b - a), 0.0), 1.0)
    return u * u * (3 - 2 * u)


def tail(t):
    """Middle of the snake, t from 0 (its tip) to 1 (the waist): coils that narrow and rise."""
    turn = 2 * math.pi * 2.35 * (1 - t) + 0.5 * math.pi
    width = 0.78 * (1 - 0.25 * t) * (1 - smooth(0.68, 1.0, t))
    height = 0.10 + 0.38 * smooth(0.25, 0.8, t) + 0.66 * smooth(0.72, 1.0, t)
    return (width * math.cos(turn), height, width * math.sin(turn))


def girth(t):
    return 0.02 + 0.135 * math.sin(0.5 * math.pi * min(t / 0.6, 1.0)) - 0.03 * smooth(0.85, 1.0, t)


def body():
    at = lambda k: (tail(k / (2 * TAIL)), girth(k / (2 * TAIL)))
    for k in range(TAIL):
        yield [at(2 * k), at(2 * k + 1), at(2 * k + 2)]
    yield from torso()
    yield [((0, 2.00, 0.02), 0.11), ((0, 2.08, 0.03), 0.12), ((0, 2.14, 0.02), 0.11)]  # the head that goes
    for s in (-1, 1):
        yield [((0, 2.05, 0.05), 0.09), ((s * 0.03, 2.04, 0.09), 0.06), ((0, 2.0, 0.10), 0.05)]
    yield from arm((-0.235, 1.68, -0.01), (-0.40, 1.42, 0.02), (-0.36, 1.22, 0.22), fingers=(0.25, -0.25, 0.93), palm=(0.93, 0.2, -0.2))
    yield from arm((0.235, 1.68, -0.01), (0.42, 1.47, 0.06), (0.50, 1.66, 0.26), fingers=(0.15, 0.75, 0.64), palm=(-0.5, -0.5, 0.7))


start = clock()
curves = list(body())
print(f"{len(curves)} spline primitives")
woman = splines("snake-woman", curves, folder, SurfaceRadius=0.1, InfluenceRadius=0.125, EdgeLength=EDGE)
headless = HybridTreeBoolean(
    registrationName="headless", A=woman, Operation="Difference A - B", EdgeLength=EDGE,
    B=HybridTreePoint(registrationName="ball", Center=[0, 2.08, 0.03], SurfaceRadius=0.19, InfluenceRadius=0.3),
)
head = HybridTreeMeshField(
    registrationName="head", InfluenceRadius=0.06,
    Input=HybridTreeAffineTransform(
        registrationName="head in place", Input=igea(folder), Scale=[0.40, 0.40, 0.40], Translate=[0, 2.065, 0.02]
    ),
)
with_head = HybridTreeBlend(registrationName="with head", Input=[headless, head], EdgeLength=EDGE)

# A winged mesh, with a bar between the wings that the boxes leave behind.
feathers = [curve for side in (-1, 1) for curve in wing(side, (0.07 * side, 1.60, -0.13), span=1.05, feathers=19)]
bar = [[((-0.07, 1.60, -0.13), 0.05), ((0, 1.60, -0.16), 0.05), ((0.07, 1.60, -0.13), 0.05)]]
winged = Clean(registrationName="a winged mesh", Input=splines(
    "winged", feathers + bar, folder, SurfaceRadius=0.05, InfluenceRadius=0.062, EdgeLength=EDGE))
boxes = HybridTreeBoolean(
    registrationName="boxes", Operation="Union",
    A=HybridTreeBox(Center=[-1.05, 1.5, -0.3], Lengths=[2.0, 3.0, 2.0], SurfaceRadius=0.01, InfluenceRadius=0.1),
    B=HybridTreeBox(Center=[1.05, 1.5, -0.3], Lengths=[2.0, 3.0, 2.0], SurfaceRadius=0.01, InfluenceRadius=0.1),
)
cut = HybridTreeBoolean(registrationName="wings", Operation="Intersection", A=winged, B=boxes, EdgeLength=EDGE)
wings = HybridTreeMeshField(registrationName="wings as a field", Input=cut, InfluenceRadius=0.03)
figure = HybridTreeBlend(registrationName="winged snake-woman", Input=[with_head, wings], EdgeLength=EDGE)
finish(figure, "winged snake-woman", start, volume=(0.1, 3.0))

look(view, direction=(0.28, 0.22, 1.0), focus=(0, 1.12, 0), distance=5.5)
picture(view, figure, os.path.join(folder, "snake-woman.png"), colour=JADE)
