// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/MeshBvh.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hybridtree
{
namespace
{

constexpr std::size_t kBins = 16;
constexpr float kFarAway = 1e18f; // its square is still a float

struct FloatBox
{
  std::array<float, 3> lower{ kFarAway, kFarAway, kFarAway };
  std::array<float, 3> upper{ -kFarAway, -kFarAway, -kFarAway };

  void extend(const FloatBox& other)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      lower[axis] = std::min(lower[axis], other.lower[axis]);
      upper[axis] = std::max(upper[axis], other.upper[axis]);
    }
  }

  float halfArea() const
  {
    const float x = upper[0] - lower[0];
    const float y = upper[1] - lower[1];
    const float z = upper[2] - lower[2];
    return x < 0.0f ? 0.0f : x * y + y * z + z * x;
  }
};

struct Reference
{
  FloatBox box;
  std::int32_t triangle;

  float middle(std::size_t axis) const { return box.lower[axis] + box.upper[axis]; }
};

struct Range
{
  std::size_t begin;
  std::size_t end;
  FloatBox box;

  std::size_t size() const { return end - begin; }
};

float roundedDown(double value)
{
  const float near = float(value);
  return near <= value ? near : std::nextafter(near, -kFarAway);
}

float roundedUp(double value)
{
  const float near = float(value);
  return near >= value ? near : std::nextafter(near, kFarAway);
}

} // namespace

class MeshBvhBuilder
{
public:
  MeshBvhBuilder(MeshBvh& bvh, const TriangleMesh& mesh) : bvh_(bvh), mesh_(mesh)
  {
    Box3 bounds;
    for (const Triangle& corner : mesh.triangles)
    {
      for (const std::int32_t vertex : corner)
      {
        bounds.extend(mesh.points[std::size_t(vertex)]);
      }
    }
    bvh_.center_ = bounds.min() + 0.5 * bounds.sizes();
    bvh_.scale_ = 2.0 / std::max(bounds.sizes().maxCoeff(), std::numeric_limits<double>::min());
    this->makeReferences();
  }

  void build() { this->makeNode(this->whole()); }

private:
  void makeReferences()
  {
    references_.resize(mesh_.triangles.size());
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
    {
      Box3 box;
      for (const std::int32_t vertex : mesh_.triangles[t])
      {
        box.extend(bvh_.toLocal(mesh_.points[std::size_t(vertex)]));
      }
      references_[t].triangle = std::int32_t(t);
      for (int axis = 0; axis < 3; ++axis)
      {
        references_[t].box.lower[std::size_t(axis)] = roundedDown(box.min()[axis]);
        references_[t].box.upper[std::size_t(axis)] = roundedUp(box.max()[axis]);
      }
    }
  }

  Range whole() const
  {
    Range range{ 0, references_.size(), {} };
    for (const Reference& reference : references_)
    {
      range.box.extend(reference.box);
    }
    return range;
  }

