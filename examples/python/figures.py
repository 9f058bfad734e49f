# SPDX-License-Identifier: BSD-3-Clause
"""What the examples after the figures of the HybridTree paper share: heads, wings, arms, and a check that times.

Two scans are looked for in HYBRIDTREE_DATA_DIR, else in ../shared/data beside the project: igea.ply and
stanford_bunny.obj. Where they are absent a mesh of Debian's libcgal-demo stands in, and a line says so.
"""
import math
import os
import time

from scans import convert
from stage import *  # paraview.simple and our helpers
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkFeatureEdges, vtkMassProperties, vtkPolyDataConnectivityFilter
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

globals().update(load_plugin())

MARBLE = [0.90, 0.87, 0.81]
BRONZE = [0.62, 0.47, 0.28]
JADE = [0.52, 0.70, 0.56]
TERRACOTTA = [0.80, 0.52, 0.38]
CEMENT = [0.36, 0.53, 0.72]

DATA = os.environ.get(
    "HYBRIDTREE_DATA_DIR", os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../shared/data")
)


stand_ins = []  # scans that are not there

# --- Scans ------------------------------------------------------------------------------------------

def igea(folder):
    """The head of Igea, 1 unit high, its middle at the origin, looking along z, as a mesh."""
    path = os.path.join(DATA, "igea.ply")
    if os.path.exists(path):
        scan = PLYReader(registrationName="Igea", FileNames=[path])
        return HybridTreeAffineTransform(registrationName="Igea, 1 unit high", Input=scan, Scale=[10, 10, 10])
    print("igea.ply is not there: the head of bear.off of libcgal-demo stands in; parts placed by hand may miss it")
    stand_ins.append("igea.ply")
    bear = XMLPolyDataReader(registrationName="bear", FileName=[convert("meshes/bear.off", folder)])
    head = HybridTreeBoolean(
        registrationName="bear's head", A=bear, Operation="Intersection",
        B=HybridTreeBox(Center=[0, 1.35, 0], Lengths=[3, 2, 3], SurfaceRadius=0.01, InfluenceRadius=0.1),
    )
    return HybridTreeAffineTransform(
        registrationName="head, 1 unit high", Input=head, Translate=[0, -1.05, 0], Scale=[1.65, 1.65, 1.65]
    )


def bunny(folder):
    """The bunny, some 1 unit in size, sitting on y = -0.5 and looking towards -x, as a mesh."""
    path = os.path.join(DATA, "stanford_bunny.obj")
    if os.path.exists(path):
        scan = WavefrontOBJReader(registrationName="Bunny", FileName=path)
        return HybridTreeAffineTransform(
            registrationName="Bunny, 1 unit", Input=scan, Scale=[6.4, 6.4, 6.4], Translate=[0.11, -0.71, 0.01]
        )
    print("stanford_bunny.obj is not there: bunny00.off of libcgal-demo stands in")
    return XMLPolyDataReader(registrationName="Bunny", FileName=[convert("meshes/bunny00.off", folder)])


# --- The bottle of Figure 4 ---------------------------------------------------------------------------

def bottle_parts():
    """Its five primitives, 2 units high, its axis along y."""
    body = HybridTreeSurfaceOfRevolution(
        registrationName="body", Solid=0, Axis=[0, 1, 0], SurfaceRadius=0.05, InfluenceRadius=0.14,
        Points=[0, -1, 0, 0.45, -0.97, 0, 0.62, -0.6, 0, 0.55, -0.1, 0, 0.3, 0.25, 0, 0.2, 0.5, 0],
    )
    handle = HybridTreeSpline(
        registrationName="handle", SurfaceRadius=0.06, InfluenceRadius=0.16,
        Points=[0.22, 0.62, 0, 0.5, 0.72, 0, 0.82, 0.5, 0, 0.85, 0.05, 0, 0.6, -0.25, 0],
    )
    foot = HybridTreeCircle(
        registrationName="foot", Center=[0, -1.0, 0], Normal=[0, 1, 0], Radius=0.5, SurfaceRadius=0.07, InfluenceRadius=0.18
    )
    lip = HybridTreeCircle(
        registrationName="lip", Center=[0, 0.95, 0], Normal=[0, 1, 0], Radius=0.24, SurfaceRadius=0.06, InfluenceRadius=0.14
    )
    neck = HybridTreeHollowCylinder(
        registrationName="neck", Point1=[0, 0.45, 0], Point2=[0, 0.95, 0], OuterRadius=0.22, InnerRadius=0.18,
        SurfaceRadius=0.03, InfluenceRadius=0.1,
    )
    return [body, handle, foot, lip, neck]


# --- Curves with radii, for HybridTree Curve Skeletons ------------------------------------------------

def curves_file(curves, path):
    """Write curves, each a list of (point, radius), as polylines with a point array Radius."""
    points, lines, radius = vtkPoints(), vtkCellArray(), vtkDoubleArray()
    points.SetDataTypeToDouble()
    radius.SetName("Radius")
    for curve in curves:
        lines.InsertNextCell(len(curve))
        for point, r in curve:
            lines.InsertCellPoint(points.InsertNextPoint(point))
            radius.InsertNextValue(r)
    data = vtkPolyData()
    data.SetPoints(points)
    data.SetLines(lines)
    data.GetPointData().AddArray(radius)
    writer = vtkXMLPolyDataWriter()
    writer.SetFileName(path)
    writer.SetDataModeToBinary()
    writer.SetInputData(data)
    writer.Write()
    return path


