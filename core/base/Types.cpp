// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/Types.h"

#include <cmath>

namespace hybridtree
{

std::optional<double> similarityScale(const Affine3& map)
{
  const Mat3 gram = map.linear().transpose() * map.linear();
  const double squared = gram.trace() / 3.0;
  if (!(squared > 0.0) || !(gram - squared * Mat3::Identity()).isZero(1e-12 * squared))
  {
    return std::nullopt;
  }
  return std::sqrt(squared);
}

Box3 transformed(const Box3& box, const Affine3& map)
{
  if (box.isEmpty())
  {
    return box;
  }
  const Vec3 center = map * box.center();
  const Vec3 half = map.linear().cwiseAbs() * (0.5 * box.sizes());
  return Box3(Vec3(center - half), Vec3(center + half));
}

} // namespace hybridtree
