// SPDX-License-Identifier: BSD-3-Clause
#include "core/polygonize/NearSurface.h"

#include <cmath>

namespace hybridtree
{
namespace
{

constexpr int kProbes = 6; // to each side, each four times as far as the one before
constexpr int kBisections = 18;

} // namespace

double excessAt(const FieldSource& field, const Vec3& p)
{
  double value = 0.0;
  field.field({ &p.x(), &p.y(), &p.z(), 1 }, &value);
  return value - kThreshold;
}

bool moveToSurface(const FieldSource& field, double reach, const Vec3& direction, Vec3& point)
{
  const auto isInside = [&](double way) { return excessAt(field, point + way * direction) >= 0.0; };
  const bool inside = isInside(0.0);
  double before = 0.0;
  for (int probe = 1; probe <= kProbes; ++probe)
  {
    const double step = reach * std::pow(0.25, kProbes - probe);
    for (const double way : { step, -step })
    {
      if (isInside(way) != inside)
      {
        double low = std::copysign(before, way);
        double high = way;
        for (int k = 0; k < kBisections; ++k)
        {
          const double middle = 0.5 * (low + high);
          (isInside(middle) == inside ? low : high) = middle;
        }
        point += 0.5 * (low + high) * direction;
        return true;
      }
    }
    before = step;
  }
  return false;
}

} // namespace hybridtree
