// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/PlateLattice.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

using Stretch = std::pair<double, double>;

// Where the row at y is nearer than `margin` to the side from a to b: nowhere, or a stretch, as
// what is near a side is convex.
bool stretchNear(const Vec2& a, const Vec2& b, double margin, double y, Stretch& stretch)
{
  const double squared = margin * margin;
  double low = HUGE_VAL;
  double high = -HUGE_VAL;
  const auto cover = [&](double from, double to)
  {
    low = std::min(low, from);
    high = std::max(high, to);
  };
  for (const Vec2& end : { a, b })
  {
    const double room = squared - (y - end.y()) * (y - end.y());
    if (room > 0.0)
    {
      cover(end.x() - std::sqrt(room), end.x() + std::sqrt(room));
    }
  }
  const Vec2 edge = b - a;
  const double length = edge.norm();
  for (const double side : { margin, -margin })
  {
    // The side moved across by the margin.
    const Vec2 across = Vec2(edge.y(), -edge.x()) * (side / length);
    const double share = (y - a.y() - across.y()) / edge.y();
    if (edge.y() != 0.0 && share >= 0.0 && share <= 1.0)
    {
      const double x = a.x() + across.x() + share * edge.x();
      cover(x, x);
    }
  }
  stretch = { low, high };
  return low < high;
}

} // namespace

PlateLattice::PlateLattice(const std::vector<Vec2>& corners, double spacing, double margin)
  : spacing_(spacing), height_(std::sqrt(0.75) * spacing)
{
  Eigen::AlignedBox2d box;
  for (const Vec2& corner : corners)
  {
    box.extend(corner);
  }
  middle_ = box.center();
  rows_ = static_cast<int>(std::ceil(0.5 * box.sizes().y() / height_));
  for (int y = -rows_; y <= rows_; ++y)
  {
    firstOfRow_.push_back(static_cast<int>(runs_.size()));
    this->addRow(corners, margin, y);
  }
  firstOfRow_.push_back(static_cast<int>(runs_.size()));
}

void PlateLattice::addRow(const std::vector<Vec2>& corners, double margin, int y)
{
  const double height = middle_.y() + height_ * y;
  std::vector<double> crossings;
  std::vector<Stretch> near;
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    const Vec2& a = corners[k];
    const Vec2& b = corners[k + 1 == corners.size() ? 0 : k + 1];
    if (std::min(a.y(), b.y()) > height + margin || std::max(a.y(), b.y()) < height - margin)
    {
      continue;
    }
    if ((a.y() > height) != (b.y() > height))
    {
      crossings.push_back(a.x() + (height - a.y()) * (b.x() - a.x()) / (b.y() - a.y()));
    }
    Stretch stretch;
    if (stretchNear(a, b, margin, height, stretch))
    {
      near.push_back(stretch);
    }
  }
  std::sort(crossings.begin(), crossings.end());
  std::sort(near.begin(), near.end());
  const auto addRun = [&](double from, double to)
  {
    const double half = 0.5 * spacing_;
    int first = static_cast<int>(std::ceil((from - middle_.x()) / half));
    int last = static_cast<int>(std::floor((to - middle_.x()) / half));
    first += (first ^ y) & 1;
    last -= (last ^ y) & 1;
    if (first <= last)
    {
      runs_.push_back({ y, first, last, size_ });
      size_ += (last - first) / 2 + 1;
    }
  };
  std::size_t next = 0;
  double covered = -HUGE_VAL; // up to here by the stretches before the next one
  for (std::size_t k = 0; k + 1 < crossings.size(); k += 2)
  {
    double from = std::max(crossings[k], covered);
    for (; next < near.size() && near[next].first < crossings[k + 1]; ++next)
    {
      addRun(from, std::min(near[next].first, crossings[k + 1]));
      covered = std::max(covered, near[next].second);
      from = std::max(from, covered);
    }
    addRun(from, crossings[k + 1]);
  }
}

std::int32_t PlateLattice::numberAt(int x, int y) const
{
  if (std::abs(y) > rows_)
  {
    return -1;
  }
  const auto begin = runs_.begin() + this->firstOfRow(y);
  const auto end = runs_.begin() + this->firstOfRow(y + 1);
  const auto run =
    std::partition_point(begin, end, [x](const Run& candidate) { return candidate.last < x; });
  return run != end && run->first <= x ? run->number + (x - run->first) / 2 : -1;
}

} // namespace hybridtree
