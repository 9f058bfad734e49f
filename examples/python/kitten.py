# SPDX-License-Identifier: BSD-3-Clause
"""A scanned kitten becomes a jug: the whole chain from points to a closed mesh.

    xvfb-run -a pvpython examples/python/kitten.py [output folder]

1. reconstruct   5,210 scanned points -> closed mesh (genus 1: the tail is a handle)
2. blend         two circle handles, blended only where two box regions allow it
3. cut           a triangle mesh (an elephant) carved out of the kitten's side by a Boolean
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
