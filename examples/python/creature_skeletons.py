# SPDX-License-Identifier: BSD-3-Clause
"""Coarse skeletons of four figures, for HybridTree Subdivision Skeleton.

After the figures of Angelidis and Cani, "Adaptive Implicit Modeling using Subdivision Curves and Surfaces as
Skeletons" (2002): a bretzel of 24 segments, an alien of 102 segments and 15 triangles, Nessie and a bat.
"""
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter


class Skeleton:
    """Points with radii, segments and triangles. A point is its number."""

    def __init__(self):
        self.points, self.radii, self.segments, self.triangles = [], [], [], []

    def point(self, x, y, z, radius):
        self.points.append((x, y, z))
        self.radii.append(radius)
        return len(self.points) - 1

    def curve(self, start, *places):
        """Joins `start`, a point, to new points at places (x, y, z, radius) or to points; returns the last."""
        for place in places:
            point = place if isinstance(place, int) else self.point(*place)
            self.segments.append((start, point))
            start = point
        return start

    def triangle(self, a, b, c):
        self.triangles.append((a, b, c))

    def sheet(self, *strip):
        """Triangles of a strip of points, each with the two before it."""
        for k in range(2, len(strip)):
            self.triangle(*strip[k - 2 : k + 1])

    def polydata(self):
        points, radii, lines, triangles = vtkPoints(), vtkDoubleArray(), vtkCellArray(), vtkCellArray()
        points.SetDataTypeToDouble()
        radii.SetName("Radius")
        for point, radius in zip(self.points, self.radii):
            points.InsertNextPoint(point)
            radii.InsertNextValue(radius)
        for cells, elements in ((lines, self.segments), (triangles, self.triangles)):
            for element in elements:
                cells.InsertNextCell(len(element))
                for point in element:
                    cells.InsertCellPoint(point)
        data = vtkPolyData()
        data.SetPoints(points)
        data.SetLines(lines)
        data.SetPolys(triangles)
        data.GetPointData().SetScalars(radii)
        return data

    def write(self, path):
        writer = vtkXMLPolyDataWriter()
        writer.SetFileName(path)
        writer.SetDataModeToBinary()
        writer.SetInputData(self.polydata())
        writer.Write()


def bretzel():
    """24 segments in two strands, which cross without touching and end on each other."""
    s = Skeleton()
    bottom = s.point(0.0, -1.0, 0.0, 0.21)
    arms, landings = {}, {}
    for side in (1, -1):
        first = s.curve(bottom, (0.55 * side, -0.98, 0.0, 0.21))
        landings[side] = s.curve(first, (1.05 * side, -0.7, 0.0, 0.2))
        arms[side] = s.curve(landings[side], (1.38 * side, -0.1, 0.0, 0.2), (1.32 * side, 0.55, 0.0, 0.19),
                             (0.92 * side, 0.97, 0.0, 0.18), (0.42 * side, 0.85, 0.05 * side, 0.16))
    for side in (1, -1):
        s.curve(arms[side], (0.14 * side, 0.5, 0.12 * side, 0.14), (-0.02 * side, 0.18, 0.145 * side, 0.13),
                (-0.24 * side, -0.1, 0.16 * side, 0.12), (-0.5 * side, -0.36, 0.16 * side, 0.11),
                (-0.8 * side, -0.56, 0.12 * side, 0.1), landings[-side])
    return s


