// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/LocalPart.h"

#include <unordered_map>

namespace hybridtree
{

LocalPart::LocalPart(const std::vector<Triangle>& part) : triangles(part)
{
  std::unordered_map<std::int32_t, std::int32_t> numbers;
  numbers.reserve(part.size());
  for (Triangle& corner : triangles)
  {
    for (std::int32_t& point : corner)
    {
      const auto [found, isNew] = numbers.try_emplace(point, std::int32_t(pointOf.size()));
      if (isNew)
      {
        pointOf.push_back(point);
      }
      point = found->second;
    }
  }
}

void LocalPart::write(const MeshLinks& links, std::vector<Triangle>& part) const
{
  for (std::size_t t = 0; t < links.triangleCount(); ++t)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      const std::int32_t point = links.triangle(t)[k];
      part[t][k] = point < 0 ? -1 : pointOf[std::size_t(point)];
    }
  }
}

} // namespace hybridtree
