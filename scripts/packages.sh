# SPDX-License-Identifier: BSD-3-Clause
# The Debian 12 packages that HybridTree is built with. Sourced by scripts/setup.sh.

# Compiler and build tools.
build_packages=(
  g++
  cmake
  ninja-build
  pkg-config
)

# What core/ and filters/ stand on.
library_packages=(
  libeigen3-dev
  libtbb-dev
  libhwy-dev
  nlohmann-json3-dev
)

# ParaView and what its CMake package looks for. Qt: the plugin's icons are compiled in, and they and
# most of ParaView's own are SVG, which Debian's ParaView does not bring the reader for.
paraview_packages=(
  paraview
  paraview-dev
  python3-paraview
  qtbase5-dev
  libqt5svg5
  libopenmpi-dev
  openmpi-bin
  libpython3-dev
  libutfcpp-dev
  libdouble-conversion-dev
  libexpat1-dev
  liblz4-dev
  liblzma-dev
  zlib1g-dev
)

# Reconstruction. PCL itself is unpacked beside ParaView, see below.
reconstruction_packages=(
  libcgal-dev
  libflann-dev
  libboost-dev
  libboost-filesystem-dev
  libboost-serialization-dev
  libboost-system-dev
)

# Tests, the picture they draw (a software OpenGL and a screen that nobody sees) and real scans.
test_packages=(
  libgtest-dev
  libgl1-mesa-dri
  xvfb
  xauth
  libcgal-demo
)

# libpcl-dev depends on libvtk9-dev, which cannot be installed together with python3-paraview: PCL is
# downloaded and unpacked, not installed. None of these libraries touches VTK.
pcl_packages=(
  libpcl-dev
  libpcl-common1.13
  libpcl-features1.13
  libpcl-filters1.13
  libpcl-kdtree1.13
  libpcl-octree1.13
  libpcl-sample-consensus1.13
  libpcl-search1.13
)
