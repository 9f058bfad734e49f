# SPDX-License-Identifier: BSD-3-Clause
"""Run by the ParaView GUI at its start: three nodes as a user makes them, then a picture and the end."""
import os

from paraview.simple import *

LoadPlugin(os.environ["HYBRIDTREE_PLUGIN"], remote=False, ns=globals())

ball = HybridTreePoint(Center=[0, 0, 0], SurfaceRadius=0.6, InfluenceRadius=1.2)
bar = HybridTreeSegment(Point1=[-1.2, 0.2, 0], Point2=[1.2, 0.2, 0], SurfaceRadius=0.25, InfluenceRadius=0.6)
blend = HybridTreeBlend(Input=[ball, bar], EdgeLength=0.05)

view = GetActiveViewOrCreate("RenderView")
view.OrientationAxesVisibility = 0
view.UseColorPaletteForBackground = 0
view.Background = [1, 1, 1]
display = Show(blend, view)
display.ColorArrayName = [None, ""]
view.CameraPosition = [1.5, -1.5, 5]
view.CameraFocalPoint = [0, 0.1, 0]
view.CameraViewUp = [0, 1, 0]
Render(view)
SaveScreenshot(os.environ["HYBRIDTREE_PICTURE"], view, ImageResolution=[400, 300])
os._exit(0)
