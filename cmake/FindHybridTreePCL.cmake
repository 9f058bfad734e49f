# SPDX-License-Identifier: BSD-3-Clause
# The parts of PCL that reconstruction/ uses, as one target: hybridtree::pcl.
#
# PCL's own package file is not used: it insists on VTK, whose Debian development files cannot be
# installed beside ParaView's. Looks in HYBRIDTREE_PCL_ROOT first (where setup.sh unpacks PCL), then in
# the system.
set(HYBRIDTREE_PCL_ROOT "${PROJECT_SOURCE_DIR}/build/deps/pcl/usr" CACHE PATH
  "Prefix of a PCL that is unpacked, not installed")

find_path(HYBRIDTREE_PCL_INCLUDE_DIR pcl/point_types.h
  HINTS "${HYBRIDTREE_PCL_ROOT}/include" PATH_SUFFIXES pcl-1.13 pcl-1.12 pcl-1.14 pcl)

set(hybridtree_pcl_variables HYBRIDTREE_PCL_INCLUDE_DIR)
set(HybridTreePCL_LIBRARIES "")
foreach(part common octree kdtree search sample_consensus filters features)
  find_library(HYBRIDTREE_PCL_${part}_LIBRARY pcl_${part}
    HINTS "${HYBRIDTREE_PCL_ROOT}/lib/${CMAKE_LIBRARY_ARCHITECTURE}" "${HYBRIDTREE_PCL_ROOT}/lib")
  list(APPEND hybridtree_pcl_variables HYBRIDTREE_PCL_${part}_LIBRARY)
  list(APPEND HybridTreePCL_LIBRARIES "${HYBRIDTREE_PCL_${part}_LIBRARY}")
endforeach()
mark_as_advanced(${hybridtree_pcl_variables})

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(HybridTreePCL REQUIRED_VARS ${hybridtree_pcl_variables}
  REASON_FAILURE_MESSAGE "demo.sh and test.sh unpack PCL on Debian 12. Elsewhere set HYBRIDTREE_PCL_ROOT, or switch HYBRIDTREE_BUILD_RECONSTRUCTION off")

if(HybridTreePCL_FOUND AND NOT TARGET hybridtree::pcl)
  find_package(Eigen3 3.3 REQUIRED NO_MODULE)
  find_package(Boost REQUIRED)
  find_path(HYBRIDTREE_FLANN_INCLUDE_DIR flann/flann.hpp REQUIRED)
  mark_as_advanced(HYBRIDTREE_FLANN_INCLUDE_DIR)

  # SYSTEM: PCL's headers are not ours to keep free of warnings.
  add_library(hybridtree_pcl INTERFACE)
  add_library(hybridtree::pcl ALIAS hybridtree_pcl)
  target_include_directories(hybridtree_pcl SYSTEM INTERFACE
    "${HYBRIDTREE_PCL_INCLUDE_DIR}" "${HYBRIDTREE_FLANN_INCLUDE_DIR}")
  target_link_libraries(hybridtree_pcl INTERFACE
    ${HybridTreePCL_LIBRARIES} Eigen3::Eigen Boost::headers)
endif()
