// SPDX-License-Identifier: BSD-3-Clause
#include "core/geometry/BoxUnion.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

using Boxes = std::vector<const Box3*>;

/// Sorted ends of the boxes along an axis.
std::vector<double> endsAlong(const Boxes& boxes, int axis)
{
  std::vector<double> ends;
  ends.reserve(2 * boxes.size());
  for (const Box3* box : boxes)
  {
    ends.push_back(box->min()[axis]);
    ends.push_back(box->max()[axis]);
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  return ends;
}

Boxes across(const Boxes& boxes, int axis, double low, double high)
{
  Boxes result;
  for (const Box3* box : boxes)
  {
    if (box->min()[axis] <= low && box->max()[axis] >= high)
    {
      result.push_back(box);
    }
  }
  return result;
}

double unionLength(Boxes boxes)
{
  std::sort(boxes.begin(), boxes.end(),
    [](const Box3* a, const Box3* b) { return a->min().z() < b->min().z(); });
  double length = 0.0;
  double end = boxes.empty() ? 0.0 : boxes.front()->min().z();
  for (const Box3* box : boxes)
  {
    const double top = box->max().z();
    if (top > end)
    {
      length += top - std::max(end, box->min().z());
      end = top;
    }
  }
  return length;
}

/// Measure of the union in the axes from `axis` on.
double measure(const Boxes& boxes, int axis)
{
  if (axis == 2 || boxes.empty())
  {
    return unionLength(boxes);
  }
  const std::vector<double> ends = endsAlong(boxes, axis);
  double sum = 0.0;
  for (std::size_t k = 0; k + 1 < ends.size(); ++k)
  {
    sum += (ends[k + 1] - ends[k]) * measure(across(boxes, axis, ends[k], ends[k + 1]), axis + 1);
  }
  return sum;
}

} // namespace

double unionVolume(const std::vector<Box3>& boxes)
{
  Boxes solid;
  for (const Box3& box : boxes)
  {
    if (!box.isEmpty())
    {
      solid.push_back(&box);
    }
  }
  return measure(solid, 0);
}

double overlapRatio(const Box3& box, const std::vector<Box3>& others)
{
  if (box.isEmpty())
  {
    return 0.0;
  }
  std::vector<Box3> shared;
  for (const Box3& other : others)
  {
    const Box3 overlap = box.intersection(other);
    if (other.contains(box))
    {
      return 1.0;
    }
    if (!overlap.isEmpty())
    {
      shared.push_back(overlap);
    }
  }
  const double volume = box.volume();
  if (!(volume > 0.0))
  {
    return shared.empty() ? 0.0 : 1.0;
  }
  return std::min(unionVolume(shared) / volume, 1.0);
}

} // namespace hybridtree
