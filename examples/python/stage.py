# SPDX-License-Identifier: BSD-3-Clause
"""What every example has in common: the plugin, a view with one look, and checks on what comes out."""
import os
import sys

import paraview.simple
from paraview.simple import *  # noqa: F401,F403 - the scripts read as a ParaView trace does

CLAY = [0.80, 0.72, 0.62]
GLAZE = [0.36, 0.53, 0.66]


BUILT = os.path.join(
    os.path.dirname(os.path.abspath(__file__)), "../../build/lib/paraview-5.11/plugins/HybridTree/HybridTree.so"
)


def load_plugin():
    """Load HybridTree.so: the one HYBRIDTREE_PLUGIN names, else the project's own build, else the
    one ParaView finds (installed, or by PV_PLUGIN_PATH). Returns the names it adds."""
    path = os.environ.get("HYBRIDTREE_PLUGIN", BUILT)
    if os.path.exists(path):
        LoadPlugin(path, remote=False, ns=globals())
    else:
        LoadDistributedPlugin("HybridTree", remote=False, ns=globals())
    return globals()


def output_folder(name):
    """demo-output/<name> below the working folder, or below the first argument."""
    base = sys.argv[1] if len(sys.argv) > 1 else "demo-output"
    folder = os.path.abspath(os.path.join(base, name))
    os.makedirs(folder, exist_ok=True)
    return folder


def make_view(size=(1200, 900)):
    view = CreateView("RenderView")
    paraview.simple._DisableFirstRenderCameraReset()  # look() says where from, also the first time
    view.ViewSize = list(size)
    view.UseColorPaletteForBackground = 0
    view.BackgroundColorMode = "Gradient"
    view.Background = [0.93, 0.94, 0.96]
    view.Background2 = [0.72, 0.77, 0.84]
    view.OrientationAxesVisibility = 0
    SetActiveView(view)
    return view


def look(view, direction, focus, distance, up=(0, 1, 0)):
    """Camera at focus + distance * direction (unit not needed)."""
    length = sum(d * d for d in direction) ** 0.5
    view.CameraFocalPoint = list(focus)
    view.CameraPosition = [f + distance * d / length for f, d in zip(focus, direction)]
    view.CameraViewUp = list(up)
    view.CameraParallelProjection = 0


def picture(view, shown, path, colour=CLAY, extra=(), fit=False):
    """Show only `shown` (a surface in one colour) and `extra` (proxy, representation settings); `fit`
    steps back until all of it is in this picture."""
    HideAll(view)
    display = Show(shown, view)
    display.Representation = "Surface"
    display.ColorArrayName = ["POINTS", ""]
    display.DiffuseColor = colour
    display.AmbientColor = colour
    display.Specular = 0.25
    display.SpecularPower = 30
    for proxy, settings in extra:
        other = Show(proxy, view)
        other.ColorArrayName = ["POINTS", ""]
        for key, value in settings.items():
            setattr(other, key, value)
    camera = list(view.CameraPosition), list(view.CameraFocalPoint)
    if fit:
        ResetCamera(view)
    Render(view)
    SaveScreenshot(path, view, ImageResolution=list(view.ViewSize))
    view.CameraPosition, view.CameraFocalPoint = camera
    print("  picture", os.path.relpath(path))


def check_closed(proxy, name):
    """Fail the script unless the surface is a closed mesh; print what a reader wants to know."""
    from vtkmodules.vtkFiltersCore import vtkFeatureEdges, vtkMassProperties

    data = servermanager.Fetch(proxy)
    edges = vtkFeatureEdges()
    edges.SetInputData(data)
    edges.FeatureEdgesOff()
    edges.ManifoldEdgesOff()
    edges.BoundaryEdgesOn()
    edges.NonManifoldEdgesOn()
    edges.Update()
    bad = edges.GetOutput().GetNumberOfCells()
    mass = vtkMassProperties()
    mass.SetInputData(data)
    mass.Update()
    print(
        f"{name}: {data.GetNumberOfPoints()} points, {data.GetNumberOfPolys()} triangles, "
        f"volume {mass.GetVolume():.5g}, {'closed' if bad == 0 else f'{bad} BAD EDGES'}"
    )
    if bad or data.GetNumberOfPolys() == 0:
        raise SystemExit(f"{name} is not a closed surface")
    return data