def alien():
    """102 segments and 15 triangles: a flat trunk, palms and crown, and limbs of curves."""
    s = Skeleton()
    hips = [s.point(x, 0.0, 0.0, 0.17) for x in (-0.32, 0.32)]
    waist = s.point(0.0, 0.42, 0.02, 0.16)
    chest = [s.point(x, 0.85, 0.04, 0.2) for x in (-0.42, 0.42)]
    collar = s.point(0.0, 1.12, 0.0, 0.17)
    s.triangle(hips[0], hips[1], waist)
    s.triangle(hips[0], waist, chest[0])
    s.triangle(hips[1], waist, chest[1])
    s.triangle(waist, chest[0], chest[1])
    s.triangle(chest[0], chest[1], collar)
    chin = s.curve(collar, (0.0, 1.27, 0.02, 0.1), (0.0, 1.42, 0.06, 0.1), (0.0, 1.55, 0.12, 0.13))
    temples = [s.point(x, 1.9, 0.08, 0.2) for x in (-0.27, 0.27)]
    crown = s.point(0.0, 2.25, -0.06, 0.22)
    s.triangle(chin, temples[0], temples[1])
    s.triangle(temples[0], temples[1], crown)
    back = s.point(0.0, 1.95, -0.34, 0.2)
    s.triangle(temples[0], crown, back)
    s.triangle(temples[1], crown, back)
    for k, side in enumerate((-1, 1)):
        # An arm of 6 segments, a palm of 3 triangles, three fingers of 4.
        wrist = s.curve(chest[k], (0.68 * side, 0.92, 0.02, 0.12), (0.92 * side, 0.78, 0.0, 0.1),
                        (1.1 * side, 0.52, 0.02, 0.095), (1.22 * side, 0.25, 0.1, 0.085),
                        (1.3 * side, 0.02, 0.2, 0.075), (1.36 * side, -0.16, 0.28, 0.075))
        inner = s.point(1.27 * side, -0.36, 0.36, 0.07)
        outer = s.point(1.5 * side, -0.34, 0.36, 0.07)
        edge = s.point(1.4 * side, -0.48, 0.4, 0.065)
        s.triangle(wrist, inner, outer)
        s.triangle(inner, outer, edge)
        s.triangle(wrist, inner, s.point(1.16 * side, -0.28, 0.44, 0.06))
        for root, x, spread in ((inner, 1.27, -0.05), (edge, 1.4, 0.02), (outer, 1.5, 0.09)):
            y = s.points[root][1]
            s.curve(root, *(((x + spread * t) * side, y - 0.13 * t, 0.4 + 0.035 * t * t, 0.062 - 0.006 * t)
                            for t in (1, 2, 3, 4)))
        # A leg of 7, three toes of 3.
        ankle = s.curve(hips[k], (0.4 * side, -0.28, 0.06, 0.17), (0.45 * side, -0.58, 0.14, 0.14),
                        (0.47 * side, -0.86, 0.2, 0.12), (0.48 * side, -1.1, 0.12, 0.115),
                        (0.5 * side, -1.36, 0.02, 0.1), (0.52 * side, -1.6, -0.02, 0.09), (0.53 * side, -1.8, 0.02, 0.09))
        for spread in (-0.14, 0.03, 0.2):
            s.curve(ankle, *(((0.53 + spread * t) * side, -1.86 - 0.02 * t, 0.02 + 0.17 * t, 0.085 - 0.008 * t)
                             for t in (1, 2, 3)))
        # A feeler of 6 on the head, an ear of 5.
        s.curve(temples[k], *(((0.27 + 0.07 * t) * side, 2.1 + 0.13 * t - 0.012 * t * t, 0.1 + 0.02 * t * t,
                               0.06 - 0.005 * t if t < 6 else 0.09) for t in (1, 2, 3, 4, 5, 6)))
        s.curve(temples[k], *(((0.27 + 0.13 * t) * side, 1.88 - 0.01 * t * t, -0.04 * t, 0.09 - 0.012 * t)
                              for t in (1, 2, 3, 4, 5)))
    # A tail of 9.
    s.curve(hips[0], (0.0, -0.1, -0.25, 0.14))
    tail = len(s.points) - 1
    s.curve(hips[1], tail)
    s.curve(tail, *((0.19 * t, -0.1 - 0.17 * t + 0.045 * t * t, -0.25 - 0.1 * t, 0.13 - 0.012 * t)
                    for t in range(1, 8)))
    return s


