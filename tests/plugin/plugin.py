# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the plugin share: it loads the plugin named by HYBRIDTREE_PLUGIN when imported."""
import os
import tempfile

from paraview import servermanager
from paraview import simple
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkFiltersCore import vtkFeatureEdges, vtkMassProperties

simple._DisableFirstRenderCameraReset()
simple.LoadPlugin(os.environ["HYBRIDTREE_PLUGIN"], remote=False, ns=globals())

PROXIES = {  # name: group. The label is the name with its words apart.
    "HybridTreePoint": "sources",
    "HybridTreeSegment": "sources",
    "HybridTreeCircle": "sources",
    "HybridTreeBox": "sources",
    "HybridTreeDisc": "sources",
    "HybridTreeCylinder": "sources",
    "HybridTreeHollowCylinder": "sources",
    "HybridTreeCone": "sources",
    "HybridTreeConeSphere": "sources",
    "HybridTreeRectangle": "sources",
    "HybridTreeTriangle": "sources",
    "HybridTreePolygon": "sources",
    "HybridTreeEllipsoid": "sources",
    "HybridTreeSpline": "sources",
    "HybridTreeSurfaceOfRevolution": "sources",
    "HybridTreeCurveSkeletons": "filters",
    "HybridTreePolygonFromOutline": "filters",
    "HybridTreeSurfaceOfRevolutionFromProfile": "filters",
    "HybridTreeSkeletonEditor": "sources",
    "HybridTreeSubdivisionSkeleton": "filters",
    "HybridTreeMeshField": "filters",
    "HybridTreeBlend": "filters",
    "HybridTreeLocalBlend": "filters",
    "HybridTreeBoolean": "filters",
    "HybridTreeTwist": "filters",
    "HybridTreeTaper": "filters",
    "HybridTreeBend": "filters",
    "HybridTreeAffineTransform": "filters",
    "HybridTreeFreeFormDeformation": "filters",
    "HybridTreeProbe": "filters",
}
if hasattr(simple, "HybridTreeSurfaceReconstruction") or "HybridTreeSurfaceReconstruction" in globals():
    PROXIES["HybridTreeSurfaceReconstruction"] = "filters"


def new_proxy(name):
    """A proxy that nobody has pushed a property of."""
    return servermanager.ProxyManager().SMProxyManager.NewProxy(PROXIES[name], name)


def run(proxy, port=0):
    """The data that a proxy makes, in this process.

    Asked of the VTK object too, as a view does: once a node downstream has run, ParaView's client takes
    this one for up to date, though that node asked only for its tree.
    """
    proxy.UpdatePipeline()
    algorithm = proxy.SMProxy.GetClientSideObject()
    algorithm.Update(port)
    return algorithm.GetOutputDataObject(port)


def open_edges(mesh):
    """Number of edges that do not have two triangles."""
    edges = vtkFeatureEdges()
    edges.SetInputData(mesh)
    edges.FeatureEdgesOff()
    edges.ManifoldEdgesOff()
    edges.BoundaryEdgesOn()
    edges.NonManifoldEdgesOn()
    edges.Update()
    return edges.GetOutput().GetNumberOfCells()


def volume(mesh):
    properties = vtkMassProperties()
    properties.SetInputData(mesh)
    return properties.GetVolume()


def check_solid(mesh, name=""):
    """Closed, with the arrays that every node gives."""
    assert mesh.GetNumberOfPolys() > 100, f"{name}: {mesh.GetNumberOfPolys()} triangles"
    assert open_edges(mesh) == 0, f"{name}: {open_edges(mesh)} open or non-manifold edges"
    assert volume(mesh) > 0, name
    assert mesh.GetPointData().GetArray("Normals"), name
    assert mesh.GetCellData().GetArray("SourceId"), name
    assert mesh.GetFieldData().GetAbstractArray("HybridTree"), name


class Messages:
    """Collects what VTK reports: with Messages() as messages: ...; messages.text."""

    def __enter__(self):
        self._before = vtkOutputWindow.GetInstance()
        self._window = vtkStringOutputWindow()
        vtkOutputWindow.SetInstance(self._window)
        return self

    def __exit__(self, *_):
        self.text = self._window.GetOutput()
        vtkOutputWindow.SetInstance(self._before)


def scratch():
    """A folder that goes away with the process."""
    global _folder
    _folder = tempfile.TemporaryDirectory()
    return _folder.name
