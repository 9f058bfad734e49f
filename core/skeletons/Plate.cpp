// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/Plate.h"

#include "core/base/Error.h"
#include "core/geometry/PointTriangle.h"
#include "core/geometry/Predicates.h"
#include "core/mesh/PlanarTriangulation.h"
#include "core/skeletons/DistanceRange.h"
#include "core/skeletons/PlateMesh.h"
#include "core/skeletons/Validate.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <sstream>

namespace hybridtree
{
namespace
{

using Corners = std::vector<Vec2>;

// What rounding may move a corner by, as a share of the outline's size.
constexpr double kRounding = 1e-12;

double distanceToSide(const Vec2& p, const Vec2& a, const Vec2& b)
{
  const Vec2 edge = b - a;
  const double foot = std::clamp((p - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
  return (p - a - foot * edge).norm();
}

// Whether the sides from a to b and c to d cross, or touch to rounding.
bool sidesMeet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d, double rounding)
{
  const auto turn = [](const Vec2& p, const Vec2& q, const Vec2& r)
  { return orientation2d(p.x(), p.y(), q.x(), q.y(), r.x(), r.y()); };
  if (turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0)
  {
    return true;
  }
  return std::min({ distanceToSide(a, c, d), distanceToSide(b, c, d), distanceToSide(c, a, b),
           distanceToSide(d, a, b) }) <= rounding;
}

// Whether the side from a to b turns back on itself in the side from b to c.
bool foldsBack(const Vec2& a, const Vec2& b, const Vec2& c, double rounding)
{
  return (b - a).dot(c - b) < 0.0 &&
    std::min(distanceToSide(a, b, c), distanceToSide(c, a, b)) <= rounding;
}

void requireSimple(const std::string& name, const Corners& corners, double rounding)
{
  const std::size_t count = corners.size();
  const auto end = [&](std::size_t side) { return corners[(side + 1) % count]; };
  const auto refuse = [&](std::size_t a, std::size_t b)
  {
    std::ostringstream text;
    text << "an outline whose sides " << a << " and " << b << " meet";
    throw InvalidParameter(name, text.str(),
      "an outline that does not meet itself; put its points in order around the polygon");
  };
  // By their leftmost ends, so that only sides which overlap in x are compared.
  const auto left = [&](std::size_t side) { return std::min(corners[side].x(), end(side).x()); };
  const auto right = [&](std::size_t side) { return std::max(corners[side].x(), end(side).x()); };
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b) { return left(a) != left(b) ? left(a) < left(b) : a < b; });
  for (std::size_t i = 0; i < count; ++i)
  {
    for (std::size_t j = i + 1; j < count && left(order[j]) <= right(order[i]); ++j)
    {
      const auto [a, b] = std::minmax(order[i], order[j]);
      const bool follows = b == a + 1;
      if (follows || (a == 0 && b == count - 1))
      {
        const std::size_t first = follows ? a : b;
        if (foldsBack(corners[first], end(first), end((first + 1) % count), rounding))
        {
          refuse(a, b);
        }
      }
      else if (sidesMeet(corners[a], end(a), corners[b], end(b), rounding))
      {
        refuse(a, b);
      }
    }
  }
}

// Without repeated points, in order; what is closer than rounding is one point.
std::vector<Vec3> distinct(const std::vector<Vec3>& points, double rounding)
{
  std::vector<Vec3> result;
  for (const Vec3& point : points)
  {
    if (result.empty() || (point - result.back()).norm() > rounding)
    {
      result.push_back(point);
    }
  }
  while (result.size() > 1 && (result.back() - result.front()).norm() <= rounding)
  {
    result.pop_back();
  }
  return result;
}

// Twice the area long; about the middle, so that it keeps its digits far from the origin.
Vec3 newellNormal(const std::vector<Vec3>& points, const Vec3& middle)
{
  Vec3 normal = Vec3::Zero();
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    normal += (points[k] - middle).cross(points[(k + 1) % points.size()] - middle);
  }
  return normal;
}

// Along the longest side: the triangles of the faces line up with it.
Mat3 frameOf(const std::vector<Vec3>& points, const Vec3& normal)
{
  Vec3 longest = Vec3::Zero();
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    Vec3 side = points[(k + 1) % points.size()] - points[k];
    side -= normal.dot(side) * normal;
    // Sides of one length to rounding: the first of them.
    if (side.squaredNorm() > longest.squaredNorm() * (1.0 + 1e-12))
    {
      longest = side;
    }
  }
  Mat3 axes;
  axes.col(2) = normal;
  axes.col(1) = normal.cross(longest).normalized();
  axes.col(0) = axes.col(1).cross(normal).normalized();
  return axes;
}

Corners cornersOf(const PlateShape& shape)
{
  Corners corners;
  for (const PlateShape::Side& side : shape.sides)
  {
    corners.emplace_back(side.x, side.y);
  }
  return corners;
}

