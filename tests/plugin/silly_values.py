# SPDX-License-Identifier: BSD-3-Clause
"""Every number of every proxy, set to what nobody means: it is refused by its name, or the output is sound."""
import math
import re

import plugin
from paraview import simple
from proxies import is_input, properties
from vtkmodules.util.numpy_support import vtk_to_numpy

REALS = (-1.0, 0.0, 1e300, -1e300, 1e-300, math.inf, math.nan)
WHOLE = (-1, 99, 2147483647, -2147483648)
# What is wrong is not one number alone, or is called otherwise.
OTHER_NAMES = {
    "Center": "affine map", "Rotate": "affine map", "Scale": "affine map", "Translate": "affine map",
    "LatticeAxes": "lattice", "LatticeDimensions": "lattice", "LatticeOrigin": "lattice",
    "Points": "point", "Radii": "radius", "Segments": "segment", "Triangles": "triangle",
    "SmoothingRadius": "different points", "Spacing": "different points",
}
FAR_OR_FINE = ("The shape reaches out", "too far from the origin", "cells", "triangles")


def make(name, shapes):
    if plugin.PROXIES[name] == "sources":
        return getattr(plugin, name)()
    ball = shapes["ball"]
    inputs = {
        "HybridTreeCurveSkeletons": {"Input": shapes["line"]},
        "HybridTreeSubdivisionSkeleton": {"Input": shapes["line"]},
        "HybridTreeSurfaceOfRevolutionFromProfile": {"Input": shapes["line"]},
        "HybridTreePolygonFromOutline": {"Input": shapes["outline"]},
        "HybridTreeBlend": {"Input": [shapes["mesh"], ball]},
        "HybridTreeLocalBlend": {"A": shapes["mesh"], "B": ball, "Region": ball},
        "HybridTreeBoolean": {"A": shapes["mesh"], "B": [ball]},
        "HybridTreeProbe": {"Tree": ball, "Points": shapes["mesh"]},
    }
    return getattr(plugin, name)(**inputs.get(name, {"Input": shapes["mesh"]}))


def letters(text):
    return re.sub("[^a-z]", "", text.lower())


def is_sound(data):
    arrays = (data.GetPoints() and data.GetPoints().GetData(), data.GetPointData().GetNormals())
    return all(not array or abs(vtk_to_numpy(array)).max(initial=0) < 1e150 for array in arrays)


def check_value(name, key, value, proxy):
    """Whether it was refused."""
    with plugin.Messages() as messages:
        data = plugin.run(proxy)
    where = f"{name}.{key} = {value}: {messages.text}"
    assert is_sound(data), where
    assert "std::" not in messages.text, where
    refused = "ERROR" in messages.text
    if refused:
        assert data.GetNumberOfPoints() == 0, where
        names = (key.rstrip("12"), OTHER_NAMES.get(key, key))
        known = any(letters(name) in letters(messages.text) for name in names)
        assert known or any(words in messages.text for words in FAR_OR_FINE), where
    return refused


def check(name, proxy):
    """Returns how many values were tried, and refused."""
    answers = []
    for key, prop in list(properties(proxy.SMProxy)):
        if is_input(prop) or prop.IsA("vtkSMStringVectorProperty") or prop.GetNumberOfElements() == 0:
            continue
        last = prop.GetNumberOfElements() - 1
        before = prop.GetElement(last)
        for value in WHOLE if prop.IsA("vtkSMIntVectorProperty") else REALS:
            prop.SetElement(last, value)
            proxy.SMProxy.UpdateVTKObjects()
            answers.append(check_value(name, key, value, proxy))
        prop.SetElement(last, before)
        proxy.SMProxy.UpdateVTKObjects()
    return len(answers), sum(answers)


def main():
    shapes = {
        "mesh": simple.Sphere(ThetaResolution=8, PhiResolution=8),
        "line": simple.PolyLineSource(Points=[0.2, 0, 0, 0.4, 0, 0.3, 0.2, 0, 0.6]),
        "outline": simple.PolyLineSource(Points=[0, 0, 0, 1, 0, 0, 0, 1, 0], Closed=1),
        "ball": plugin.HybridTreePoint(Center=[0.3, 0, 0]),
    }
    for name in plugin.PROXIES:
        tried, refused = check(name, make(name, shapes))
        print(f"{name}: {refused} of {tried} refused", flush=True)


if __name__ == "__main__":
    main()
