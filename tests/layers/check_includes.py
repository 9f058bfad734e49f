# SPDX-License-Identifier: BSD-3-Clause
"""Every #include of a room is one that the room may have (docs/architecture.md, Rooms), and every source
of core with a header beside it includes that one first: so its compilation shows that the header stands alone."""
import pathlib
import re
import sys

STANDARD = r"[a-z_0-9]+"  # <vector>, <cmath>: no slash, no dot
CORE_LIBRARIES = [STANDARD, r"Eigen/.*"]


def core(*rooms, extra=()):
    return CORE_LIBRARIES + [rf"core/{room}/.*" for room in rooms] + list(extra)


BELOW_NODES = ("base", "geometry", "mesh", "boolean", "skeletons", "polygonize", "stitch", "subdivision", "convolution")
SIMD = (r"hwy/.*", r"core/[a-z]+/[A-Za-z]+\.cpp")  # Highway compiles a source once per target
# What VTK calls itself, without ParaView's own classes.
VTK = [r"vtksys/.*", r"vtk(?!PV|SM|SI)[A-Za-z0-9]+\.h", r"HybridTree[A-Za-z]+Module\.h"]

ALLOWED = {
    "core/base": core("base", extra=(r"tbb/.*", r"oneapi/.*")),
    "core/geometry": core("base", "geometry", extra=SIMD),
    "core/mesh": core("base", "geometry", "mesh", extra=SIMD),
    "core/boolean": core("base", "geometry", "mesh", "boolean"),
    "core/skeletons": core("base", "geometry", "mesh", "skeletons", extra=SIMD),
    "core/polygonize": core("base", "geometry", "mesh", "polygonize", extra=SIMD),
    "core/stitch": core("base", "geometry", "mesh", "polygonize", "stitch", extra=SIMD),
    "core/subdivision": core("base", "geometry", "mesh", "polygonize", "stitch", "subdivision", "convolution"),
    "core/convolution": core("base", "geometry", "convolution", extra=SIMD),
    "core/nodes": core(*BELOW_NODES, "nodes", extra=SIMD),
    "core/tree": core(*BELOW_NODES, "nodes", "tree", extra=(r"nlohmann/.*",)),
    "filters": [STANDARD, r"core/.*", r"filters/.*", *VTK],
    # No pcl/surface, pcl/io or pcl/visualization: they bring a second VTK.
    "reconstruction": [STANDARD, r"Eigen/.*", r"core/.*", r"filters/.*", r"reconstruction/.*", r"CGAL/.*",
        r"boost/.*", r"pcl/(common|features|filters|kdtree|octree|search|sample_consensus)/.*", r"pcl/[a-z_]+\.h",
        r"sys/mman\.h", *VTK],  # for huge pages
}


INCLUDE = r'\s*#\s*include\s*[<"]([^>"]+)[>"]'


def includes_own_header_first(root, source):
    header = str(source.with_suffix(".h").relative_to(root))
    first = re.search(rf"^{INCLUDE}", source.read_text(), re.MULTILINE)
    return first is not None and first.group(1) == header


def main(root):
    count = 0
    wrong = []
    for source in sorted(root.glob("core/**/*.cpp")):
        if source.with_suffix(".h").exists() and not includes_own_header_first(root, source):
            wrong.append(f"{source.relative_to(root)}: does not include {source.stem}.h before all others")
    for room, patterns in ALLOWED.items():
        for source in sorted(root.glob(f"{room}/**/*")):
            if source.suffix not in (".h", ".cpp", ".cxx", ".hpp"):
                continue
            for number, line in enumerate(source.read_text().splitlines(), 1):
                match = re.match(INCLUDE, line)
                if not match:
                    continue
                count += 1
                if not any(re.fullmatch(pattern, match.group(1)) for pattern in patterns):
                    wrong.append(f"{source.relative_to(root)}:{number}: {room} may not include {match.group(1)}")
    print("\n".join(wrong) or f"{count} includes, all allowed")
    return 1 if wrong or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
