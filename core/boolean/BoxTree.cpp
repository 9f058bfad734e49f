// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/BoxTree.h"

#include "core/base/Parallel.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace hybridtree
{
namespace
{

constexpr std::size_t kGrain = 1 << 14;

// Ten bits with two gaps after each.
std::uint32_t spread(std::uint32_t bits)
{
  bits = (bits | bits << 16) & 0x030000ffu;
  bits = (bits | bits << 8) & 0x0300f00fu;
  bits = (bits | bits << 4) & 0x030c30c3u;
  bits = (bits | bits << 2) & 0x09249249u;
  return bits;
}

// Sorted by the upper half, stably, 10 bits at a time.
void radixSort(std::vector<std::uint64_t>& keys)
{
  constexpr std::size_t kBuckets = 1 << 10;
  std::vector<std::uint64_t> other(keys.size());
  for (int shift = 32; shift < 62; shift += 10)
  {
    std::array<std::uint32_t, kBuckets> start{};
    for (const std::uint64_t key : keys)
    {
      ++start[key >> shift & (kBuckets - 1)];
    }
    std::uint32_t sum = 0;
    for (std::uint32_t& count : start)
    {
      sum += std::exchange(count, sum);
    }
    for (const std::uint64_t key : keys)
    {
      other[start[key >> shift & (kBuckets - 1)]++] = key;
    }
    keys.swap(other);
  }
}

BoxTree::Box triangleBox(const TriangleMesh& mesh, std::int32_t triangle)
{
  const Triangle& corner = mesh.triangles[std::size_t(triangle)];
  BoxTree::Box box = BoxTree::Box::nothing();
  for (const std::int32_t vertex : corner)
  {
    box.extend(mesh.points[std::size_t(vertex)]);
  }
  return box;
}

// The triangles by the place of their middles along a Z-order curve.
std::vector<std::int32_t> alongCurve(const TriangleMesh& mesh, const BoxTree::Box& bounds)
{
  std::array<double, 3> scale;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double size = bounds.upper[axis] - bounds.lower[axis];
    scale[axis] = size > 0.0 ? 1023.0 / size : 0.0;
  }
  std::vector<std::uint64_t> keys(mesh.triangles.size());
  const auto place = [&](std::size_t t)
  {
    const Triangle& c = mesh.triangles[t];
    const Vec3 middle = (mesh.points[std::size_t(c[0])] + mesh.points[std::size_t(c[1])] +
                          mesh.points[std::size_t(c[2])]) *
      (1.0 / 3.0);
    std::uint32_t code = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double cell = (middle[int(axis)] - bounds.lower[axis]) * scale[axis];
      code |= spread(std::uint32_t(std::clamp(cell, 0.0, 1023.0))) << axis;
    }
    keys[t] = std::uint64_t(code) << 32 | t;
  };
  parallelFor(keys.size(), kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t t = begin; t < end; ++t)
      {
        place(t);
      }
    });
  radixSort(keys);
  std::vector<std::int32_t> order(keys.size());
  std::transform(keys.begin(), keys.end(), order.begin(),
    [](std::uint64_t key) { return std::int32_t(std::uint32_t(key)); });
  return order;
}

} // namespace

BoxTree::Box BoxTree::Box::nothing()
{
  constexpr double kFar = std::numeric_limits<double>::infinity();
  return { { kFar, kFar, kFar }, { -kFar, -kFar, -kFar } };
}

BoxTree::BoxTree(const TriangleMesh& mesh, double reach) : bounds_(Box::nothing())
{
  for (const Vec3& point : mesh.points)
  {
    bounds_.extend(point);
  }
  order_ = alongCurve(mesh, bounds_);
  bounds_.grow(reach);
  const std::size_t groups = (order_.size() + kWidth - 1) / kWidth;
  levels_.emplace_back((groups + kWidth - 1) / kWidth);
  parallelFor(groups, kGrain / kWidth,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t group = begin; group < end; ++group)
      {
        Box box = Box::nothing();
        const std::size_t last = std::min(order_.size(), (group + 1) * kWidth);
        for (std::size_t k = group * kWidth; k < last; ++k)
        {
          box.extend(triangleBox(mesh, order_[k]));
        }
        box.grow(reach);
        levels_[0][group / kWidth].set(group % kWidth, box);
      }
    });
  for (std::size_t children = groups; levels_.back().size() > 1;)
  {
    const std::vector<Children>& below = levels_.back();
    std::vector<Children> level((below.size() + kWidth - 1) / kWidth);
    for (std::size_t node = 0; node < below.size(); ++node)
    {
      Box box = Box::nothing();
      for (std::size_t k = 0; k < std::min(kWidth, children - node * kWidth); ++k)
      {
        box.extend(below[node].box(k));
      }
      level[node / kWidth].set(node % kWidth, box);
    }
    children = below.size();
    levels_.push_back(std::move(level));
  }
}

std::size_t BoxTree::nodeCount(int level) const
{
  return level > 0 ? levels_[std::size_t(level - 1)].size() : (order_.size() + kWidth - 1) / kWidth;
}

BoxTree::Node BoxTree::root() const
{
  return { int(levels_.size()), 0, bounds_ };
}

} // namespace hybridtree
