# SPDX-License-Identifier: BSD-3-Clause
"""PV_PLUGIN_PATH at the installed folder is all that pvpython needs, and the plugin is from there."""
import sys

from paraview import servermanager
from paraview.simple import HybridTreePoint

point = HybridTreePoint(SurfaceRadius=1, InfluenceRadius=2)
point.UpdatePipeline()
assert point.GetDataInformation().GetNumberOfCells() > 100

plugins = servermanager.vtkSMProxyManager.GetProxyManager().GetPluginManager().GetLocalInformation()
files = [plugins.GetPluginFileName(k) for k in range(plugins.GetNumberOfPlugins())
         if plugins.GetPluginName(k) == "HybridTree" and plugins.GetPluginLoaded(k)]
assert len(files) == 1 and files[0].startswith(sys.argv[1]), files
print("loaded", files[0])
