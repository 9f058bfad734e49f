# SPDX-License-Identifier: BSD-3-Clause
"""Real scans and meshes from Debian's package libcgal-demo, converted to files ParaView opens.

The package keeps them in one archive; convert(name, folder) unpacks one member and writes a .vtp beside
the example's output: points for .xyz and .pwn, polygons for .off.
"""
import os
import tarfile

from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

ARCHIVE = "/usr/share/doc/libcgal-dev/data.tar.gz"


def _read_points(lines):
    """One point a line, the first three numbers; a line with fewer (a leading count) is no point.

    Each gets a vertex, since ParaView draws nothing else.
    """
    points, vertices = vtkPoints(), vtkCellArray()
    for line in lines:
        words = line.split()
        if len(words) >= 3:
            vertices.InsertNextCell(1, [points.InsertNextPoint(*(float(word) for word in words[:3]))])
    data = vtkPolyData()
    data.SetPoints(points)
    data.SetVerts(vertices)
    return data


def _read_off(lines):
    words = " ".join(line.split("#")[0] for line in lines).split()
    if words[0] != "OFF":
        raise ValueError("not an OFF file")
    point_count, polygon_count = int(words[1]), int(words[2])
    points = vtkPoints()
    points.SetDataTypeToDouble()
    at = 4
    for _ in range(point_count):
        points.InsertNextPoint(*(float(word) for word in words[at : at + 3]))
        at += 3
    polygons = vtkCellArray()
    for _ in range(polygon_count):
        size = int(words[at])
        polygons.InsertNextCell(size)
        for word in words[at + 1 : at + 1 + size]:
            polygons.InsertCellPoint(int(word))
        at += 1 + size
    data = vtkPolyData()
    data.SetPoints(points)
    data.SetPolys(polygons)
    return data


def convert(name, folder):
    """Write folder/<stem>.vtp for a member such as "points_3/kitten.xyz"; returns its path."""
    stem, extension = os.path.splitext(os.path.basename(name))
    path = os.path.join(folder, stem + ".vtp")
    if os.path.exists(path) and os.path.getmtime(path) > os.path.getmtime(__file__):
        return path
    if not os.path.exists(ARCHIVE):
        raise SystemExit(f"{ARCHIVE} is missing: install Debian's package libcgal-demo")
    with tarfile.open(ARCHIVE) as archive:
        with archive.extractfile("data/" + name) as member:
            lines = member.read().decode("ascii", "replace").splitlines()
    os.makedirs(folder, exist_ok=True)
    writer = vtkXMLPolyDataWriter()
    writer.SetFileName(path)
    # The reader of Debian 12's ParaView fails on the default, appended data (its libexpat is newer).
    writer.SetDataModeToBinary()
    writer.SetInputData(_read_off(lines) if extension == ".off" else _read_points(lines))
    if not writer.Write():
        raise SystemExit(f"cannot write {path}")
    return path
