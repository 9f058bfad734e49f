// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/SpaceWarp.h"

#include <vector>

namespace hybridtree
{
namespace
{

constexpr double kTolerance = 0.01; // of the image's diagonal
constexpr double kRounding = 1e-12;

Box3 grown(const Box3& box, double margin)
{
  return Box3(Vec3(box.min().array() - margin), Vec3(box.max().array() + margin));
}

void appendEighths(const Box3& box, std::vector<Box3>& cells)
{
  const Vec3 middle = box.center();
  for (int corner = 0; corner < 8; ++corner)
  {
    Box3 cell = box;
    for (int axis = 0; axis < 3; ++axis)
    {
      ((corner >> axis) & 1 ? cell.min() : cell.max())[axis] = middle[axis];
    }
    cells.push_back(cell);
  }
}

} // namespace

Box3 widened(const Box3& box)
{
  if (box.isEmpty())
  {
    return box;
  }
  return grown(box, kRounding * (box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff()));
}

Box3 boundsByCells(const Box3& box, const std::function<CellImage(const Box3&)>& imageOf, int depth)
{
  if (box.isEmpty())
  {
    return box;
  }
  Box3 reached; // by images of cell centres: no bound can be smaller
  Box3 outermost;
  Box3 result;
  std::vector<Box3> cells{ box };
  for (int level = 0; level <= depth && !cells.empty(); ++level)
  {
    std::vector<Box3> images;
    images.reserve(cells.size());
    for (const Box3& cell : cells)
    {
      const CellImage image = imageOf(cell);
      reached.extend(image.center);
      images.push_back(image.bounds);
    }
    const double tolerance = kTolerance * reached.diagonal().norm();
    const Box3 enough = grown(reached, tolerance);
    std::vector<Box3> next;
    for (std::size_t k = 0; k < cells.size(); ++k)
    {
      if (level == 0)
      {
        outermost = images[k];
      }
      if (level == depth || enough.contains(images[k]))
      {
        result.extend(images[k]);
      }
      else
      {
        appendEighths(cells[k], next);
      }
    }
    cells.swap(next);
  }
  return widened(result.intersection(outermost));
}

} // namespace hybridtree
