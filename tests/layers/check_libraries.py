# SPDX-License-Identifier: BSD-3-Clause
"""One VTK among the libraries of the plugin, and none where none belongs."""
import argparse
import re
import subprocess
import sys


def libraries(file):
    """Name to path of all that the loader would load with a file."""
    output = subprocess.run(["ldd", file], check=True, capture_output=True, text=True).stdout
    return dict(re.findall(r"^\s*(\S+) => (.+?)(?: \(0x[0-9a-f]+\))?$", output, re.MULTILINE))


def main():
    parser = argparse.ArgumentParser()
    for name in ("--core", "--filters", "--plugin"):
        parser.add_argument(name, required=True)
    arguments = parser.parse_args()
    wrong = []

    def forbid(file, pattern, why):
        wrong.extend(f"{file} loads {name}: {why}" for name in libraries(file) if re.match(pattern, name))

    forbid(arguments.core, r"lib(vtk|pcl|Qt|CGAL|gmp|mpfr)", "core is plain C++")
    forbid(arguments.filters, r"lib(pcl|Qt|CGAL|gmp|mpfr|vtkPV|vtkRemoting)", "filters know core and VTK only")
    forbid(arguments.plugin, r"libpcl_(io|surface|visualization)", "it brings a second VTK")

    found = libraries(arguments.plugin)
    wrong.extend(f"{name} is not found" for name, path in found.items() if path == "not found")
    cores = [path for name, path in found.items() if name.startswith("libvtkCommonCore")]
    if len(cores) != 1:
        wrong.append(f"the plugin needs one VTK and has {cores}")
    # libvtkCommonCore-pv5.11.so.1: one suffix for all, or another VTK has slipped in.
    # VTK's copy of DIY, which ParaView's GUI brings, has two variants for MPI and no suffix in any build.
    suffixes = {
        re.search(r"(-[^-]*)?\.so", name).group(1)
        for name in found
        if name.startswith("libvtk") and not name.startswith("libvtkmdiympi")
    }
    if len(suffixes) != 1:
        wrong.append(f"VTK libraries of several builds: {sorted(map(str, suffixes))}")

    print("\n".join(wrong) or f"{len(found)} libraries, one VTK")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
