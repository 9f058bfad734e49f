// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"

#include <cstdio>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace hybridtree::test
{

/// The points of a text file of Debian's libcgal-demo, such as "kitten.xyz": the first three
/// numbers of each line. Empty when the package is not there (the caller then skips, and says so).
inline std::optional<std::vector<Vec3>> demoPoints(const std::string& name)
{
  // Read through tar: the package ships its data packed.
  const std::string command =
    "tar -xzOf /usr/share/doc/libcgal-dev/data.tar.gz data/points_3/" + name + " 2>/dev/null";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::vector<Vec3> points;
  char line[512];
  while (pipe && std::fgets(line, sizeof line, pipe.get()))
  {
    std::istringstream words(line);
    Vec3 p;
    if (words >> p.x() >> p.y() >> p.z())
    {
      points.push_back(p);
    }
  }
  return points.empty() ? std::nullopt : std::optional(points);
}

} // namespace hybridtree::test
