// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/NearestKernels.h"

#include <algorithm>
#include <cmath>
#include <limits>

// Compiled once per instruction set; three of them cover the field.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/mesh/NearestKernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target, as Highway wants it.
#include "core/mesh/TriangleKernels-inl.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hybridtree
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kStack = 1024; // entries; a node adds at most 7 and trees are some 10 deep

// Below this many points a node on average, a packet costs more than its points one by one. Then so
// many packets go apart until one is tried again.
constexpr std::size_t kCompany = 3;
constexpr std::size_t kApart = 7;

struct Entry
{
  float squared;
  std::uint32_t ref;
  std::uint32_t slot; // its box: 8 * parent + place there; kNone for a start
};

// Entries not nearer than the limit never get in; the nearest of one node comes out first.
class Stack
{
public:
  bool empty() const { return size_ == 0; }
  Entry pop() { return entries_[--size_]; }
  void push(Entry entry) { entries_[size_++] = entry; }
  std::size_t size() const { return size_; }

  // Restores the order, farthest first, of what was pushed since `first`: a handful.
  void sortFrom(std::size_t first)
  {
    for (std::size_t k = first + 1; k < size_; ++k)
    {
      const Entry entry = entries_[k];
      std::size_t place = k;
      for (; place > first && entries_[place - 1].squared < entry.squared; --place)
      {
        entries_[place] = entries_[place - 1];
      }
      entries_[place] = entry;
    }
  }

private:
  Entry entries_[kStack];
  std::size_t size_ = 0;
};

// What single points and packets have in common: the hierarchy, and the boxes below a node.
class Search
{
public:
  explicit Search(const NearestQuery& query)
    : query_(query)
    , nodes_(query.bvh->nodes().data())
    , leaves_(query.bvh->leaves().data())
    , squaredScale_(query.bvh->scale() * query.bvh->scale())
  {
  }

protected:
  void start(Stack& stack) const
  {
    if (!query_.roots)
    {
      stack.push({ 0.0f, 0, MeshBvh::kNone });
      return;
    }
    // They come sorted, nearest first; the walk wants the nearest on top.
    for (std::size_t k = query_.roots->size(); k-- > 0;)
    {
      stack.push({ 0.0f, (*query_.roots)[k], MeshBvh::kNone });
    }
  }

  // Pushes the children nearer than the limit to the box lower .. upper, nearest last.
  HWY_INLINE void expand(
    std::uint32_t index, const float* lower, const float* upper, float limit, Stack& stack) const
  {
    const MeshBvh::Node& node = nodes_[index];
    const Eight d;
    alignas(32) float squared[kWidth];
    for (std::size_t k = 0; k < kWidth; k += hn::Lanes(d))
    {
      auto sum = hn::Zero(d);
      for (int axis = 0; axis < 3; ++axis)
      {
        const auto below = hn::Sub(hn::Load(d, node.lower[axis] + k), hn::Set(d, upper[axis]));
        const auto above = hn::Sub(hn::Set(d, lower[axis]), hn::Load(d, node.upper[axis] + k));
        const auto gap = hn::Max(hn::Max(below, above), hn::Zero(d));
        sum = hn::MulAdd(gap, gap, sum);
      }
      hn::Store(sum, d, squared + k);
    }
    const std::size_t first = stack.size();
    for (std::size_t k = 0; k < kWidth; ++k)
    {
      if (squared[k] <= limit && node.child[k] != MeshBvh::kNone)
      {
        stack.push({ squared[k], node.child[k], std::uint32_t(index * kWidth + k) });
      }
    }
    stack.sortFrom(first);
  }

  const double* corner(std::int32_t triangle, int k) const
  {
    const std::size_t vertex =
      std::size_t(query_.mesh->triangles[std::size_t(triangle)][std::size_t(k)]);
    return query_.mesh->points[vertex].data();
  }

  // The least exceeded limit: nextafter, so that a point exactly at maxDistance counts.
  double squaredLimit() const
  {
    return std::nextafter(
      query_.maxDistance * query_.maxDistance, std::numeric_limits<double>::infinity());
  }

  // What a float squared distance in local space must not exceed to matter beside `squared`.
  float threshold(double squared, double margin) const
  {
    const double length = std::sqrt(squared * squaredScale_) + margin;
    return float(std::min(length * length * (1.0 + 1e-6), kUnlimited));
  }

  // Kept where squares are floats. Points that far measure every triangle, by their margin.
  static float kept(double local)
  {
    return float(std::min(std::max(local, -kFarthest), kFarthest));
  }