bool isConvex(const Corners& corners)
{
  const std::size_t count = corners.size();
  for (std::size_t k = 0; k < count; ++k)
  {
    const Vec2& a = corners[k];
    const Vec2& b = corners[(k + 1) % count];
    const Vec2& c = corners[(k + 2) % count];
    if (orientation2d(a.x(), a.y(), b.x(), b.y(), c.x(), c.y()) < 0)
    {
      return false;
    }
  }
  return true;
}

} // namespace

PlateShape plateThrough(const std::string& name, const std::vector<Vec3>& points, double tolerance)
{
  Box3 box;
  for (const Vec3& point : points)
  {
    box.extend(requireFinite(name, point));
  }
  const double size = points.empty() ? 0.0 : box.diagonal().stableNorm();
  const std::vector<Vec3> corners = distinct(points, kRounding * size);
  if (corners.size() < 3)
  {
    throw InvalidParameter(name, static_cast<double>(corners.size()),
      "at least 3 different points; use a segment or a point skeleton for fewer");
  }
  const Vec3 middle = box.center();
  const Vec3 area = newellNormal(corners, middle);
  if (!(area.norm() > 1e-9 * size * size))
  {
    throw InvalidParameter(name, "points on one line, or an outline without area",
      "the corners of a flat piece with an area; move a point off the line");
  }
  const Mat3 axes = frameOf(corners, area.normalized());
  double height = 0.0; // of the plane over the middle of the bounds
  for (const Vec3& corner : corners)
  {
    height += axes.col(2).dot(corner - middle) / double(corners.size());
  }
  const Vec3 origin = middle + height * axes.col(2);
  Corners flat;
  for (const Vec3& corner : corners)
  {
    const Vec3 local = axes.transpose() * (corner - origin);
    if (std::abs(local.z()) > tolerance * size)
    {
      std::ostringstream value;
      value << "not flat: a point is " << std::abs(local.z()) / size
            << " of the diagonal off their plane";
      std::ostringstream allowed;
      allowed << "in one plane to " << tolerance << " of the diagonal; move the points there";
      throw InvalidParameter(name, value.str(), allowed.str());
    }
    flat.emplace_back(local.x(), local.y());
  }
  requireSimple(name, flat, kRounding * size);
  return makePlate(origin, axes, flat);
}

PlateSkeleton::PlateSkeleton(const PlateShape& shape) : KernelSkeleton(shape)
{
  const Corners corners = cornersOf(shape_);
  if (isConvex(corners))
  {
    return;
  }
  const std::vector<Vec3> places = this->corners();
  for (const Triangle& t : triangulatePolygon(corners))
  {
    triangles_.push_back({ places[t[0]], places[t[1]], places[t[2]] });
  }
}

std::vector<Vec3> PlateSkeleton::corners() const
{
  std::vector<Vec3> corners;
  for (const PlateShape::Side& side : shape_.sides)
  {
    corners.push_back(shape_.origin + shape_.axes * Vec3(side.x, side.y, 0.0));
  }
  return corners;
}

Interval PlateSkeleton::distanceRange(const Box3& box) const
{
  if (triangles_.empty())
  {
    return convexDistanceRange(*this, box);
  }
  // Each triangle is convex: its distance is largest at a corner of the box, and above its tangent
  // plane at the centre.
  const Vec3 center = box.center();
  const Vec3 half = 0.5 * box.sizes();
  const double reach = half.norm();
  Interval range{ std::numeric_limits<double>::infinity(),
    std::numeric_limits<double>::infinity() };
  for (const auto& [a, b, c] : triangles_)
  {
    const NearestOnTriangle nearest = nearestOnTriangle(center, a, b, c);
    const double distance = std::sqrt(nearest.squaredDistance);
    if (distance - reach > range.max)
    {
      continue; // everywhere farther than another one
    }
    const Vec3 gradient =
      distance > 0.0 ? Vec3((center - nearest.point) / distance) : Vec3(Vec3::Zero());
    range.min = std::min(range.min, distance - gradient.cwiseAbs().dot(half));
    double most = 0.0;
    for (int corner = 0; corner < 8 && most < range.max; ++corner)
    {
      const Vec3 p = box.corner(static_cast<Box3::CornerType>(corner));
      most = std::max(most, std::sqrt(nearestOnTriangle(p, a, b, c).squaredDistance));
    }
    range.max = std::min(range.max, most);
  }
  return widenedByRounding(range, box, this->bounds());
}

Box3 PlateSkeleton::bounds() const
{
  Box3 box;
  for (const Vec3& corner : this->corners())
  {
    box.extend(corner);
  }
  return box;
}

std::optional<TriangleMesh> PlateSkeleton::offsetMesh(double radius, double edgeLength) const
{
  if (radius == 0.0)
  {
    return TriangleMesh(); // encloses nothing
  }
  return meshPlate(shape_, radius, edgeLength);
}

} // namespace hybridtree
