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
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
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
  }
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

void BoxTree::Box::extend(const Vec3& point)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    lower[axis] = std::min(lower[axis], point[int(axis)]);
    upper[axis] = std::max(upper[axis], point[int(axis)]);
  }
}

void BoxTree::Box::extend(const Box& other)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    lower[axis] = std::min(lower[axis], other.lower[axis]);
    upper[axis] = std::max(upper[axis], other.upper[axis]);
  }
}

bool BoxTree::Box::meets(const Box& other) const
{
  return lower[0] <= other.upper[0] && other.lower[0] <= upper[0] && lower[1] <= other.upper[1] &&
    other.lower[1] <= upper[1] && lower[2] <= other.upper[2] && other.lower[2] <= upper[2];
}

BoxTree::Box BoxTree::Children::box(std::size_t child) const
{
  return { { lower[0][child], lower[1][child], lower[2][child] },
    { upper[0][child], upper[1][child], upper[2][child] } };
}

void BoxTree::Children::set(std::size_t child, const Box& box)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    lower[axis][child] = box.lower[axis];
    upper[axis][child] = box.upper[axis];
  }
}

unsigned BoxTree::Children::meeting(const Box& box, std::size_t count) const
{
  unsigned result = 0;
  for (std::size_t k = 0; k < count; ++k)
  {
    const bool meets = (lower[0][k] <= box.upper[0]) & (box.lower[0] <= upper[0][k]) &
      (lower[1][k] <= box.upper[1]) & (box.lower[1] <= upper[1][k]) &
      (lower[2][k] <= box.upper[2]) & (box.lower[2] <= upper[2][k]);
    result |= unsigned(meets) << k;
  }
  return result;
}

BoxTree::BoxTree(const TriangleMesh& mesh) : bounds_(Box::nothing())
{
  for (const Vec3& point : mesh.points)
  {
    bounds_.extend(point);
  }
  order_ = alongCurve(mesh, bounds_);
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
