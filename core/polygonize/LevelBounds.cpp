// SPDX-License-Identifier: BSD-3-Clause
#include "core/polygonize/LevelBounds.h"

#include "core/base/Parallel.h"

#include <array>
#include <queue>
#include <vector>

namespace hybridtree
{
namespace
{

constexpr int kMostBoxes = 4000; // of one side
constexpr double kLarge = 32.0;  // tolerances: larger boxes are halved without a look

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
  boxes.push(within);
  for (int count = 0; !boxes.empty();)
  {
    const Box3 box = boxes.top();
    boxes.pop();
    if (box.sizes().maxCoeff() <= kLarge * tolerance && field.range(box).max < level)
    {
      continue; // asked for no sooner: most boxes are never the outermost
    }
    found = side(box);
    if (count++ == kMostBoxes || box.sizes().maxCoeff() <= tolerance)
    {
      return true;
    }
    Eigen::Index axis;
    box.sizes().maxCoeff(&axis);
    Box3 half = box;
    half.max()[axis] = box.center()[axis];
    boxes.push(half);
    half = box;
    half.min()[axis] = box.center()[axis];
    boxes.push(half);
  }
  return false;
}

} // namespace

Box3 levelBounds(const FieldSource& field, double level, const Box3& within, double tolerance)
{
  constexpr std::size_t kSides = 6;
  std::array<double, kSides> found{};
  std::array<char, kSides> isFound{};
  parallelFor(kSides, 1,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t k = begin; k < end; ++k)
      {
        const Outermost side{ static_cast<int>(k / 2), k % 2 != 0 };
        isFound[k] = findSide(field, level, within, tolerance, side, found[k]) ? 1 : 0;
      }
    });
  Box3 result;
  for (std::size_t k = 0; k < kSides; k += 2)
  {
    if (!isFound[k] || !isFound[k + 1])
    {
      return {};
    }
    result.min()[static_cast<Eigen::Index>(k / 2)] = -found[k];
    result.max()[static_cast<Eigen::Index>(k / 2)] = found[k + 1];
  }
  return result;
}

} // namespace hybridtree
