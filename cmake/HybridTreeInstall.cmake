# SPDX-License-Identifier: BSD-3-Clause
# Headers, and the package that find_package(HybridTree) reads. Included once, from the top, before
# the modules: their exported targets name the core's.
include(CMakePackageConfigHelpers)

install(TARGETS hybridtree_core EXPORT HybridTreeCore
  LIBRARY DESTINATION "${HYBRIDTREE_LIBRARY_DIR}"
  ARCHIVE DESTINATION "${HYBRIDTREE_LIBRARY_DIR}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/core"
  DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/hybridtree"
  FILES_MATCHING PATTERN "*.h")
install(EXPORT HybridTreeCore
  DESTINATION "${HYBRIDTREE_CMAKE_DIR}" NAMESPACE hybridtree:: FILE HybridTreeCore-targets.cmake)
export(EXPORT HybridTreeCore
  NAMESPACE hybridtree:: FILE "${CMAKE_BINARY_DIR}/${HYBRIDTREE_CMAKE_DIR}/HybridTreeCore-targets.cmake")

configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/HybridTreeConfig.cmake.in"
  "${CMAKE_BINARY_DIR}/${HYBRIDTREE_CMAKE_DIR}/HybridTreeConfig.cmake"
  INSTALL_DESTINATION "${HYBRIDTREE_CMAKE_DIR}"
  NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file(
  "${CMAKE_BINARY_DIR}/${HYBRIDTREE_CMAKE_DIR}/HybridTreeConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES
  "${CMAKE_BINARY_DIR}/${HYBRIDTREE_CMAKE_DIR}/HybridTreeConfig.cmake"
  "${CMAKE_BINARY_DIR}/${HYBRIDTREE_CMAKE_DIR}/HybridTreeConfigVersion.cmake"
  DESTINATION "${HYBRIDTREE_CMAKE_DIR}")
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE"
  DESTINATION "${CMAKE_INSTALL_DATAROOTDIR}/licenses/HybridTree")

# PCL comes from a folder of the build: what is installed takes its libraries along.
if(HYBRIDTREE_BUILD_RECONSTRUCTION)
  foreach(library IN LISTS HybridTreePCL_LIBRARIES)
    install(CODE "file(INSTALL \"${library}\" DESTINATION
      \"\${CMAKE_INSTALL_PREFIX}/${HYBRIDTREE_LIBRARY_DIR}\" FOLLOW_SYMLINK_CHAIN)")
  endforeach()
endif()
