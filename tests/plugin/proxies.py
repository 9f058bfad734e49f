# SPDX-License-Identifier: BSD-3-Clause
"""Every proxy: label, defaults, domains, documentation, and every property pushed to the VTK object."""
import os
import re

import plugin
from paraview import servermanager

ICONS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "plugin", "icons")

LABELS = {
    "HybridTreeFreeFormDeformation": "HybridTree Free-Form Deformation",
}
COMMON = {"EdgeLength"}
FIELD = COMMON | {"SurfaceRadius", "InfluenceRadius", "Exponent", "Negative", "FieldMode", "MaximumField"}
BARR = COMMON | {"Input", "Origin", "Axis", "Normal", "Range"}
BLEND = COMMON | {"Method", "OverlapThreshold"}
INPUTS = {"Input", "A", "B", "Region", "Tree", "Points"}
# The names that scripts rely on; a proxy may have more.
NAMES = {
    "HybridTreePoint": FIELD | {"Center"},
    "HybridTreeSegment": FIELD | {"Point1", "Point2"},
    "HybridTreeCircle": FIELD | {"Center", "Normal", "Radius"},
    "HybridTreeBox": FIELD | {"Center", "Lengths", "Rotation"},
    "HybridTreeDisc": FIELD | {"Center", "Normal", "Radius"},
    "HybridTreeCylinder": FIELD | {"Point1", "Point2", "Radius"},
    "HybridTreeHollowCylinder": FIELD | {"Point1", "Point2", "OuterRadius", "InnerRadius"},
    "HybridTreeCone": FIELD | {"Point1", "Point2", "Radius1", "Radius2"},
    "HybridTreeConeSphere": FIELD | {"Point1", "Point2", "Radius1", "Radius2"},
    "HybridTreeRectangle": FIELD | {"Origin", "Point1", "Point2"},
    "HybridTreeTriangle": FIELD | {"Point1", "Point2", "Point3"},
    "HybridTreePolygon": FIELD | {"Points", "LevelOfDetail"},
    "HybridTreePolygonFromOutline": FIELD | {"Input", "LevelOfDetail"},
    "HybridTreeEllipsoid": FIELD | {"Center", "Radii", "Rotation"},
    "HybridTreeSpline": FIELD | {"Points", "Kind", "Closed", "LevelOfDetail"},
    "HybridTreeSurfaceOfRevolution": FIELD
    | {"Points", "Kind", "Closed", "Origin", "Axis", "Solid", "LevelOfDetail"},
    "HybridTreeSurfaceOfRevolutionFromProfile": FIELD | {"Input", "Kind", "Origin", "Axis", "Solid", "LevelOfDetail"},
    "HybridTreeCurveSkeletons": FIELD | {"Input", "RadiusArray", "As", "Blend", "LevelOfDetail"},
    "HybridTreeSkeletonEditor": {"Points", "Radii", "Segments", "Triangles", "Scheme", "Level"},
    "HybridTreeSubdivisionSkeleton": COMMON
    | {"Input", "RadiusArray", "Radius", "RadiusInterpolation", "Scheme", "Level", "Blending", "BlendDistance", "InfluenceRatio", "Exponent", "Kernel",
        "Negative", "Refinement", "Preview"},
    "HybridTreeMeshField": (FIELD - {"SurfaceRadius"}) | {"Input"},
    "HybridTreeBlend": BLEND | {"Input"},
    "HybridTreeLocalBlend": BLEND | {"A", "B", "Region"},
    "HybridTreeBoolean": COMMON | {"A", "B", "Operation", "Form", "MergeCoplanar"},
    "HybridTreeTwist": BARR | {"Angle"},
    "HybridTreeTaper": BARR | {"Factor"},
    "HybridTreeBend": BARR | {"Angle"},
    "HybridTreeAffineTransform": COMMON | {"Input", "Translate", "Rotate", "Scale", "Center"},
    "HybridTreeFreeFormDeformation": COMMON
    | {"Input", "LatticeDimensions", "LatticeOrigin", "LatticeAxes", "Displacements", "FieldFrom"},
    "HybridTreeSurfaceReconstruction": {"Input", "Spacing", "RemoveOutliers", "OutlierNeighbors",
        "OutlierDeviation", "OpenPockets"},
    "HybridTreeProbe": {"Tree", "Points"},
}


def properties(proxy):
    """name: property, of a server manager proxy, without those that only a widget needs."""
    iterator = proxy.NewPropertyIterator()
    iterator.Begin()
    while not iterator.IsAtEnd():
        if not iterator.GetProperty().GetIsInternal() and not iterator.GetProperty().GetInformationOnly():
            yield iterator.GetKey(), iterator.GetProperty()
        iterator.Next()


