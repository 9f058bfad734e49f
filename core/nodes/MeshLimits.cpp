// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/MeshLimits.h"

#include "core/base/Error.h"

#include <cmath>
#include <sstream>

namespace hybridtree
{
namespace
{

// Squares and cubes of lengths between these neither overflow nor vanish.
constexpr double kLargestCoordinate = 1e100;
constexpr double kSmallestSize = 1e-100;

std::string text(double value)
{
  std::ostringstream stream;
  stream << value;
  return stream.str();
}

} // namespace

double largestCoordinate(const Box3& box)
{
  return box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff();
}

bool holdsDigits(const Box3& box)
{
  return box.sizes().maxCoeff() >= kSmallestShare * largestCoordinate(box);
}

void requireRepresentable(const Box3& surface)
{
  // A box of no extent bounds no surface: what two solids share that touch in a point.
  if (surface.isEmpty() || surface.sizes().maxCoeff() == 0.0)
  {
    return;
  }
  const double largest = largestCoordinate(surface);
  if (!(largest <= kLargestCoordinate)) // also NaN
  {
    throw InvalidGeometry("The shape reaches out to a coordinate of " + text(largest) +
      "; at most " + text(kLargestCoordinate) +
      " can be meshed. Make its lengths and positions smaller.");
  }
  const double size = surface.sizes().maxCoeff();
  if (!holdsDigits(surface))
  {
    throw InvalidGeometry("The shape is " + text(size) + " in size at a coordinate of " +
      text(largest) + ", too far from the origin for double precision; its size must be at least " +
      text(kSmallestShare * largest) + " there. Move it towards the origin or enlarge it.");
  }
  if (size < kSmallestSize)
  {
    throw InvalidGeometry("The shape is " + text(size) + " in size; at least " +
      text(kSmallestSize) + " is needed for a mesh. Enlarge it.");
  }
}

void requireEdgeLength(double edgeLength)
{
  if (!std::isfinite(edgeLength) || edgeLength < 0.0)
  {
    throw InvalidParameter(
      "EdgeLength", edgeLength, "a finite length > 0, or 0 for the bounding diagonal / 100");
  }
  if (edgeLength > kLargestCoordinate)
  {
    throw InvalidParameter("EdgeLength", edgeLength, "at most 1e+100, as coordinates are");
  }
}

} // namespace hybridtree