  const NearestQuery& query_;
  const MeshBvh::Node* nodes_;
  const MeshBvh::Leaf* leaves_;
  double squaredScale_;
};

// One point: SIMD over children and over the triangles of a leaf.
class SingleSearch : public Search
{
public:
  using Search::Search;

  void run(const Vec3& p, double& squared, std::int32_t& triangle)
  {
    const Vec3 local = query_.bvh->toLocal(p);
    const float point[3] = { kept(local[0]), kept(local[1]), kept(local[2]) };
    margin_ = kRounding * (1.0 + local.cwiseAbs().maxCoeff());
    best_ = this->squaredLimit();
    bestTriangle_ = -1;
    limit_ = this->threshold(best_, margin_);
    Stack stack;
    this->start(stack);
    while (!stack.empty())
    {
      const Entry entry = stack.pop();
      if (entry.squared > limit_)
      {
        continue;
      }
      if (entry.ref & MeshBvh::kLeafBit)
      {
        this->visit(leaves_[entry.ref & ~MeshBvh::kLeafBit], point, p);
      }
      else
      {
        this->expand(entry.ref, point, point, limit_, stack);
      }
    }
    squared = bestTriangle_ < 0 ? std::numeric_limits<double>::infinity() : best_;
    triangle = bestTriangle_;
  }

private:
  HWY_INLINE void visit(const MeshBvh::Leaf& leaf, const float* point, const Vec3& p)
  {
    const Eight d;
    bool near = false;
    for (std::size_t k = 0; k < kWidth; k += hn::Lanes(d))
    {
      const auto squared = squaredToFrame(d, framesFrom(leaf.frame, k), hn::Set(d, point[0]),
        hn::Set(d, point[1]), hn::Set(d, point[2]));
      near = near || !hn::AllFalse(d, hn::Le(squared, hn::Set(d, limit_)));
    }
    if (near)
    {
      this->measure(leaf, p);
    }
  }

  HWY_NOINLINE void measure(const MeshBvh::Leaf& leaf, const Vec3& p)
  {
    const Doubles d;
    alignas(64) double corner[3][3][kWidth];
    for (std::size_t k = 0; k < kWidth; ++k)
    {
      for (int which = 0; which < 3; ++which)
      {
        const double* from = this->corner(leaf.triangle[k], which);
        for (int axis = 0; axis < 3; ++axis)
        {
          corner[which][axis][k] = from[axis];
        }
      }
    }
    alignas(64) double squared[kWidth];
    for (std::size_t k = 0; k < kWidth; k += hn::Lanes(d))
    {
      hn::Vec<Doubles> loaded[3][3];
      for (int which = 0; which < 3; ++which)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          loaded[which][axis] = hn::Load(d, corner[which][axis] + k);
        }
      }
      hn::Store(
        ExactTriangle(loaded).squaredDistance(hn::Set(d, p[0]), hn::Set(d, p[1]), hn::Set(d, p[2])),
        d, squared + k);
    }
    for (std::size_t k = 0; k < leaf.count; ++k)
    {
      if (squared[k] < best_)
      {
        best_ = squared[k];
        bestTriangle_ = leaf.triangle[k];
        limit_ = this->threshold(best_, margin_);
      }
    }
  }

  double best_;
  double margin_;
  std::int32_t bestTriangle_;
  float limit_;
};

// Sixteen points that lie together: SIMD over points, after culling by their common box.
class PacketSearch : public Search
{
public:
  using Search::Search;

  /// \param take indices of the points, `count` <= kPacket of them.
  /// \param warm a triangle that was nearest to a point nearby, or -1; updated.
  void run(const std::uint32_t* take, std::size_t count, std::int32_t& warm)
  {
    this->load(take, count);
    if (warm >= 0)
    {
      this->measure(warm);
    }
    Stack stack;
    this->start(stack);
    while (!stack.empty())
    {
      const Entry entry = stack.pop();
      const std::size_t near = entry.squared > limit_ ? 0 : this->pointsNear(entry.slot);
      if (near == 0)
      {
        continue;
      }
      ++visits_;
      visitors_ += near;
      if (entry.ref & MeshBvh::kLeafBit)
      {
        this->visit(leaves_[entry.ref & ~MeshBvh::kLeafBit]);
      }
      else
      {
        this->expand(entry.ref, lower_, upper_, limit_, stack);
      }
    }
    warm = triangle_[kPacket / 2] >= 0 ? this->triangle(kPacket / 2) : warm;
  }

