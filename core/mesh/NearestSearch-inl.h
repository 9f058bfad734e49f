// SPDX-License-Identifier: BSD-3-Clause
// The walk down a mesh's hierarchy that a single point and a packet of points have in common.
// Included once per instruction set, as Highway's foreach_target has it; so no #pragma once.
#if defined(HYBRIDTREE_NEAREST_SEARCH) == defined(HWY_TARGET_TOGGLE)
#ifdef HYBRIDTREE_NEAREST_SEARCH
#undef HYBRIDTREE_NEAREST_SEARCH
#else
#define HYBRIDTREE_NEAREST_SEARCH
#endif

#include "core/mesh/NearestKernels.h"
#include "core/mesh/TriangleKernels-inl.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hybridtree
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kStack = 1024; // entries; a node adds at most 7 and trees are some 10 deep

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

} // namespace HWY_NAMESPACE
} // namespace hybridtree
HWY_AFTER_NAMESPACE();
#endif
