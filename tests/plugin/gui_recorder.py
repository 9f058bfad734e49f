# SPDX-License-Identifier: BSD-3-Clause
"""Inside the ParaView GUI of gui_session.py: a line of JSON about the pipeline, each time the mouse is at the left edge
of the view. (A command in ParaView's Python shell would clear the undo stack.)
"""
import json
import os

from paraview import simple


def elements(prop):
    return [prop.GetElement(k) for k in range(prop.GetNumberOfElements())]


def drawn(proxy):
    """What the view draws of a source, as vtkPVDataInformation; None if it is hidden."""
    display = simple.GetActiveView().SMProxy.FindRepresentation(proxy, 0)
    if not display or not display.GetProperty("Visibility").GetElement(0):
        return None
    return display.GetRepresentedDataInformation()


def describe(source):
    """Kind, triangles that are drawn and their bounds, inputs and numbers of a source."""
    proxy = source.SMProxy
    found = {"kind": proxy.GetXMLName(), "drawn": None}
    if data := drawn(proxy):
        found.update(drawn=data.GetNumberOfCells(), bounds=list(data.GetBounds()))
    iterator = proxy.NewPropertyIterator()
    iterator.Begin()
    while not iterator.IsAtEnd():
        prop = iterator.GetProperty()
        if prop.IsA("vtkSMInputProperty"):
            found[iterator.GetKey()] = [name(prop.GetProxy(k)) for k in range(prop.GetNumberOfProxies())]
        elif prop.IsA("vtkSMVectorProperty") and not prop.GetIsInternal() and not prop.GetInformationOnly():
            found[iterator.GetKey()] = elements(prop)
        iterator.Next()
    return found


def name(proxy):
    for (key, _), source in simple.GetSources().items():
        if source.SMProxy.GetGlobalID() == proxy.GetGlobalID():
            return key
    return None


def record(*_):
    line = {key: describe(source) for (key, _), source in simple.GetSources().items()}
    with open(os.environ["HYBRIDTREE_RECORD"], "a") as file:
        file.write(json.dumps(line) + "\n")


def watch(view):
    def moved(interactor, _):
        if interactor.GetEventPosition()[0] < 3:
            record()

    view.SMProxy.GetInteractor().AddObserver("MouseMoveEvent", moved)


if __name__ == "__main__":
    simple.LoadPlugin(os.environ["HYBRIDTREE_PLUGIN"], remote=False)
    if "HYBRIDTREE_SCAN" in os.environ:
        center, radius = json.loads(os.environ["HYBRIDTREE_SCAN"])
        simple.Show(simple.Sphere(registrationName="Scan", Center=center, Radius=radius, ThetaResolution=64,
            PhiResolution=65))
    watch(simple.GetActiveViewOrCreate("RenderView"))
