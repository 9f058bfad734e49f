# SPDX-License-Identifier: BSD-3-Clause
# The VTK modules (filters, and reconstruction when asked for) and the ParaView plugin that bundles
# them. Included once, from the top.
set(hybridtree_module_files "${PROJECT_SOURCE_DIR}/filters/vtk.module")
set(hybridtree_modules HybridTree::Filters)
if(HYBRIDTREE_BUILD_RECONSTRUCTION)
  list(APPEND hybridtree_module_files "${PROJECT_SOURCE_DIR}/reconstruction/vtk.module")
  list(APPEND hybridtree_modules HybridTree::Reconstruction)
endif()

vtk_module_scan(
  MODULE_FILES ${hybridtree_module_files}
  REQUEST_MODULES ${hybridtree_modules}
  PROVIDES_MODULES hybridtree_provided_modules
  HIDE_MODULES_FROM_CACHE ON
  ENABLE_TESTS OFF)

vtk_module_build(
  MODULES ${hybridtree_provided_modules}
  PACKAGE HybridTreeModules
  INSTALL_EXPORT HybridTreeModules
  ENABLE_WRAPPING ${HYBRIDTREE_BUILD_PLUGIN}
  HEADERS_DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/hybridtree"
  LIBRARY_DESTINATION "${HYBRIDTREE_LIBRARY_DIR}"
  ARCHIVE_DESTINATION "${HYBRIDTREE_LIBRARY_DIR}"
  RUNTIME_DESTINATION "${CMAKE_INSTALL_BINDIR}"
  CMAKE_DESTINATION "${HYBRIDTREE_CMAKE_DIR}"
  LICENSE_DESTINATION "${CMAKE_INSTALL_DATAROOTDIR}/licenses/HybridTree"
  HIERARCHY_DESTINATION "${CMAKE_INSTALL_LIBDIR}/vtk/hierarchy/HybridTree"
  TEST_DIRECTORY_NAME NONE)

if(HYBRIDTREE_BUILD_PLUGIN)
  paraview_plugin_scan(
    PLUGIN_FILES "${PROJECT_SOURCE_DIR}/plugin/paraview.plugin"
    PROVIDES_PLUGINS hybridtree_plugins
    ENABLE_BY_DEFAULT ON
    HIDE_PLUGINS_FROM_CACHE ON)

  # ParaView appends its plugin folder and the plugin's name to this by itself.
  set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}")
  paraview_plugin_build(
    PLUGINS ${hybridtree_plugins}
    AUTOLOAD ${hybridtree_plugins}
    PLUGINS_FILE_NAME hybridtree.plugins.xml
    LIBRARY_DESTINATION "${CMAKE_INSTALL_LIBDIR}"
    LIBRARY_SUBDIRECTORY "${PARAVIEW_PLUGIN_SUBDIR}")
  set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${HYBRIDTREE_LIBRARY_DIR}")
endif()
