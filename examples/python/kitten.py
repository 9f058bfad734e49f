# SPDX-License-Identifier: BSD-3-Clause
"""A scanned kitten becomes a jug: the whole chain from points to a closed mesh.

    xvfb-run -a pvpython examples/python/kitten.py [output folder]

1. reconstruct   5,210 scanned points -> closed mesh (genus 1: the tail is a handle)
2. blend         two circle handles, blended only where two box regions allow it
3. cut           a triangle mesh (a twisted ring) carved out of the cheek by a Boolean
4. deform        a 3 x 4 x 3 free-form lattice leans the whole jug

Leaves a picture of every stage, jug.vtp (opens as a live tree), jug.stl and jug.pvsm.
"""
import os

from scans import convert
from stage import *  # paraview.simple and our helpers

folder = output_folder("kitten")
globals().update(load_plugin())
view = make_view()
look(view, direction=(0.9, 0.35, 1.0), focus=(0, 0, 0), distance=2.2)

# 1. A scan: points, no polygons.
scan = XMLPolyDataReader(registrationName="scan", FileName=[convert("points_3/kitten.xyz", folder)])
kitten = HybridTreeSurfaceReconstruction(registrationName="kitten", Input=scan)
picture(view, kitten, os.path.join(folder, "1-reconstructed.png"))
check_closed(kitten, "1 reconstructed kitten")

# 2. Two handles. The scan gets a field of its own, wide enough to meet the handles.
body = HybridTreeMeshField(registrationName="body", Input=kitten, InfluenceRadius=0.08)
handles = HybridTreeBoolean(
    registrationName="handles",
    Operation="Union",
    A=HybridTreeCircle(Center=[-0.24, -0.02, 0.02], Normal=[0, 0, 1], Radius=0.17, SurfaceRadius=0.035, InfluenceRadius=0.1),
    B=HybridTreeCircle(Center=[0.26, -0.02, 0.02], Normal=[0, 0, 1], Radius=0.17, SurfaceRadius=0.035, InfluenceRadius=0.1),
)
region = HybridTreeBox(
    registrationName="region", Center=[0, -0.02, 0.02], Lengths=[0.56, 0.4, 0.2], SurfaceRadius=0.02, InfluenceRadius=0.08
)
jug = HybridTreeLocalBlend(registrationName="jug", A=body, B=handles, Region=region, EdgeLength=0.008)
picture(view, jug, os.path.join(folder, "2-handles.png"))
check_closed(jug, "2 kitten with handles")

# 3. A Boolean with a triangle mesh: a twisted ring, shrunk, turned and pressed into the cheek.
ring = XMLPolyDataReader(registrationName="ring", FileName=[convert("meshes/knot2.off", folder)])
placed = HybridTreeAffineTransform(
    registrationName="placed ring", Input=ring, Scale=[0.35, 0.35, 0.35], Rotate=[0, 42, 0], Translate=[0.14, 0.2, 0.125]
)
carved = HybridTreeBoolean(registrationName="carved", A=jug, B=placed, Operation="Difference A - B", EdgeLength=0.006)
picture(view, carved, os.path.join(folder, "3-carved.png"))
check_closed(carved, "3 carved kitten")

# 4. A free-form deformation: the top row of control points leans over and grows.
displacements = []
for i in range(3):
    for k in range(3):
        displacements += [i, 3, k, 0.18 + 0.06 * (i - 1), 0.06, 0.08 * (k - 1)]
        displacements += [i, 2, k, 0.05, 0.0, 0.0]
leaning = HybridTreeFreeFormDeformation(
    registrationName="leaning", Input=carved, LatticeDimensions=[3, 4, 3], Displacements=displacements, EdgeLength=0.006
)
lattice = OutputPort(leaning, 1)
picture(
    view, leaning, os.path.join(folder, "4-deformed.png"), colour=GLAZE, fit=True,
    extra=[(lattice, {"Representation": "Wireframe", "AmbientColor": [0.25, 0.25, 0.3], "LineWidth": 1.5})],
)
check_closed(leaning, "4 deformed kitten")
picture(view, leaning, os.path.join(folder, "jug.png"), colour=GLAZE)

# Not appended: the XML parser of Debian 12 refuses to read ParaView's appended data back.
SaveData(os.path.join(folder, "jug.vtp"), proxy=leaning, DataMode="Binary")
SaveData(os.path.join(folder, "jug.stl"), proxy=leaning)
SaveState(os.path.join(folder, "jug.pvsm"))

# The file is the model: open it, and it can still be blended, cut and bent.
again = XMLPolyDataReader(registrationName="reloaded", FileName=[os.path.join(folder, "jug.vtp")])
drilled = HybridTreeBoolean(
    registrationName="drilled", A=again, Operation="Difference A - B", EdgeLength=0.008,
    B=HybridTreeSegment(Point1=[0.1, 0.25, -1], Point2=[0.1, 0.25, 1], SurfaceRadius=0.04, InfluenceRadius=0.1),
)
check_closed(drilled, "5 reloaded and drilled")
# For the picture alone: points at the rims are doubled, so that both sides are shaded by themselves.
drilled.PointNormals = "Split"
picture(view, drilled, os.path.join(folder, "5-reloaded-and-drilled.png"), colour=GLAZE)