  /// Whether these points had so little in common that each had better gone by itself.
  bool wereApart() const { return visitors_ < kCompany * visits_; }

  double squared(std::size_t k) const
  {
    return triangle_[k] < 0 ? std::numeric_limits<double>::infinity() : best_[k];
  }
  std::int32_t triangle(std::size_t k) const { return std::int32_t(triangle_[k]); }

private:
  // Short packets repeat their last point.
  void load(const std::uint32_t* take, std::size_t count)
  {
    const Vec3& center = query_.bvh->center();
    const double scale = query_.bvh->scale();
    const double* axes[3] = { query_.points.x, query_.points.y, query_.points.z };
    double reach = 0.0;
    double squaredRadius = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      float low = std::numeric_limits<float>::max();
      float high = -low;
      for (std::size_t k = 0; k < kPacket; ++k)
      {
        const double value = axes[axis][take[std::min(k, count - 1)]];
        point_[axis][k] = value;
        const double exact = (value - center[axis]) * scale;
        const float local = kept(exact);
        reach = std::max(reach, std::abs(exact));
        local_[axis][k] = local;
        low = std::min(low, local);
        high = std::max(high, local);
      }
      lower_[axis] = low;
      upper_[axis] = high;
      middle_[axis] = 0.5f * (low + high);
      squaredRadius += 0.25 * (double(high) - low) * (double(high) - low);
    }
    margin_ = kRounding * (1.0 + reach);
    radius_ = float((std::sqrt(squaredRadius) + margin_) * (1.0 + 1e-6));
    const double limit = this->squaredLimit();
    limit_ = this->threshold(limit, margin_);
    std::fill_n(best_, kPacket, limit);
    std::fill_n(triangle_, kPacket, std::int64_t(-1));
    std::fill_n(threshold_, kPacket, limit_);
    visits_ = 0;
    visitors_ = 0;
  }

  HWY_INLINE void visit(const MeshBvh::Leaf& leaf)
  {
    // No point of the packet is farther than radius_ from its middle.
    const Eight d;
    const double reach = std::sqrt(double(limit_)) + radius_;
    const float squaredReach = float(std::min(reach * reach * (1.0 + 1e-6), kUnlimited));
    alignas(32) float squared[kWidth];
    for (std::size_t k = 0; k < kWidth; k += hn::Lanes(d))
    {
      hn::Store(squaredToFrame(d, framesFrom(leaf.frame, k), hn::Set(d, middle_[0]),
                  hn::Set(d, middle_[1]), hn::Set(d, middle_[2])),
        d, squared + k);
    }
    for (std::size_t k = 0; k < leaf.count; ++k)
    {
      if (squared[k] <= squaredReach && this->anyNear(leaf.frame, k))
      {
        this->measure(leaf.triangle[k]);
      }
    }
  }

  // How many points may be nearer to a box than to the best so far. The box that they all have in
  // common is much nearer to it than any of them may be.
  HWY_INLINE std::size_t pointsNear(std::uint32_t slot) const
  {
    if (slot == MeshBvh::kNone)
    {
      return kPacket;
    }
    std::size_t near = 0;
    const Floats d;
    const MeshBvh::Node& node = nodes_[slot / kWidth];
    const std::size_t k = slot % kWidth;
    for (std::size_t lane = 0; lane < kPacket; lane += hn::Lanes(d))
    {
      auto sum = hn::Zero(d);
      for (int axis = 0; axis < 3; ++axis)
      {
        const auto p = hn::Load(d, local_[axis] + lane);
        const auto below = hn::Sub(hn::Set(d, node.lower[axis][k]), p);
        const auto above = hn::Sub(p, hn::Set(d, node.upper[axis][k]));
        const auto gap = hn::Max(hn::Max(below, above), hn::Zero(d));
        sum = hn::MulAdd(gap, gap, sum);
      }
      near += hn::CountTrue(d, hn::Le(sum, hn::Load(d, threshold_ + lane)));
    }
    return near;
  }

  HWY_INLINE bool anyNear(const MeshBvh::Frame& frame, std::size_t k) const
  {
    const Floats d;
    const auto vectors = frameOfOne(frame, k);
    for (std::size_t lane = 0; lane < kPacket; lane += hn::Lanes(d))
    {
      const auto squared = squaredToFrame(d, vectors, hn::Load(d, local_[0] + lane),
        hn::Load(d, local_[1] + lane), hn::Load(d, local_[2] + lane));
      if (!hn::AllFalse(d, hn::Le(squared, hn::Load(d, threshold_ + lane))))
      {
        return true;
      }
    }
    return false;
  }

  // The distances that count.
  HWY_INLINE void measure(std::int32_t triangle)
  {
    const Doubles d;
    const hn::RebindToSigned<Doubles> wide;
    hn::Vec<Doubles> corner[3][3];
    for (int which = 0; which < 3; ++which)
    {
      const double* from = this->corner(triangle, which);
      for (int axis = 0; axis < 3; ++axis)
      {
        corner[which][axis] = hn::Set(d, from[axis]);
      }
    }
    const ExactTriangle exact(corner);
    bool better = false;
    for (std::size_t lane = 0; lane < kPacket; lane += hn::Lanes(d))
    {
      const auto squared = exact.squaredDistance(hn::Load(d, point_[0] + lane),
        hn::Load(d, point_[1] + lane), hn::Load(d, point_[2] + lane));
      const auto best = hn::Load(d, best_ + lane);
      const auto nearer = hn::Lt(squared, best);
      if (hn::AllFalse(d, nearer))
      {
        continue;
      }
      better = true;
      hn::Store(hn::IfThenElse(nearer, squared, best), d, best_ + lane);
      const auto held = hn::Load(wide, triangle_ + lane);
      hn::Store(
        hn::IfThenElse(hn::RebindMask(wide, nearer), hn::Set(wide, std::int64_t(triangle)), held),
        wide, triangle_ + lane);
    }
    if (better)
    {
      this->tighten();
    }
  }

  HWY_INLINE void tighten()
  {
    const Doubles d;
    const hn::Rebind<float, Doubles> narrow;
    const auto scale = hn::Set(d, squaredScale_);
    const auto margin = hn::Set(d, margin_);
    auto largest = hn::Zero(d);
    for (std::size_t lane = 0; lane < kPacket; lane += hn::Lanes(d))
    {
      const auto length = hn::Add(hn::Sqrt(hn::Mul(hn::Load(d, best_ + lane), scale)), margin);
      const auto squared =
        hn::Min(hn::Mul(hn::Mul(length, length), hn::Set(d, 1.0 + 1e-6)), hn::Set(d, kUnlimited));
      largest = hn::Max(largest, squared);
      hn::Store(hn::DemoteTo(narrow, squared), narrow, threshold_ + lane);
    }
    limit_ = float(hn::GetLane(hn::MaxOfLanes(d, largest)));
  }

  alignas(64) double point_[3][kPacket];
  alignas(64) double best_[kPacket];
  alignas(64) float local_[3][kPacket];
  alignas(64) float threshold_[kPacket];
  alignas(64) std::int64_t triangle_[kPacket]; // as wide as the lanes of best_
  float lower_[3];
  float upper_[3];
  float middle_[3];
  float radius_;
  float limit_;
  double margin_;
  std::size_t visits_;   // of nodes and leaves
  std::size_t visitors_; // points that each was near enough to, added up
};