  // Opens the child of largest area until there are eight or only leaves.
  std::uint32_t makeNode(const Range& range)
  {
    std::vector<Range> children{ range };
    while (children.size() < MeshBvh::kWidth)
    {
      std::size_t widest = children.size();
      float area = -1.0f;
      for (std::size_t k = 0; k < children.size(); ++k)
      {
        if (children[k].size() > MeshBvh::kWidth && children[k].box.halfArea() > area)
        {
          widest = k;
          area = children[k].box.halfArea();
        }
      }
      if (widest == children.size())
      {
        break;
      }
      const auto [left, right] = this->split(children[widest]);
      children[widest] = left;
      children.push_back(right);
    }
    const std::uint32_t index = std::uint32_t(bvh_.nodes_.size());
    bvh_.nodes_.emplace_back();
    for (std::size_t k = 0; k < MeshBvh::kWidth; ++k)
    {
      const bool used = k < children.size();
      std::uint32_t child = MeshBvh::kNone;
      if (used)
      {
        child = children[k].size() > MeshBvh::kWidth ? this->makeNode(children[k])
                                                     : this->makeLeaf(children[k]);
      }
      MeshBvh::Node& node = bvh_.nodes_[index];
      node.child[k] = child;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        node.lower[axis][k] = used ? children[k].box.lower[axis] : kFarAway;
        node.upper[axis][k] = used ? children[k].box.upper[axis] : kFarAway;
      }
    }
    return index;
  }

  std::uint32_t makeLeaf(const Range& range)
  {
    MeshBvh::Leaf leaf;
    leaf.count = std::uint32_t(range.size());
    for (std::size_t k = 0; k < MeshBvh::kWidth; ++k)
    {
      leaf.triangle[k] = references_[std::min(range.begin + k, range.end - 1)].triangle;
    }
    for (std::size_t k = 0; k < MeshBvh::kWidth; ++k)
    {
      this->fillFrame(leaf, k);
    }
    bvh_.leaves_.push_back(leaf);
    return MeshBvh::kLeafBit | std::uint32_t(bvh_.leaves_.size() - 1);
  }

  void fillFrame(MeshBvh::Leaf& leaf, std::size_t k) const
  {
    const Triangle& corner = mesh_.triangles[std::size_t(leaf.triangle[k])];
    const Vec3 a = bvh_.toLocal(mesh_.points[std::size_t(corner[0])]);
    const Vec3 ab =
      (mesh_.points[std::size_t(corner[1])] - mesh_.points[std::size_t(corner[0])]) * bvh_.scale_;
    const Vec3 ac =
      (mesh_.points[std::size_t(corner[2])] - mesh_.points[std::size_t(corner[0])]) * bvh_.scale_;
    const double length = ab.norm();
    const Vec3 u = ab / length;
    const Vec3 across = ac - ac.dot(u) * u;
    // A sliver without a direction across gets any: its points are on the edge to rounding.
    const Vec3 v = across.squaredNorm() > 0.0 ? across.normalized() : u.unitOrthogonal();
    const Vec3 normal = u.cross(v);
    const double x = ac.dot(u);
    const double y = std::max(0.0, ac.dot(v));
    const double last = std::hypot(x, y);
    const double middle = std::hypot(x - length, y);
    MeshBvh::Frame& frame = leaf.frame;
    for (int axis = 0; axis < 3; ++axis)
    {
      frame.origin[axis][k] = float(a[axis]);
      frame.u[axis][k] = float(u[axis]);
      frame.v[axis][k] = float(v[axis]);
      frame.normal[axis][k] = float(normal[axis]);
    }
    frame.length[0][k] = float(length);
    frame.length[1][k] = float(middle);
    frame.length[2][k] = float(last);
    frame.direction[0][0][k] = float(middle > 0.0 ? (x - length) / middle : 0.0);
    frame.direction[0][1][k] = float(middle > 0.0 ? y / middle : 0.0);
    frame.direction[1][0][k] = float(last > 0.0 ? x / last : 0.0);
    frame.direction[1][1][k] = float(last > 0.0 ? y / last : 0.0);
  }

  struct Cut
  {
    std::size_t axis = 0;
    std::size_t bin = 0;
    float cost = std::numeric_limits<float>::infinity();
  };

  struct Binning
  {
    float origin;
    float perLength;

    std::size_t operator()(float middle) const
    {
      return std::min(kBins - 1, std::size_t((middle - origin) * perLength));
    }
  };

  // Surface area heuristic over binned centres, or the median where all centres are one point.
  std::pair<Range, Range> split(const Range& range)
  {
    std::array<Binning, 3> binning;
    Cut best;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      float low = kFarAway * 2;
      float high = -kFarAway * 2;
      for (std::size_t k = range.begin; k < range.end; ++k)
      {
        low = std::min(low, references_[k].middle(axis));
        high = std::max(high, references_[k].middle(axis));
      }
      binning[axis] = { low, high > low ? kBins * 0.9999f / (high - low) : 0.0f };
      if (high > low)
      {
        this->tryAxis(range, axis, binning[axis], best);
      }
    }
    auto middle = references_.begin() + std::ptrdiff_t(range.begin + range.size() / 2);
    if (best.cost < std::numeric_limits<float>::infinity())
    {
      const Binning& bins = binning[best.axis];
      middle = std::partition(references_.begin() + std::ptrdiff_t(range.begin),
        references_.begin() + std::ptrdiff_t(range.end),
        [&](const Reference& reference) { return bins(reference.middle(best.axis)) <= best.bin; });
    }
    const std::size_t at = std::size_t(middle - references_.begin());
    return { this->bounded(range.begin, at), this->bounded(at, range.end) };
  }

  void tryAxis(const Range& range, std::size_t axis, const Binning& binning, Cut& best) const
  {
    std::array<FloatBox, kBins> box;
    std::array<std::size_t, kBins> count{};
    for (std::size_t k = range.begin; k < range.end; ++k)
    {
      const std::size_t bin = binning(references_[k].middle(axis));
      box[bin].extend(references_[k].box);
      ++count[bin];
    }
    std::array<float, kBins> rightCost{};
    FloatBox right;
    std::size_t rightCount = 0;
    for (std::size_t bin = kBins; bin-- > 1;)
    {
      right.extend(box[bin]);
      rightCount += count[bin];
      rightCost[bin - 1] = right.halfArea() * float(rightCount);
    }
    FloatBox left;
    std::size_t leftCount = 0;
    for (std::size_t bin = 0; bin + 1 < kBins; ++bin)
    {
      left.extend(box[bin]);
      leftCount += count[bin];
      const float cost = left.halfArea() * float(leftCount) + rightCost[bin];
      if (leftCount > 0 && leftCount < range.size() && cost < best.cost)
      {
        best = { axis, bin, cost };
      }
    }
  }

  Range bounded(std::size_t begin, std::size_t end) const
  {
    Range range{ begin, end, {} };
    for (std::size_t k = begin; k < end; ++k)
    {
      range.box.extend(references_[k].box);
    }
    return range;
  }

  MeshBvh& bvh_;
  const TriangleMesh& mesh_;
  std::vector<Reference> references_;
};

MeshBvh::MeshBvh(const TriangleMesh& mesh)
{
  MeshBvhBuilder(*this, mesh).build();
}

} // namespace hybridtree
