// SPDX-License-Identifier: BSD-3-Clause
// The part of Triangulator for polygons that rounding has folded or made touch themselves.
#include "core/boolean/Triangulate.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hybridtree
{
namespace
{

constexpr std::size_t kMost = 600; // corners: the work grows with their third power
constexpr int kAttempts = 8;
constexpr double kShape = 0x1p-44; // of squared sides, in areas: settles what folds leave open

} // namespace

double Triangulator::doubleArea(std::int32_t a, std::int32_t b, std::int32_t c) const
{
  const PlanarPoint& p = (*points_)[std::size_t(a)];
  const PlanarPoint& q = (*points_)[std::size_t(b)];
  const PlanarPoint& r = (*points_)[std::size_t(c)];
  return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
}

// Twice the area of triangles that are turned around, each of which another one covers again.
double Triangulator::foldedArea() const
{
  double folded = 0.0;
  for (const Triangle& corner : made_)
  {
    folded += std::max(0.0, -this->doubleArea(corner[0], corner[1], corner[2]));
  }
  return folded;
}

// Whether triangles are turned around by more than rounding does to their sides.
bool Triangulator::isFolded() const
{
  double sides = 0.0;
  for (std::size_t k = 0; k < polygon_.size(); ++k)
  {
    sides += std::sqrt(squaredDistance((*points_)[std::size_t(polygon_[k])],
      (*points_)[std::size_t(polygon_[(k + 1) % polygon_.size()])]));
  }
  return this->foldedArea() > this->tolerance() * sides;
}

// Of all triangulations of the polygon the one with the least area turned around (by dynamic
// programming, Klincsek 1980). The true polygon, before its points were rounded, has one with none.
bool Triangulator::unfold()
{
  const std::size_t count = polygon_.size();
  if (count > kMost)
  {
    return false;
  }
  const std::vector<Triangle> before = made_;
  const double folded = this->foldedArea();
  std::set<Side> forbidden;
  for (std::size_t k = 0; hasHoles_ && k < count; ++k)
  {
    forbidden.insert(std::minmax(polygon_[k], polygon_[(k + 1) % count]));
  }
  for (int attempt = 0; attempt < kAttempts && this->chooseLeastFolded(forbidden); ++attempt)
  {
    const std::optional<Side> repeated = hasHoles_ ? this->repeatedEdge() : std::nullopt;
    if (!repeated)
    {
      if (this->foldedArea() < folded)
      {
        return true;
      }
      break;
    }
    forbidden.insert(std::minmax(repeated->first, repeated->second));
  }
  made_ = before;
  return false;
}

// Fills made_. False where every way takes a diagonal that may not be.
bool Triangulator::chooseLeastFolded(const std::set<Side>& forbidden)
{
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::size_t count = polygon_.size();
  std::vector<double> least(count * count, kInfinity); // between corners i < j
  std::vector<std::int32_t> apex(count * count, -1);
  const auto mayBe = [&](std::size_t i, std::size_t j)
  {
    return j == i + 1 || (i == 0 && j + 1 == count) ||
      (this->mayJoin(polygon_[i], polygon_[j]) &&
        forbidden.count(std::minmax(polygon_[i], polygon_[j])) == 0);
  };
  for (std::size_t i = count; i-- > 0;)
  {
    for (std::size_t j = i + 1; j < count; ++j)
    {
      double& best = least[i * count + j];
      best = j == i + 1 ? 0.0 : kInfinity;
      if (!mayBe(i, j))
      {
        continue;
      }
      const double side =
        squaredDistance((*points_)[std::size_t(polygon_[i])], (*points_)[std::size_t(polygon_[j])]);
      for (std::size_t k = i + 1; k < j; ++k)
      {
        const double parts = least[i * count + k] + least[k * count + j];
        if (parts < best)
        {
          const double harm = parts + kShape * side +
            std::max(0.0, -this->doubleArea(polygon_[i], polygon_[k], polygon_[j]));
          if (harm < best)
          {
            best = harm;
            apex[i * count + j] = std::int32_t(k);
          }
        }
      }
    }
  }
  if (!(least[count - 1] < kInfinity))
  {
    return false;
  }
  made_.clear();
  std::vector<std::array<std::size_t, 2>> open = { { 0, count - 1 } };
  while (!open.empty())
  {
    const auto [i, j] = open.back();
    open.pop_back();
    if (j > i + 1)
    {
      const std::size_t k = std::size_t(apex[i * count + j]);
      made_.push_back({ polygon_[i], polygon_[k], polygon_[j] });
      open.push_back({ i, k });
      open.push_back({ k, j });
    }
  }
  return true;
}

} // namespace hybridtree