def splines(name, curves, folder, **settings):
    """All curves as one node of spline primitives."""
    curves = list(curves)
    path = curves_file(curves, os.path.join(folder, name.replace(" ", "-") + "-curves.vtp"))
    lines = XMLPolyDataReader(registrationName=name + ": curves", FileName=[path])
    return HybridTreeCurveSkeletons(registrationName=name, Input=lines, RadiusArray="Radius", **settings)


def mix(a, b, t):
    return tuple((1 - t) * u + t * v for u, v in zip(a, b))


def add(a, b, scale=1.0):
    return tuple(u + scale * v for u, v in zip(a, b))


def arm(shoulder, elbow, wrist, thick=0.075, fingers=(0.0, -1.0, 0.0), palm=(0.0, 0.0, 1.0)):
    """An arm of 18 splines: upper arm, forearm, palm, and a hand whose fingers point along `fingers`."""
    side = (
        fingers[1] * palm[2] - fingers[2] * palm[1], fingers[2] * palm[0] - fingers[0] * palm[2],
        fingers[0] * palm[1] - fingers[1] * palm[0],
    )
    s = thick / 0.075
    at = lambda f, w, u=0.0: add(add(add(wrist, fingers, s * f), side, s * w), palm, s * u)
    bulge = lambda a, b, t, by: add(mix(a, b, t), palm, by * s)
    yield [(shoulder, thick), (bulge(shoulder, elbow, 0.5, 0.01), 0.9 * thick), (elbow, 0.68 * thick)]
    yield [(mix(shoulder, elbow, 0.1), 0.8 * thick), (bulge(shoulder, elbow, 0.45, 0.03), 0.66 * thick),
           (mix(shoulder, elbow, 0.85), 0.5 * thick)]
    yield [(elbow, 0.68 * thick), (bulge(elbow, wrist, 0.3, 0.01), 0.72 * thick), (wrist, 0.42 * thick)]
    yield [(mix(elbow, wrist, 0.05), 0.6 * thick), (bulge(elbow, wrist, 0.35, -0.015), 0.6 * thick),
           (mix(elbow, wrist, 0.8), 0.42 * thick)]
    for w in (-0.030, -0.010, 0.010, 0.030):  # the back of the hand and the fingers from it
        yield [(wrist, 0.024 * s), (at(0.05, w), 0.021 * s), (at(0.095, 1.05 * w), 0.018 * s)]
    for w, length in ((-0.034, 0.06), (-0.0115, 0.078), (0.0115, 0.074), (0.034, 0.058)):
        knuckle, middle = at(0.095, w), at(0.095 + 0.55 * length, 1.15 * w, 0.012)
        yield [(knuckle, 0.017 * s), (mix(knuckle, middle, 0.5), 0.0155 * s), (middle, 0.0145 * s)]
        yield [(middle, 0.0145 * s), (at(0.095 + 0.8 * length, 1.18 * w, 0.024), 0.013 * s),
               (at(0.095 + length, 1.2 * w, 0.040), 0.011 * s)]
    yield [(at(0.02, -0.03), 0.020 * s), (at(0.045, -0.060, 0.015), 0.018 * s), (at(0.075, -0.068, 0.03), 0.015 * s)]
    yield [(wrist, 0.026 * s), (at(0.03, 0.0), 0.028 * s), (at(0.07, 0.0), 0.024 * s)]


def torso():
    """A woman's body from the hips (y = 1.06) to the neck (y = 1.95), looking along z, without arms and head."""
    # Hips, waist, ribs, chest: bands across at rising heights, each of a left, a middle and a right point.
    bands = [(1.06, 0.050, 0.125), (1.12, 0.060, 0.125), (1.18, 0.058, 0.118), (1.24, 0.050, 0.108), (1.30, 0.044, 0.100),
             (1.36, 0.046, 0.100), (1.42, 0.056, 0.104), (1.48, 0.068, 0.108), (1.54, 0.078, 0.110), (1.60, 0.084, 0.108),
             (1.66, 0.088, 0.100)]
    for y, half, r in bands:
        yield [((-half, y, 0), r), ((0, y, 0.012), r), ((half, y, 0), r)]
    for s in (-1, 1):
        for k in range(0, len(bands) - 2, 2):  # along the flanks
            yield [((s * bands[k + j][1], bands[k + j][0], 0), bands[k + j][2]) for j in range(3)]
        yield [((s * 0.10, 1.60, 0.05), 0.06), ((s * 0.085, 1.555, 0.105), 0.066), ((s * 0.075, 1.56, 0.115), 0.055)]
        yield [((0, 1.74, 0.0), 0.075), ((s * 0.11, 1.735, -0.005), 0.07), ((s * 0.20, 1.70, -0.01), 0.078)]
        yield [((s * 0.02, 1.715, 0.055), 0.03), ((s * 0.10, 1.725, 0.055), 0.028), ((s * 0.18, 1.715, 0.035), 0.03)]
        yield [((s * 0.06, 1.76, -0.03), 0.05), ((s * 0.045, 1.82, -0.02), 0.045), ((s * 0.035, 1.88, -0.015), 0.045)]
        yield [((s * 0.03, 1.70, -0.09), 0.05), ((s * 0.09, 1.62, -0.085), 0.055), ((s * 0.10, 1.52, -0.07), 0.05)]
        yield [((s * 0.05, 1.20, -0.05), 0.07), ((s * 0.05, 1.12, -0.07), 0.085), ((s * 0.04, 1.04, -0.06), 0.08)]
    yield [((0, 1.74, -0.01), 0.07), ((0, 1.84, -0.005), 0.062), ((0, 1.95, 0.01), 0.062)]  # neck
    yield [((0, 1.30, 0.06), 0.045), ((0, 1.22, 0.072), 0.05), ((0, 1.14, 0.065), 0.055)]  # belly
    yield [((0, 1.70, 0.04), 0.05), ((0, 1.62, 0.065), 0.04), ((0, 1.50, 0.06), 0.05)]  # breastbone


