// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/CleanResult.h"

#include "core/boolean/CompactResult.h"
#include "core/boolean/FlatTriangles.h"
#include "core/boolean/NearCut.h"
#include "core/boolean/VolumeSum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace hybridtree
{
namespace
{

constexpr double kTolerance = 0x1p-46;
// Of a tetrahedron's volume, as a share of the product of three lengths, and of a sum.
constexpr double kVolumeRounding = 0x1p-51;
constexpr double kSumRounding = 0x1p-52;
// Flat triangles of a component without thickness, in which two surfaces cross all around.
constexpr std::size_t kFewest = 4;

class Cleaner
{
public:
  explicit Cleaner(MeshBooleanResult& result) : result_(result), mesh_(result.mesh) {}

  void run(bool nearlyCoincide)
  {
    double largest = 0.0;
    for (const Vec3& p : mesh_.points)
    {
      largest = std::max(largest, p.cwiseAbs().maxCoeff());
    }
    tolerance_ = kTolerance * largest;
    const std::size_t flat = this->markFlat(nearlyCoincide);
    if (flat == 0 && !nearlyCoincide)
    {
      return;
    }
    becomes_.resize(mesh_.points.size());
    std::iota(becomes_.begin(), becomes_.end(), 0);
    if (flat >= kFewest)
    {
      this->dropThinComponents();
    }
    this->removeFlat(nearlyCoincide);
    compactResult(result_, becomes_);
  }

  void makeRoom(const std::vector<Vec3>& normals, double distance)
  {
    tolerance_ = distance;
    becomes_.resize(mesh_.points.size());
    std::iota(becomes_.begin(), becomes_.end(), 0);
    near_.assign(mesh_.points.size(), 0);
    std::fill(near_.begin() + std::ptrdiff_t(result_.firstCut), near_.end(), char(1));
    const std::vector<std::int32_t> part = this->partAround();
    std::vector<Triangle> corners;
    std::vector<std::int8_t> operand;
    std::vector<Vec3> facing;
    for (const std::int32_t t : part)
    {
      corners.push_back(mesh_.triangles[std::size_t(t)]);
      operand.push_back(result_.sourceOperand[std::size_t(t)]);
      facing.push_back(normals[std::size_t(t)]);
    }
    const auto isCut = [&](std::int32_t point) { return std::size_t(point) >= result_.firstCut; };
    NearCut nearCut(
      mesh_.points, std::move(corners), std::move(operand), std::move(facing), isCut, distance);
    nearCut.run();
    this->writeBack(part, nearCut);
    compactResult(result_, becomes_);
  }

private:
  bool isGone(const Triangle& t) const { return t[0] < 0; }

  bool isCut(const Triangle& corner) const
  {
    return std::any_of(corner.begin(), corner.end(),
      [&](std::int32_t point) { return std::size_t(point) >= result_.firstCut; });
  }

  // Marks the points of flat triangles, or all at the cut.
  std::size_t markFlat(bool all)
  {
    near_.assign(mesh_.points.size(), 0);
    std::size_t found = 0;
    for (const Triangle& c : mesh_.triangles)
    {
      if (!this->isCut(c))
      {
        continue;
      }
      const bool flat = this->isFlatNow(c);
      found += flat;
      if (flat || all)
      {
        for (const std::int32_t point : c)
        {
          near_[std::size_t(point)] = 1;
        }
      }
    }
    return found;
  }

  // By points that triangles share.
  std::vector<std::int32_t> components() const
  {
    std::vector<std::int32_t> parent(mesh_.points.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto find = [&](std::int32_t v)
    {
      while (parent[std::size_t(v)] != v)
      {
        v = parent[std::size_t(v)] = parent[std::size_t(parent[std::size_t(v)])];
      }
      return v;
    };
    for (const Triangle& c : mesh_.triangles)
    {
      for (const std::int32_t point : { c[1], c[2] })
      {
        const auto [low, high] = std::minmax({ find(c[0]), find(point) });
        parent[std::size_t(high)] = low;
      }
    }
    for (std::size_t v = 0; v < parent.size(); ++v)
    {
      parent[v] = find(std::int32_t(v));
    }
    return parent;
  }

  // Whether a triangle is no higher than the tolerance.
  bool isFlatNow(const Triangle& c) const
  {
    return isFlat(mesh_.points[std::size_t(c[0])], mesh_.points[std::size_t(c[1])],
      mesh_.points[std::size_t(c[2])], tolerance_);
  }

  // What is known of a component.
  struct Extent
  {
    double volume = 0.0;
    double area = 0.0;
    double rounding = 0.0; // of the volume, at most
    bool needsMore = false;
    VolumeSum more;
  };

  // Components whose volume is less than the tolerance times their area: nothing is between. Where
  // rounding hides which it is, as with long and narrow ones, the volume is summed again, so
  // precisely that what is left of it has no width.
  void dropThinComponents()
  {
    const std::vector<std::int32_t> component = this->components();
    std::vector<Extent> extents = this->extentsOf(component);
    for (const Triangle& c : mesh_.triangles)
    {
      const std::size_t root = std::size_t(component[std::size_t(c[0])]);
      if (extents[root].needsMore)
      {
        extents[root].more.add(mesh_.points[root], mesh_.points[std::size_t(c[0])],
          mesh_.points[std::size_t(c[1])], mesh_.points[std::size_t(c[2])]);
      }
    }
    for (Triangle& c : mesh_.triangles)
    {
      const Extent& extent = extents[std::size_t(component[std::size_t(c[0])])];
      const double thin = tolerance_ * extent.area;
      if (extent.needsMore ? std::abs(extent.more.value()) <= thin + extent.more.rounding()
                           : std::abs(extent.volume) <= thin)
      {
        c.fill(-1);
      }
    }
  }

  // Per component, at the point that stands for it.
  std::vector<Extent> extentsOf(const std::vector<std::int32_t>& component) const
  {
    std::vector<Extent> extents(mesh_.points.size());
    for (const Triangle& c : mesh_.triangles)
    {
      const std::size_t root = std::size_t(component[std::size_t(c[0])]);
      Extent& extent = extents[root];
      const Vec3& origin = mesh_.points[root];
      const Vec3 p = mesh_.points[std::size_t(c[0])] - origin;
      const Vec3 q = mesh_.points[std::size_t(c[1])] - origin;
      const Vec3 r = mesh_.points[std::size_t(c[2])] - origin;
      extent.volume += p.dot(q.cross(r)) / 6.0;
      extent.area += 0.5 * (q - p).cross(r - p).norm();
      extent.rounding +=
        kVolumeRounding * p.norm() * q.norm() * r.norm() + kSumRounding * std::abs(extent.volume);
    }
    for (Extent& extent : extents)
    {
      const double beyond = std::abs(std::abs(extent.volume) - tolerance_ * extent.area);
      extent.needsMore = !(beyond > extent.rounding);
    }
    return extents;
  }

  // Triangles around the marked points, two rings of them: those in the inner one may change.
  std::vector<std::int32_t> partAround()
  {
    for (char ring = 2; ring <= 3; ++ring)
    {
      std::vector<char> grown = near_;
      for (const Triangle& c : mesh_.triangles)
      {
        if (!this->isGone(c) &&
          std::any_of(
            c.begin(), c.end(), [&](std::int32_t point) { return near_[std::size_t(point)] != 0; }))
        {
          for (const std::int32_t point : c)
          {
            char& mark = grown[std::size_t(point)];
            mark = mark == 0 ? ring : mark;
          }
        }
      }
      near_.swap(grown);
    }
    std::vector<std::int32_t> part;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
    {
      const Triangle& c = mesh_.triangles[t];
      if (!this->isGone(c) &&
        std::any_of(c.begin(), c.end(),
          [&](std::int32_t point)
          { return near_[std::size_t(point)] == 1 || near_[std::size_t(point)] == 2; }))
      {
        part.push_back(std::int32_t(t));
      }
    }
    return part;
  }

  void removeFlat(bool unfolds)
  {
    const std::vector<std::int32_t> part = this->partAround();
    std::vector<Triangle> corners;
    for (const std::int32_t t : part)
    {
      corners.push_back(mesh_.triangles[std::size_t(t)]);
    }
    const auto rank = [&](std::int32_t point)
    { return std::size_t(point) >= result_.firstCut ? 1 : 0; };
    FlatTriangles flat(mesh_.points, std::move(corners), rank, tolerance_, unfolds);
    flat.remove();
    this->writeBack(part, flat);
  }

  template <class Change>
  void writeBack(const std::vector<std::int32_t>& part, const Change& change)
  {
    const std::vector<std::int8_t> operand = result_.sourceOperand;
    const std::vector<std::int32_t> source = result_.sourceTriangle;
    for (std::size_t k = 0; k < part.size(); ++k)
    {
      const std::size_t t = std::size_t(part[k]);
      const std::size_t from = std::size_t(part[std::size_t(change.place()[k])]);
      mesh_.triangles[t] = change.triangles()[k];
      result_.sourceOperand[t] = operand[from];
      result_.sourceTriangle[t] = source[from];
    }
    for (const std::array<std::int32_t, 2>& merge : change.merged())
    {
      becomes_[std::size_t(merge[0])] = merge[1];
    }
  }

  MeshBooleanResult& result_;
  TriangleMesh& mesh_;
  double tolerance_ = 0.0;
  std::vector<char> near_; // per point: 1 of a flat triangle, 2 and 3 of the rings around
  std::vector<std::int32_t> becomes_;
};

} // namespace

void cleanResult(MeshBooleanResult& result, bool nearlyCoincide)
{
  Cleaner(result).run(nearlyCoincide);
}

void makeRoomForCut(MeshBooleanResult& result, const std::vector<Vec3>& normals, double distance)
{
  Cleaner(result).makeRoom(normals, distance);
}

} // namespace hybridtree