void findNearest(const NearestQuery& query, double* squared, std::int32_t* triangle)
{
  const auto at = [&](std::size_t k) { return query.order ? query.order[k] : std::uint32_t(k); };
  SingleSearch single(query);
  const auto oneByOne = [&](std::size_t begin, std::size_t end)
  {
    for (std::size_t k = begin; k < end; ++k)
    {
      single.run(query.points[at(k)], squared[at(k)], triangle[at(k)]);
    }
  };
  if (query.count <= 2)
  {
    oneByOne(0, query.count);
    return;
  }
  PacketSearch search(query);
  std::int32_t warm = -1;
  std::size_t apart = 0; // packets still to go one by one
  for (std::size_t begin = 0; begin < query.count; begin += kPacket)
  {
    std::uint32_t take[kPacket];
    const std::size_t count = std::min(kPacket, query.count - begin);
    if (apart > 0)
    {
      --apart;
      oneByOne(begin, begin + count);
      continue;
    }
    for (std::size_t k = 0; k < count; ++k)
    {
      take[k] = at(begin + k);
    }
    search.run(take, count, warm);
    apart = search.wereApart() ? kApart : 0;
    for (std::size_t k = 0; k < count; ++k)
    {
      squared[take[k]] = search.squared(k);
      triangle[take[k]] = search.triangle(k);
    }
  }
}

} // namespace HWY_NAMESPACE
} // namespace hybridtree
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hybridtree
{

HWY_EXPORT(findNearest);

void findNearest(const NearestQuery& query, double* squared, std::int32_t* triangle)
{
  HWY_DYNAMIC_DISPATCH(findNearest)(query, squared, triangle);
}

} // namespace hybridtree
#endif
