// SPDX-License-Identifier: BSD-3-Clause
#include "core/polygonize/LevelBounds.h"

#include <queue>
#include <vector>

namespace hybridtree
{
namespace
{

constexpr int kMostBoxes = 4000; // of one side

// How far boxes go towards one side.
struct Outermost
{
  int axis;
  bool towardsMax;

  double operator()(const Box3& box) const
  {
    return towardsMax ? box.max()[axis] : -box.min()[axis];
  }
  bool operator()(const Box3& a, const Box3& b) const { return (*this)(a) < (*this)(b); }
};

// Coordinate of that side, to be multiplied by -1 for a lower one; false where all is below level.
bool findSide(const FieldSource& field, double level, const Box3& within, double tolerance,
  const Outermost& side, double& found)
{
  std::priority_queue<Box3, std::vector<Box3>, Outermost> boxes(side);
  const auto push = [&](const Box3& box)
  {
    if (field.range(box).max >= level)
    {
      boxes.push(box);
    }
  };
  push(within);
  for (int count = 0; !boxes.empty(); ++count)
  {
    const Box3 box = boxes.top();
    found = side(box);
    if (count == kMostBoxes || box.sizes().maxCoeff() <= tolerance)
    {
      return true;
    }
    boxes.pop();
    Eigen::Index axis;
    box.sizes().maxCoeff(&axis);
    Box3 half = box;
    half.max()[axis] = box.center()[axis];
    push(half);
    half = box;
    half.min()[axis] = box.center()[axis];
    push(half);
  }
  return false;
}

} // namespace

Box3 levelBounds(const FieldSource& field, double level, const Box3& within, double tolerance)
{
  Box3 result;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!findSide(field, level, within, tolerance, { axis, false }, result.min()[axis]) ||
      !findSide(field, level, within, tolerance, { axis, true }, result.max()[axis]))
    {
      return {};
    }
    result.min()[axis] *= -1.0;
  }
  return result;
}

} // namespace hybridtree
