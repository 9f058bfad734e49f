# SPDX-License-Identifier: BSD-3-Clause
"""Virtual restoration, after Figure 23 of the HybridTree paper: ridges of a scan are filled.

    xvfb-run -a pvpython examples/python/restored_igea.py [output folder]

Splines lie along the broken edge at the chin and the notch in the cheek, a point at the tip of the nose. Each
group blends with the scan inside its own region, and the rest of the scan stays as it is, triangle by triangle.
"""
import os

from figures import *  # heads, wings, arms; paraview.simple and our helpers

folder = output_folder("restored-igea")
view = make_view()
portrait_light(view)
look(view, direction=(0.0, -0.05, 1.0), focus=(0.0, -0.07, 0.2), distance=2.0)

scan = igea(folder)
scan.UpdatePipeline()
points = servermanager.Fetch(scan).GetPoints()


def on_face(x, y, depth):
    """The place at (x, y) so deep below the front of the scan: the middle of what is foremost around."""
    near = sorted(
        (p[2] for p in (points.GetPoint(k) for k in range(points.GetNumberOfPoints()))
         if abs(p[0] - x) < 0.012 and abs(p[1] - y) < 0.012 and p[2] > 0), reverse=True)
    return [x, y, (near[len(near) // 4] if near else 0.3) - depth]


def stroke(places, radius, depth):
    coordinates = [c for x, y in places for c in on_face(x, y, depth)]
    return HybridTreeSpline(Points=coordinates, SurfaceRadius=radius, InfluenceRadius=2.6 * radius)


picture(view, scan, os.path.join(folder, "before.png"), colour=MARBLE)
start = clock()
chin = HybridTreeBlend(registrationName="chin", Input=[
    stroke([(-0.058, -0.272), (-0.070, -0.300), (-0.072, -0.335), (-0.066, -0.378)], 0.013, 0.010),
    stroke([(-0.078, -0.285), (-0.088, -0.310), (-0.088, -0.340), (-0.080, -0.372)], 0.013, 0.006),
    stroke([(-0.096, -0.292), (-0.103, -0.315), (-0.102, -0.340)], 0.012, 0.006),
])
cheek = HybridTreeBlend(registrationName="cheek", Input=[
    stroke([(0.160, -0.178), (0.185, -0.182), (0.212, -0.174)], 0.008, 0.009),
    stroke([(0.165, -0.166), (0.190, -0.168), (0.210, -0.161)], 0.008, 0.009),
])
tip = on_face(0.022, -0.150, 0.012)
nose = HybridTreePoint(registrationName="nose", Center=tip, SurfaceRadius=0.022, InfluenceRadius=0.06)
regions = {
    "chin": HybridTreePoint(Center=on_face(-0.082, -0.325, 0.0), SurfaceRadius=0.085, InfluenceRadius=0.115),
    "cheek": HybridTreePoint(Center=on_face(0.187, -0.172, 0.0), SurfaceRadius=0.060, InfluenceRadius=0.085),
    "nose": HybridTreePoint(Center=tip, SurfaceRadius=0.060, InfluenceRadius=0.085),
}
restored = HybridTreeMeshField(registrationName="scan as a field", Input=scan, InfluenceRadius=0.03)
for name, cement in (("chin", chin), ("cheek", cheek), ("nose", nose)):
    restored = HybridTreeLocalBlend(
        registrationName=name + " restored", A=restored, B=cement, Region=regions[name], EdgeLength=0.006
    )
finish(restored, "restored Igea", start, volume=(0.05, 0.8))

blue = {"DiffuseColor": CEMENT, "AmbientColor": CEMENT}
picture(view, scan, os.path.join(folder, "cement.png"), colour=MARBLE, extra=[(chin, blue), (cheek, blue), (nose, blue)])
picture(view, restored, os.path.join(folder, "after.png"), colour=MARBLE)
