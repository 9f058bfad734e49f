// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/EllipsoidMesh.h"

#include "core/mesh/AddTriangle.h"
#include "core/skeletons/LongestEdge.h"
#include "core/skeletons/OffsetMesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace hybridtree
{
namespace
{

// Angles as unit vectors (cos, sin): no angle is ever asked for.
using Turn = Eigen::Vector2d;

// Turns a of the points (p cos a, q sin a) of a quarter of an ellipse: even steps of the angle, and
// even steps of the normal's. So neither a flat side nor a sharp tip falls between two of them.
std::vector<Turn> turnsOfEllipse(double p, double q, const std::vector<Turn>& even)
{
  std::vector<Turn> turns = even;
  for (std::size_t k = 1; k + 1 < even.size(); ++k)
  {
    turns.push_back(Turn(p * even[k].x(), q * even[k].y()).normalized());
  }
  // Both halves rise.
  std::inplace_merge(turns.begin(), turns.begin() + static_cast<std::ptrdiff_t>(even.size()),
    turns.end(), [](const Turn& a, const Turn& b) { return a.x() * b.y() - a.y() * b.x() > 0.0; });
  return turns;
}

// Steps of a table over a quarter. More don't make the edges more even.
int tableSize(double radius, double edgeLength)
{
  return static_cast<int>(std::clamp(0.5 * radius / edgeLength, 8.0, 64.0));
}

std::vector<Turn> evenTurns(int count)
{
  std::vector<Turn> turns;
  for (int k = 0; k <= count; ++k)
  {
    const double angle = 0.5 * EIGEN_PI * k / count;
    turns.emplace_back(std::cos(angle), std::sin(angle));
  }
  turns.back() = Turn(0.0, 1.0);
  return turns;
}

struct SurfacePoint
{
  Vec3 place; // along the axes of the ellipsoid
  Vec3 normal;
};

// Turns by length, asked at growing lengths.
class Table
{
public:
  Table(const std::vector<double>& lengths, const std::vector<Turn>& turns)
    : lengths_(&lengths), turns_(&turns)
  {
  }

  Turn operator()(double length)
  {
    const std::vector<double>& lengths = *lengths_;
    while (k_ + 2 < lengths.size() && lengths[k_ + 1] < length)
    {
      ++k_;
    }
    const double step = lengths[k_ + 1] - lengths[k_];
    const double share = step > 0.0 ? std::clamp((length - lengths[k_]) / step, 0.0, 1.0) : 0.0;
    return ((1.0 - share) * (*turns_)[k_] + share * (*turns_)[k_ + 1]).normalized();
  }

private:
  const std::vector<double>* lengths_;
  const std::vector<Turn>* turns_;
  std::size_t k_ = 0;
};

// One octant of the surface. x is along the longest axis; `around` is the angle about it, from y to
// z, `up` the one from the equator to the pole.
class Octant
{
public:
  Octant(const Vec3& radii, double offset, double edgeLength)
    : radii_(radii), slopes_((radii[2] / radii.array()).square()), offset_(offset)
  {
    around_ =
      turnsOfEllipse(radii[1], radii[2], evenTurns(tableSize(radii[1] + offset, edgeLength)));
    const std::vector<Turn> even = evenTurns(tableSize(radii[0] + offset, edgeLength));
    for (const Turn& around : around_)
    {
      const double width = std::hypot(radii[1] * around.x(), radii[2] * around.y());
      Meridian meridian{ turnsOfEllipse(width, radii[0], even), { 0.0 } };
      Vec3 last = this->at(around, meridian.up[0]).place;
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
  const std::vector<Turn>& around() const { return around_; }

  SurfacePoint at(const Turn& around, const Turn& up) const
  {
    const Vec3 place(
      radii_[0] * up.y(), radii_[1] * up.x() * around.x(), radii_[2] * up.x() * around.y());
    const Vec3 normal = place.cwiseProduct(slopes_).normalized();
    return { place + offset_ * normal, normal };
  }

  // For each of around(), up by length.
  std::vector<Table> tables() const
  {
    std::vector<Table> tables;
    for (const Meridian& meridian : meridians_)
    {
      tables.emplace_back(meridian.length, meridian.up);
    }
    return tables;
  }
  double meridianLength(std::size_t index) const { return meridians_[index].length.back(); }

private:
  struct Meridian
  {
    std::vector<Turn> up;
    std::vector<double> length;
  };

  Vec3 radii_;
  Vec3 slopes_; // of the normal to the place, times the square of the smallest radius: no overflow
  double offset_;
  double longest_ = 0.0;
  std::vector<Turn> around_;
  std::vector<Meridian> meridians_;
};

// A quarter of a ring, up to the next mirror. Point k stands at the share (2k + shift) / (2 count)
// of the way around.
struct Row
{
  std::vector<SurfacePoint> points;
  int quarter = 0; // points of the ring in each quarter
  int shift = 0;

  int count() const { return 4 * quarter; }
};

// From the equator to the pole, without it.
class Rows
{
public:
  Rows(const Octant& octant, double spacing) : octant_(octant), up_(octant.tables())
  {
    // Those of equilateral triangles.
    const int count = std::max(
      1, static_cast<int>(std::ceil(octant.longestMeridian() / (std::sqrt(0.75) * spacing))));
    for (int k = 0; k < count; ++k)
    {
      this->addRow(double(k) / count, k, spacing);
    }
  }

  const std::vector<Row>& get() const { return rows_; }

private:
  void addRow(double share, int k, double spacing)
  {
    // The curve around at this share of each meridian's length.
    const std::vector<Turn>& around = octant_.around();
    level_.clear();
    lengths_.clear();
    Vec3 last = Vec3::Zero();
    for (std::size_t m = 0; m < around.size(); ++m)
    {
      level_.push_back(up_[m](share * octant_.meridianLength(m)));
      const Vec3 next = octant_.at(around[m], level_[m]).place;
      lengths_.push_back(m == 0 ? 0.0 : lengths_.back() + (next - last).norm());
      last = next;
    }
    Row row;
    row.shift = k % 2;
    row.quarter = std::max(1, static_cast<int>(std::ceil(lengths_.back() / spacing)));
    const int q = row.quarter;
    Table turnAt(lengths_, around);
    Table upAt(lengths_, level_);
    for (int j = 0; j + row.shift <= q; ++j)
    {
      const double length = (2.0 * j + row.shift) / (2.0 * q) * lengths_.back();
      SurfacePoint p = octant_.at(turnAt(length), upAt(length));
      // In the planes of the mirrors, not beside them by rounding.
      const bool flat[3] = { k == 0, 2 * j + row.shift == 2 * q, j + row.shift == 0 };
      for (int axis = 0; axis < 3; ++axis)
      {
        p.place[axis] = flat[axis] ? 0.0 : p.place[axis];
        p.normal[axis] = flat[axis] ? 0.0 : p.normal[axis];
      }
      row.points.push_back(p);
    }
    rows_.push_back(std::move(row));
  }

  const Octant& octant_;
  std::vector<Table> up_;
  std::vector<Turn> level_; // of the row at hand
  std::vector<double> lengths_;
  std::vector<Row> rows_;
};

// Visits the triangles between two rows, advancing on the one whose next edge has its middle first.
// In integers, so that the pattern is the same in each quarter. visit(i, j, onA): from edge (i, j)
// between them on to (i + 1, j), or else (i, j + 1).
template <class Visit>
void walkStrip(const Row& a, const Row& b, int quarters, const Visit& visit)
{
  const std::int64_t stepA = 2 * b.count();
  const std::int64_t stepB = 2 * a.count();
  std::int64_t middleA = std::int64_t(1 + a.shift) * b.count();
  std::int64_t middleB = std::int64_t(1 + b.shift) * a.count();
  const int endA = quarters * a.quarter;
  const int endB = quarters * b.quarter;
  int i = 0;
  int j = 0;
  while (i < endA || j < endB)
  {
    const bool onA = j == endB || (i < endA && middleA < middleB);
    visit(i, j, onA);
    i += onA;
    j += !onA;
    middleA += onA ? stepA : 0;
    middleB += onA ? 0 : stepB;
  }
}

// Longest edge, but for those across the mirrors.
double longestWithin(const std::vector<Row>& rows)
{
  double squared = 0.0;
  for (std::size_t k = 0; k + 1 < rows.size(); ++k)
  {
    const std::vector<SurfacePoint>& a = rows[k].points;
    const std::vector<SurfacePoint>& b = rows[k + 1].points;
    walkStrip(rows[k], rows[k + 1], 1,
      [&](int i, int j, bool)
      {
        const auto u = static_cast<std::size_t>(i);
        const auto v = static_cast<std::size_t>(j);
        if (u < a.size() && v < b.size())
        {
          squared = std::max(squared, (a[u].place - b[v].place).squaredNorm());
        }
      });
    for (std::size_t u = 0; u + 1 < a.size(); ++u)
    {
      squared = std::max(squared, (a[u].place - a[u + 1].place).squaredNorm());
    }
  }
  return std::sqrt(squared);
}

// The whole surface, of an octant and its mirror images.
class Mirrors
{
public:
  Mirrors(const EllipsoidShape& shape, const std::vector<Row>& rows, const SurfacePoint& pole)
    : shape_(shape), rows_(rows)
  {
    this->reserve();
    for (const Row& row : rows)
    {
      this->addRing(row, 1.0, upper_);
    }
    lower_ = { upper_.front() }; // the equator is there once
    for (std::size_t k = 1; k < rows.size(); ++k)
    {
      this->addRing(rows[k], -1.0, lower_);
    }
    const int top = static_cast<int>(mesh_.points.size());
    this->addPoint(pole, Vec3(1.0, 1.0, 1.0));
    this->addPoint(pole, Vec3(-1.0, 1.0, 1.0));
    const bool mirrored = shape.axes.determinant() < 0.0;
    this->addHalf(upper_, top, mirrored);
    this->addHalf(lower_, top + 1, !mirrored);
  }

  TriangleMesh take() { return std::move(mesh_); }

private:
  void reserve()
  {
    std::size_t points = 2;
    for (const Row& row : rows_)
    {
      points += 2 * static_cast<std::size_t>(row.count());
    }
    mesh_.points.reserve(points);
    mesh_.normals.reserve(points);
    mesh_.triangles.reserve(2 * points);
  }

  void addPoint(const SurfacePoint& p, const Vec3& signs)
  {
    mesh_.points.push_back(shape_.center + shape_.axes * p.place.cwiseProduct(signs));
    mesh_.normals.push_back(shape_.axes * p.normal.cwiseProduct(signs));
  }

  void addRing(const Row& row, double side, std::vector<int>& first)
  {
    first.push_back(static_cast<int>(mesh_.points.size()));
    const int q = row.quarter;
    for (int quarter = 0; quarter < 4; ++quarter)
    {
      const Vec3 signs(side, quarter == 1 || quarter == 2 ? -1.0 : 1.0, quarter >= 2 ? -1.0 : 1.0);
      for (int j = 0; j < q; ++j)
      {
        this->addPoint(
          row.points[static_cast<std::size_t>(quarter % 2 == 1 ? q - j - row.shift : j)], signs);
      }
    }
  }

  void addHalf(const std::vector<int>& first, int pole, bool flip)
  {
    const auto add = [&](int a, int b, int c)
    { addTriangle(mesh_.triangles, a, flip ? c : b, flip ? b : c); };
    for (std::size_t k = 0; k + 1 < rows_.size(); ++k)
    {
      const int endA = rows_[k].count();
      const int endB = rows_[k + 1].count();
      walkStrip(rows_[k], rows_[k + 1], 4,
        [&](int i, int j, bool onA)
        {
          const int a = first[k] + (i < endA ? i : 0);
          const int b = first[k + 1] + (j < endB ? j : 0);
          add(a,
            onA ? first[k] + (i + 1 < endA ? i + 1 : 0) : first[k + 1] + (j + 1 < endB ? j + 1 : 0),
            b);
        });
    }
    const int last = rows_.back().count();
    for (int k = 0; k < last; ++k)
    {
      add(first.back() + k, first.back() + (k + 1) % last, pole);
    }
  }

  const EllipsoidShape& shape_;
  const std::vector<Row>& rows_;
  std::vector<int> upper_, lower_; // first point of each ring, from the equator to the poles
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
  const Octant octant(ellipsoid.radii, radius, edgeLength);
  const SurfacePoint pole{ Vec3(ellipsoid.radii[0] + radius, 0.0, 0.0), Vec3::UnitX() };
  for (double spacing = edgeLength; spacing > 0.4 * edgeLength;)
  {
    const Rows rows(octant, spacing);
    double longest = longestWithin(rows.get());
    if (longest <= edgeLength)
    {
      TriangleMesh mesh = Mirrors(ellipsoid, rows.get(), pole).take();
      longest = longestEdge(mesh);
      if (longest <= edgeLength)
      {
        return mesh;
      }
    }
    spacing *= std::min(0.99, edgeLength / longest);
  }
  return std::nullopt;
}

} // namespace hybridtree
