# SPDX-License-Identifier: BSD-3-Clause
"""Starts the ParaView GUI on a screen of its own, has gui.py make three nodes, and compares the picture.

Tolerant on purpose: another OpenGL shades a little otherwise, a missing or dented shape does not pass.
"""
import os
import sys
import tempfile

import screen
from vtkmodules.vtkImagingCore import vtkImageDifference
from vtkmodules.vtkIOImage import vtkPNGReader

FOLDER = os.path.dirname(os.path.abspath(__file__))
BASELINE = os.path.join(FOLDER, "baselines", "blend.png")
# Summed over pixels, 1 for black against white, after 2 pixels of shift are forgiven.
ALLOWED = 50.0


def read(path):
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    return reader


def main():
    with tempfile.TemporaryDirectory() as home:
        picture = os.environ.get("HYBRIDTREE_PICTURE", os.path.join(home, "gui.png"))
        screen.run_paraview(sys.argv[1], ["--script=" + os.path.join(FOLDER, "gui.py")], home,
            HYBRIDTREE_PICTURE=picture)

        difference = vtkImageDifference()
        readers = read(picture), read(BASELINE)
        difference.SetInputConnection(readers[0].GetOutputPort())
        difference.SetImageConnection(readers[1].GetOutputPort())
        difference.Update()
        error = difference.GetThresholdedError()
        print(f"difference {error:.3f}, allowed {ALLOWED}")
        return 0 if error <= ALLOWED else 1


if __name__ == "__main__":
    sys.exit(main())
