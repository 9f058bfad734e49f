# SPDX-License-Identifier: BSD-3-Clause
"""The surfaces that two processes make together are those that one makes, triangle by triangle."""
import os
import subprocess
import sys
import tempfile
from collections import Counter

from vtkmodules.vtkIOXML import vtkXMLPPolyDataReader

PIECES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "pieces.py")


def save(folder, ranks, launcher, pvbatch):
    os.mkdir(folder)
    # pvpython has MPI started: what that leaves in the environment would make mpirun a part of it.
    environment = {name: value for name, value in os.environ.items()
        if name.startswith("OMPI_ALLOW") or not name.startswith(("OMPI_", "PMIX_"))}
    subprocess.run([*launcher, pvbatch, PIECES, folder, str(ranks)], env=environment, timeout=300, check=True)


def triangles(path):
    """Its triangles, each by its corners' coordinates from the lowest on, as often as they occur."""
    reader = vtkXMLPPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    mesh = reader.GetOutput()
    found = Counter()
    for k in range(mesh.GetNumberOfCells()):
        corners = [mesh.GetPoint(i) for i in map(mesh.GetCell(k).GetPointId, range(3))]
        first = corners.index(min(corners))
        found[tuple(corners[first:] + corners[:first])] += 1
    return found


def main(pvbatch, mpirun):
    # There may be one core only: Open MPI wants to be told that this is meant.
    launcher = [mpirun, "--oversubscribe", "--bind-to", "none", "-np", "2"]
    with tempfile.TemporaryDirectory() as home:
        one, two = os.path.join(home, "one"), os.path.join(home, "two")
        save(one, 1, [], pvbatch)
        save(two, 2, launcher, pvbatch)
        names = sorted(name for name in os.listdir(one) if name.endswith(".pvtp"))
        assert names and names == sorted(name for name in os.listdir(two) if name.endswith(".pvtp")), names
        for name in names:
            serial, parallel = triangles(os.path.join(one, name)), triangles(os.path.join(two, name))
            assert len(serial) > 100, f"{name}: {len(serial)} triangles"
            lost, added = serial - parallel, parallel - serial
            assert not lost and not added, f"{name}: {len(lost)} triangles lost, {len(added)} added by two processes"
            print(f"{name}: {sum(serial.values())} triangles, the same")


if __name__ == "__main__":
    main(*sys.argv[1:])