def wing(side, root, span=1.0, feathers=15):
    """A wing of feathers: along a bone from `root` out to `side` (-1 or 1) and back, in two rows."""
    bone = lambda t: add(root, (
        side * span * (0.10 + 0.62 * t - 0.10 * t * t), span * (0.05 + 0.62 * math.sin(1.9 * t)), -span * (0.10 + 0.18 * t)))
    joints = [bone(k / 6) for k in range(7)]
    yield [(root, 0.045 * span), (mix(root, joints[0], 0.5), 0.05 * span), (joints[0], 0.05 * span)]
    for k in range(0, 6, 2):
        yield [(joints[k], span * (0.052 - 0.005 * k)), (joints[k + 1], span * (0.050 - 0.005 * k)),
               (joints[k + 2], span * (0.048 - 0.005 * k))]
    for row, (reach, lift) in enumerate(((1.0, 0.0), (0.58, 0.030))):
        for k in range(feathers):
            t = (k + 0.5 * row) / (feathers - 1)
            base = bone(min(t, 1.0))
            turn = 0.15 + 1.15 * t  # from hanging down to pointing out
            length = span * reach * (0.42 + 0.40 * t)
            tip = add(base, (side * length * math.sin(turn) * 0.75, -length * math.cos(turn) * (1.0 - 0.15 * t), -0.10 * length))
            bend = add(mix(base, tip, 0.5), (side * 0.02 * span, 0.03 * span, lift * span))
            wide = span * (0.034 - 0.006 * row)
            yield [(base, 0.8 * wide), (add(bend, (0, 0, 0)), wide), (tip, 0.35 * wide)]


# --- What came out ----------------------------------------------------------------------------------

def portrait_light(view):
    """The key from the upper left, and more from the sides than ParaView's usual light."""
    view.KeyLightElevation = 42
    view.KeyLightAzimuth = -32
    view.FillLightKFRatio = 2.2
    view.BackLightKBRatio = 3.0


def clock():
    """Seconds by the clock on the wall, and of work by all threads of this process."""
    return time.perf_counter(), time.process_time()


def finish(proxy, name, start, components=1, volume=(0.0, math.inf)):
    """Update, and fail unless the surface is closed, of so many pieces and of a plausible volume (with stand-ins, only
    unless it is closed). Prints leaves, triangles, and the seconds since `start` = clock() with all that stands upstream."""
    proxy.UpdatePipeline()
    seconds, work = (now - then for now, then in zip(clock(), start))
    data = servermanager.Fetch(proxy)
    edges = vtkFeatureEdges()
    edges.SetInputData(data)
    edges.FeatureEdgesOff()
    edges.ManifoldEdgesOff()
    edges.Update()
    parts = vtkPolyDataConnectivityFilter()
    parts.SetInputData(data)
    parts.SetExtractionModeToAllRegions()
    parts.Update()
    mass = vtkMassProperties()
    mass.SetInputData(data)
    mass.Update()
    leaves = data.GetFieldData().GetAbstractArray("SourceNames").GetNumberOfValues()
    faults = []
    if edges.GetOutput().GetNumberOfCells():
        faults.append(f"{edges.GetOutput().GetNumberOfCells()} open or crowded edges")
    if not stand_ins and parts.GetNumberOfExtractedRegions() != components:
        faults.append(f"{parts.GetNumberOfExtractedRegions()} pieces instead of {components}")
    if not stand_ins and not volume[0] < mass.GetVolume() < volume[1]:
        faults.append(f"volume {mass.GetVolume():.4g} not in {volume}")
    print(
        f"{name}: {leaves} leaves, {data.GetNumberOfPolys()} triangles, {seconds:.1f} s ({work:.1f} s of work), volume {mass.GetVolume():.4g}, "
        + ("closed" if not faults else "; ".join(faults))
    )
    if faults:
        raise SystemExit(f"{name} is not what it should be")
    return data
