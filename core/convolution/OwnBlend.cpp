// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/OwnBlend.h"

#include "core/convolution/BlendRows.h"

#include <algorithm>

namespace hybridtree
{

void ownBlend(const PiecesNear& pieces, std::int32_t group, PointBatch points, double* value,
  const VectorBatch* gradient)
{
  std::vector<char> isMember(pieces.groupCount(), 0);
  const auto add = [&](std::int32_t member)
  {
    if (pieces.find(member) >= 0)
    {
      isMember[static_cast<std::size_t>(pieces.find(member))] = 1;
    }
  };
  add(group);
  const auto& others = pieces.groups().places.neighbours[static_cast<std::size_t>(group)];
  std::for_each(others.begin(), others.end(), add);
  for (std::size_t begin = 0; begin < points.size; begin += BlendRows::kMostPoints)
  {
    const PointBatch part =
      points.slice(begin, std::min(BlendRows::kMostPoints, points.size - begin));
    BlendRows rows(pieces, isMember, part, gradient != nullptr);
    std::copy_n(rows.sum(), part.size, value + begin);
    if (gradient)
    {
      const VectorBatch slopes = rows.gradient();
      for (std::size_t k = 0; k < part.size; ++k)
      {
        gradient->set(begin + k, slopes[k]);
      }
    }
  }
}

} // namespace hybridtree