def printed(algorithm):
    """What PrintSelf says of a VTK object: {name: text}."""
    text = str(algorithm)
    return dict(re.findall(r"^  ([A-Z]\w*): (.*)$", text, re.MULTILINE))


def input_names(proxy):
    """Names of all input properties, internal ones too: pvpython connects the first to the active source."""
    iterator = proxy.NewPropertyIterator()
    iterator.Begin()
    while not iterator.IsAtEnd():
        if is_input(iterator.GetProperty()):
            yield iterator.GetKey()
        iterator.Next()


def is_input(prop):
    return prop.IsA("vtkSMInputProperty")


def other_value(prop):
    """A list of elements that differs from the present one and is in the domain."""
    if prop.FindDomain("vtkSMBooleanDomain") or prop.FindDomain("vtkSMEnumerationDomain"):
        return [1 - prop.GetElement(0)]
    if prop.GetRepeatCommand() and prop.IsA("vtkSMIntVectorProperty"):
        return [0, 3, 1, 4, 1, 5]
    if prop.GetRepeatCommand():
        return [0, 1, 1, 0.25, -0.5, 0.75]
    if prop.IsA("vtkSMStringVectorProperty"):
        return ["another"]
    step = 1 if prop.IsA("vtkSMIntVectorProperty") else 0.125
    return [prop.GetElement(k) + step * (k + 1) for k in range(prop.GetNumberOfElements())]


def check_icon(name, hints):
    """Menu and pipeline browser show the icon that bears the proxy's name, unless built without Qt."""
    menu = hints.FindNestedElementByName("ShowInMenu").GetAttribute("icon")
    pipeline = hints.FindNestedElementByName("PipelineIcon")
    if menu or pipeline:
        assert menu == pipeline.GetAttribute("name") == f":/HybridTree/{name}.svg", (menu, pipeline)
    assert os.path.exists(os.path.join(ICONS, f"{name}.svg")), f"{name} has no icon"
    with open(os.path.join(ICONS, "HybridTreeIcons.qrc")) as file:
        assert f"<file>{name}.svg</file>" in file.read(), f"{name}.svg is not in the resource file"


def check(name):
    proxy = plugin.new_proxy(name)
    assert proxy, f"{name} is missing"
    words = LABELS.get(name, "HybridTree " + re.sub(r"(?<=[a-z])(?=[A-Z])", " ", name[len("HybridTree"):]))
    assert proxy.GetXMLLabel() == words, proxy.GetXMLLabel()
    assert proxy.GetDocumentation().GetDescription().strip(), f"{name} has no documentation"
    category = proxy.GetHints().FindNestedElementByName("ShowInMenu").GetAttribute("category")
    assert category == "HybridTree", f"{name} is in the menu {category}"
    check_icon(name, proxy.GetHints())

    found = dict(properties(proxy))
    assert NAMES[name] <= set(found), f"{name} has no {NAMES[name] - set(found)}"

    inputs = NAMES[name] & INPUTS if plugin.PROXIES[name] == "filters" else set()
    assert set(input_names(proxy)) == inputs, f"{name} takes {set(input_names(proxy))}"

    # Defaults of the XML, which are pushed to every new object, are those of the class.
    algorithm = proxy.GetClientSideObject()
    before = printed(algorithm.NewInstance())
    proxy.UpdateVTKObjects()
    after = printed(algorithm)
    differing = {key for key in found if before.get(key) != after.get(key)}
    assert not differing, f"{name}: the defaults of {differing} are not those of the class"

    for key, prop in found.items():
        documentation = prop.GetDocumentation()
        assert documentation and documentation.GetDescription().strip(), f"{name}.{key}: no documentation"
        if is_input(prop):
            assert prop.FindDomain("vtkSMDataTypeDomain"), f"{name}.{key}: no data type"
            continue
        # Scripts know a property by its label: it must be the name with its words apart.
        assert prop.GetXMLLabel().replace(" ", "") == key, f"{name}.{key}: label {prop.GetXMLLabel()}"
        iterator = prop.NewDomainIterator()
        iterator.Begin()
        assert not iterator.IsAtEnd(), f"{name}.{key}: no domain"

        value = other_value(prop)
        if prop.GetRepeatCommand():
            prop.SetNumberOfElements(len(value))
        for index, element in enumerate(value):
            prop.SetElement(index, element)
        proxy.UpdateVTKObjects()
        now = printed(algorithm)
        assert now.get(key) != after.get(key), f"{name}.{key} does not reach the VTK object: {now}"
    return len(found)


if __name__ == "__main__":
    servermanager.ProxyManager()
    total = sum(check(name) for name in plugin.PROXIES)
    print(f"{len(plugin.PROXIES)} proxies, {total} properties")
