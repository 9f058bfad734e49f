// SPDX-License-Identifier: BSD-3-Clause
#include "core/polygonize/CreaseJudge.h"

#include "core/base/Scratch.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

// Shares of the way from the point back to the places. After the last one it is told.
constexpr double kWays[] = { 0.5, 0.2, 0.1 };

constexpr double kLeastShare = 0.5; // of the first angle, that a crease has from near
constexpr double kMostTurn = 0.45;  // of it, that is not at once yet

/// A pair on its way.
struct Look
{
  CreasePair* pair;
  Vec3 from[2];
  double angle;
  double turnInward = 0.0; ///< at most, of either normal from one step to the next
};

/// Takes in the planes next to the point, seen from nearer. \return whether it can be seen from
/// nearer still.
bool approach(const TouchingPlane (&near)[2], double reach, Look& look)
{
  CreasePair& pair = *look.pair;
  for (int k = 0; k < 2; ++k)
  {
    if (!near[k].normal.allFinite() || !(std::abs(near[k].ahead) <= reach))
    {
      return false;
    }
    look.turnInward =
      std::max(look.turnInward, angleBetween(pair.planes[k].normal, near[k].normal));
    pair.planes[k] = near[k];
  }
  const Meeting meeting = meetingOf({ near[0], near[1] }, pair.point, reach);
  pair.point = meeting.found ? meeting.point : pair.point;
  return true;
}

void tell(double leastAngle, Look& look)
{
  CreasePair& pair = *look.pair;
  const double across = angleBetween(pair.planes[0].normal, pair.planes[1].normal);
  pair.mostTurn = std::max(look.turnInward, across);
  pair.isRound = across < std::max(leastAngle, kLeastShare * look.angle) &&
    pair.mostTurn <= std::max(leastAngle, kMostTurn * look.angle);
}

} // namespace

double angleBetween(const Vec3& a, const Vec3& b)
{
  return std::acos(std::clamp(a.dot(b), -1.0, 1.0));
}

void judgeCreasePairs(
  const FieldSource& field, double leastAngle, double reach, std::vector<CreasePair>& pairs)
{
  std::vector<Look> looks;
  looks.reserve(pairs.size());
  for (CreasePair& pair : pairs)
  {
    looks.push_back({ &pair, { pair.planes[0].at, pair.planes[1].at },
      angleBetween(pair.planes[0].normal, pair.planes[1].normal) });
  }
  for (const double way : kWays)
  {
    ScratchVectors points(2 * looks.size()), gradients(2 * looks.size());
    ScratchArray values(2 * looks.size());
    for (std::size_t k = 0; k < points.points().size; ++k)
    {
      const Look& look = looks[k / 2];
      points.batch().set(k, look.pair->point + way * (look.from[k % 2] - look.pair->point));
    }
    field.fieldAndGradient(points.points(), values.data(), gradients.batch());
    std::size_t left = 0;
    for (std::size_t k = 0; k < looks.size(); ++k)
    {
      TouchingPlane near[2];
      for (std::size_t n = 2 * k; n < 2 * k + 2; ++n)
      {
        near[n % 2] = TouchingPlane::of(points.points()[n], values[n], gradients.points()[n]);
      }
      if (approach(near, reach, looks[k]))
      {
        looks[left++] = looks[k];
      }
    }
    looks.erase(looks.begin() + std::ptrdiff_t(left), looks.end());
  }
  for (Look& look : looks)
  {
    tell(leastAngle, look);
  }
}

} // namespace hybridtree