def nessie():
    """A neck and humps of curves, a trunk and four fins of triangles."""
    s = Skeleton()
    rump = s.point(-0.9, 0.0, 0.0, 0.26)
    flanks = [s.point(0.0, -0.02, z, 0.3) for z in (-0.3, 0.3)]
    shoulder = s.point(0.95, 0.05, 0.0, 0.26)
    s.triangle(rump, flanks[0], flanks[1])
    s.triangle(flanks[0], flanks[1], shoulder)
    s.curve(rump, (-0.3, 0.2, 0.0, 0.24), (0.4, 0.22, 0.0, 0.24), shoulder)
    head = s.curve(shoulder, (1.35, 0.3, 0.0, 0.22), (1.62, 0.75, 0.0, 0.18), (1.68, 1.25, 0.0, 0.15),
                   (1.72, 1.65, 0.0, 0.14), (1.95, 1.92, 0.0, 0.17))
    s.curve(head, (2.2, 1.86, 0.0, 0.15), (2.42, 1.72, 0.0, 0.1))
    for side in (-1, 1):
        s.curve(head, (1.9, 2.12, 0.1 * side, 0.05), (1.86, 2.26, 0.13 * side, 0.05))
    s.curve(rump, (-1.35, -0.08, 0.06, 0.22), (-1.8, -0.02, 0.2, 0.16), (-2.2, 0.08, 0.15, 0.11),
            (-2.55, 0.12, -0.05, 0.07), (-2.85, 0.18, -0.2, 0.05))
    for x, size in ((-0.35, 0.85), (0.55, 1.0)):
        for side in (-1, 1):
            root = [s.point(x + 0.16 * size, -0.12, 0.34 * side, 0.13), s.point(x - 0.16 * size, -0.12, 0.34 * side, 0.13)]
            middle = s.point(x - 0.28 * size, -0.34, (0.34 + 0.5 * size) * side, 0.085)
            tip = s.point(x - 0.62 * size, -0.5, (0.34 + 0.82 * size) * side, 0.055)
            s.triangle(root[0], root[1], middle)
            s.triangle(root[1], middle, tip)
            s.segments.append((flanks[(side + 1) // 2], root[0]))
    return s


def bat():
    """Wings of triangles between fingers of curves, a trunk, ears and feet."""
    s = Skeleton()
    neck = s.point(0.0, 0.35, 0.0, 0.22)
    belly = s.point(0.0, -0.15, 0.04, 0.28)
    tail = s.point(0.0, -0.6, 0.0, 0.16)
    s.curve(neck, belly, tail)
    head = s.curve(neck, (0.0, 0.72, 0.05, 0.25))
    s.curve(head, (0.0, 0.68, 0.32, 0.13))
    for side in (-1, 1):
        ear = s.point(0.14 * side, 0.98, 0.0, 0.1)
        s.triangle(ear, s.point(0.34 * side, 0.9, -0.02, 0.07), s.point(0.33 * side, 1.32, -0.04, 0.045))
        s.segments.append((head, ear))
        s.curve(tail, (0.13 * side, -0.82, 0.02, 0.08), (0.16 * side, -1.0, 0.1, 0.06))
        elbow = s.point(0.75 * side, 0.62, -0.08, 0.09)
        wrist = s.point(1.35 * side, 0.95, -0.04, 0.08)
        s.curve(neck, elbow, wrist)
        s.curve(wrist, (1.4 * side, 1.15, 0.04, 0.05))
        tips = [s.curve(wrist, (2.15 * side, 0.6, -0.12, 0.05), (2.7 * side, 0.12, -0.16, 0.04)),
                s.curve(wrist, (1.75 * side, 0.25, -0.16, 0.05), (1.95 * side, -0.42, -0.2, 0.04)),
                s.curve(wrist, (1.2 * side, 0.2, -0.16, 0.05), (1.15 * side, -0.5, -0.2, 0.04))]
        joints = [tip - 1 for tip in tips]
        hollow = s.point(0.5 * side, 0.05, -0.12, 0.045)
        for a, b in ((0, 1), (1, 2)):
            s.triangle(wrist, joints[a], joints[b])
            s.triangle(joints[a], joints[b], tips[b])
            s.triangle(joints[a], tips[a], tips[b])
        s.triangle(elbow, wrist, joints[2])
        s.triangle(elbow, joints[2], hollow)
        s.triangle(joints[2], tips[2], hollow)
        s.triangle(elbow, hollow, neck)
        s.triangle(hollow, neck, belly)
    return s
