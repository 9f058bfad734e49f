// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/EllipsoidMesh.h"

#include "core/skeletons/LongestEdge.h"
#include "core/skeletons/OffsetMesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace hybridtree
{
namespace
{

// Angles of the points of a quarter of an ellipse with half axes p and q, (p cos a, q sin a): even
// steps of the angle, and even steps of the normal's. So neither a flat side nor a sharp tip falls
// between two of them.
std::vector<double> anglesOfEllipse(double p, double q, int count)
{
  std::vector<double> angles;
  for (int k = 0; k <= count; ++k)
  {
    const double even = 0.5 * EIGEN_PI * k / count;
    angles.push_back(even);
    if (k > 0 && k < count)
    {
      angles.push_back(std::atan2(q * std::sin(even), p * std::cos(even)));
    }
  }
  std::sort(angles.begin(), angles.end());
  return angles;
}

struct SurfacePoint
{
  Vec3 place; // along the axes of the ellipsoid
  Vec3 normal;
};

// A function as a table, asked at growing inputs.
class Table
{
public:
  Table(const std::vector<double>& inputs, const std::vector<double>& outputs)
    : inputs_(inputs), outputs_(outputs)
  {
  }

  double operator()(double input)
  {
    while (k_ + 2 < inputs_.size() && inputs_[k_ + 1] < input)
    {
      ++k_;
    }
    const double step = inputs_[k_ + 1] - inputs_[k_];
    const double share = step > 0.0 ? std::clamp((input - inputs_[k_]) / step, 0.0, 1.0) : 0.0;
    return (1.0 - share) * outputs_[k_] + share * outputs_[k_ + 1];
  }

private:
  const std::vector<double>& inputs_;
  const std::vector<double>& outputs_;
  std::size_t k_ = 0;
};

// One octant of the surface. x is along the longest axis; `around` is the angle about it, from y to
// z, `up` the one from the equator to the pole.
class Octant
{
public:
  // \param detail steps in each direction, of the tables.
  Octant(const Vec3& radii, double offset, int detail) : radii_(radii), offset_(offset)
  {
    around_ = anglesOfEllipse(radii[1], radii[2], detail);
    for (const double around : around_)
    {
      const double width = std::hypot(radii[1] * std::cos(around), radii[2] * std::sin(around));
      Meridian meridian{ anglesOfEllipse(width, radii[0], detail), { 0.0 } };
      Vec3 last = this->at(around, 0.0).place;
      for (std::size_t k = 1; k < meridian.up.size(); ++k)
      {
        const Vec3 next = this->at(around, meridian.up[k]).place;
        meridian.length.push_back(meridian.length.back() + (next - last).norm());
        last = next;
      }
      longest_ = std::max(longest_, meridian.length.back());
      meridians_.push_back(std::move(meridian));
    }
  }

  double longestMeridian() const { return longest_; }
  const std::vector<double>& around() const { return around_; }

  SurfacePoint at(double around, double up) const
  {
    const double across = std::cos(up);
    const Vec3 place(radii_[0] * std::sin(up), radii_[1] * across * std::cos(around),
      radii_[2] * across * std::sin(around));
    // Times the square of the smallest radius, so that nothing overflows.
    const Vec3 normal =
      (place.array() * (radii_[2] / radii_.array()).square()).matrix().normalized();
    return { place + offset_ * normal, normal };
  }

  // The angles up, one for each of around(), below which a share of the meridian's length is.
  std::vector<double> level(double share) const
  {
    std::vector<double> up;
    for (const Meridian& meridian : meridians_)
    {
      up.push_back(Table(meridian.length, meridian.up)(share * meridian.length.back()));
    }
    return up;
  }

  // Lengths of the level's curve from y to each meridian.
  std::vector<double> lengths(const std::vector<double>& level) const
  {
    std::vector<double> result(1, 0.0);
    Vec3 last = this->at(around_[0], level[0]).place;
    for (std::size_t m = 1; m < around_.size(); ++m)
    {
      const Vec3 next = this->at(around_[m], level[m]).place;
      result.push_back(result.back() + (next - last).norm());
      last = next;
    }
    return result;
  }

private:
  struct Meridian
  {
    std::vector<double> up;
    std::vector<double> length;
  };

  Vec3 radii_;
  double offset_;
  double longest_ = 0.0;
  std::vector<double> around_;
  std::vector<Meridian> meridians_;
};

// Point k of a ring stands at the share (2k + shift) / (2 count) of the way around.
struct Ring
{
  int quarter = 0; // points in each quarter of it
  int shift = 0;
  int first = 0;

  int count() const { return 4 * quarter; }
};

class Rings
{
public:
  Rings(const EllipsoidShape& shape, const Octant& octant, double spacing)
    : shape_(shape), octant_(octant)
  {
    // Rows are that of an equilateral triangle apart.
    const int rows = std::max(
      1, static_cast<int>(std::ceil(octant.longestMeridian() / (std::sqrt(0.75) * spacing))));
    for (int k = 0; k < rows; ++k)
    {
      this->addRing(double(k) / rows, k, spacing);
    }
    this->addPoles();
    const bool mirrored = shape.axes.determinant() < 0.0;
    for (int k = 0; k + 1 < rows; ++k)
    {
      this->addStrip(upper_[k], upper_[k + 1], mirrored);
      this->addStrip(lower_[k], lower_[k + 1], !mirrored);
    }
    this->addFan(upper_.back(), static_cast<int>(mesh_.points.size()) - 2, mirrored);
    this->addFan(lower_.back(), static_cast<int>(mesh_.points.size()) - 1, !mirrored);
  }

  TriangleMesh take() { return std::move(mesh_); }

private:
  void addPoint(const SurfacePoint& p, const Vec3& signs)
  {
    mesh_.points.push_back(shape_.center + shape_.axes * p.place.cwiseProduct(signs));
    mesh_.normals.push_back(shape_.axes * p.normal.cwiseProduct(signs));
  }

  void addRing(double share, int k, double spacing)
  {
    const std::vector<double> level = octant_.level(share);
    const std::vector<double> lengths = octant_.lengths(level);
    Ring ring;
    ring.shift = k % 2;
    ring.quarter = std::max(1, static_cast<int>(std::ceil(lengths.back() / spacing)));
    const int q = ring.quarter;
    std::vector<SurfacePoint> quarter;
    Table around(lengths, octant_.around());
    Table up(octant_.around(), level);
    for (int j = 0; j + ring.shift <= q; ++j)
    {
      const double part = (2.0 * j + ring.shift) / (2.0 * q);
      // The ends bit for bit: there the other quarters meet.
      const double turn = around(part * lengths.back());
      SurfacePoint p = octant_.at(turn, up(turn));
      // In the planes of the mirrors, not beside them by rounding.
      const bool flat[3] = { k == 0, 2 * j + ring.shift == 2 * q, j + ring.shift == 0 };
      for (int axis = 0; axis < 3; ++axis)
      {
        p.place[axis] = flat[axis] ? 0.0 : p.place[axis];
        p.normal[axis] = flat[axis] ? 0.0 : p.normal[axis];
      }
      quarter.push_back(p);
    }
    for (const double side : { 1.0, -1.0 })
    {
      if (side < 0.0 && k == 0)
      {
        lower_.push_back(ring); // the equator is there once
        break;
      }
      ring.first = static_cast<int>(mesh_.points.size());
      (side > 0.0 ? upper_ : lower_).push_back(ring);
      for (int p = 0; p < 4 * q; ++p)
      {
        const int part = p / q;
        const int j = p % q;
        const bool back = part % 2 == 1;
        const Vec3 signs(side, part == 1 || part == 2 ? -1.0 : 1.0, part >= 2 ? -1.0 : 1.0);
        this->addPoint(quarter[static_cast<std::size_t>(back ? q - j - ring.shift : j)], signs);
      }
    }
  }

  void addPoles()
  {
    SurfacePoint pole = octant_.at(0.0, 0.5 * EIGEN_PI);
    pole.place = Vec3(pole.place[0], 0.0, 0.0);
    pole.normal = Vec3::UnitX();
    this->addPoint(pole, Vec3(1.0, 1.0, 1.0));
    this->addPoint(pole, Vec3(-1.0, 1.0, 1.0));
  }

  void add(int a, int b, int c, bool flip)
  {
    mesh_.triangles.push_back(flip ? Triangle{ a, c, b } : Triangle{ a, b, c });
  }

  // Triangles between two rings, advancing on the one whose next edge has its middle first. In
  // integers, so that the pattern is the same in each quarter.
  void addStrip(const Ring& a, const Ring& b, bool flip)
  {
    const auto id = [](const Ring& ring, int k) { return ring.first + k % ring.count(); };
    int i = 0;
    int j = 0;
    while (i < a.count() || j < b.count())
    {
      const std::int64_t middleA = std::int64_t(2 * i + 1 + a.shift) * b.count();
      const std::int64_t middleB = std::int64_t(2 * j + 1 + b.shift) * a.count();
      if (j == b.count() || (i < a.count() && middleA < middleB))
      {
        this->add(id(a, i), id(a, i + 1), id(b, j), flip);
        ++i;
      }
      else
      {
        this->add(id(a, i), id(b, j + 1), id(b, j), flip);
        ++j;
      }
    }
  }

  void addFan(const Ring& ring, int pole, bool flip)
  {
    for (int k = 0; k < ring.count(); ++k)
    {
      this->add(ring.first + k, ring.first + (k + 1) % ring.count(), pole, flip);
    }
  }

  const EllipsoidShape& shape_;
  const Octant& octant_;
  std::vector<Ring> upper_, lower_; // from the equator to the poles
  TriangleMesh mesh_;
};

} // namespace

std::optional<TriangleMesh> meshEllipsoid(
  const EllipsoidShape& ellipsoid, double radius, double edgeLength)
{
  // No more than the surface of the box around it.
  const Vec3 l = 2.0 * (ellipsoid.radii.array() + radius);
  requireModestCount(
    2.0 * (l[0] * l[1] + l[1] * l[2] + l[2] * l[0]) / (0.3 * edgeLength * edgeLength), edgeLength);
  const double detail = std::clamp(0.5 * l[0] / edgeLength, 32.0, 512.0);
  const Octant octant(ellipsoid.radii, radius, static_cast<int>(detail));
  for (double spacing = edgeLength; spacing > 0.4 * edgeLength;)
  {
    TriangleMesh mesh = Rings(ellipsoid, octant, spacing).take();
    const double longest = longestEdge(mesh);
    if (longest <= edgeLength)
    {
      return mesh;
    }
    spacing *= std::min(0.99, edgeLength / longest);
  }
  return std::nullopt;
}

} // namespace hybridtree
