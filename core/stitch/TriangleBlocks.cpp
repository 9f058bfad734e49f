// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/TriangleBlocks.h"

#include "core/base/Parallel.h"
#include "core/stitch/CellSet.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace hybridtree
{
namespace
{

constexpr double kTrianglesPerBlock = 64.0; // of those in which there is surface, about
constexpr double kMostAlong = 128.0;        // blocks
constexpr std::size_t kMostLarge = 64;      // one in so many triangles may be large
constexpr double kSlack = 1e-9;             // of the extent, for rounding
constexpr std::size_t kMostBits = 256;      // per number to sort
constexpr std::size_t kGrain = 16384;

Box3 boxOf(const TriangleMesh& mesh, const Triangle& c)
{
  Box3 box(mesh.points[c[0]]);
  return box.extend(mesh.points[c[1]]).extend(mesh.points[c[2]]);
}

/// Different numbers below `size`. Of many, to look at a bit for each takes less than to compare.
void sortNumbers(std::vector<std::int32_t>& numbers, std::size_t size)
{
  if (size > kMostBits * numbers.size())
  {
    std::sort(numbers.begin(), numbers.end());
    return;
  }
  std::vector<std::uint64_t> words((size + 63) / 64, 0);
  for (const std::int32_t number : numbers)
  {
    words[std::size_t(number) / 64] |= std::uint64_t(1) << (number % 64);
  }
  auto next = numbers.begin();
  for (std::size_t k = 0; k < words.size(); ++k)
  {
    for (std::uint64_t word = words[k]; word != 0; word &= word - 1)
    {
      *next++ = std::int32_t(64 * k) + CellSet::lowestBit(word);
    }
  }
}

} // namespace

TriangleBlocks::TriangleBlocks(const TriangleMesh& mesh)
{
  const Box3 bounds = mesh.bounds();
  const double extent = bounds.isEmpty() ? 0.0 : bounds.sizes().maxCoeff();
  if (mesh.triangles.empty() || !(extent > 0.0))
  {
    begin_.assign(2, 0);
    return;
  }
  low_ = bounds.min();
  const double count = static_cast<double>(mesh.triangles.size());
  side_ = extent / std::clamp(std::sqrt(count / kTrianglesPerBlock), 1.0, kMostAlong);
  std::vector<std::int32_t> blockOf(mesh.triangles.size());
  for (;; side_ *= 2.0)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      size_[axis] = 1 + static_cast<std::int32_t>(bounds.sizes()[axis] / side_);
    }
    if (this->findBlocks(mesh, blockOf) <= mesh.triangles.size() / kMostLarge || side_ > extent)
    {
      break;
    }
  }
  this->fill(mesh, blockOf);
}

std::size_t TriangleBlocks::findBlocks(
  const TriangleMesh& mesh, std::vector<std::int32_t>& blockOf) const
{
  std::atomic<std::size_t> large{ 0 };
  parallelFor(mesh.triangles.size(), kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      std::size_t found = 0;
      for (std::size_t t = begin; t < end; ++t)
      {
        const Box3 box = boxOf(mesh, mesh.triangles[t]);
        const bool isLarge = box.sizes().maxCoeff() > side_;
        found += isLarge ? 1 : 0;
        blockOf[t] = isLarge
          ? this->blockCount()
          : (this->blockAlong(2, box.min()[2]) * size_[1] + this->blockAlong(1, box.min()[1])) *
              size_[0] +
            this->blockAlong(0, box.min()[0]);
      }
      large += found;
    });
  return large;
}

void TriangleBlocks::fill(const TriangleMesh& mesh, const std::vector<std::int32_t>& blockOf)
{
  // Counting sort; what is large comes last.
  const auto blocks = static_cast<std::size_t>(this->blockCount());
  begin_.assign(blocks + 2, 0);
  for (const std::int32_t block : blockOf)
  {
    ++begin_[static_cast<std::size_t>(block) + 1];
  }
  for (std::size_t k = 1; k < begin_.size(); ++k)
  {
    begin_[k] += begin_[k - 1];
  }
  triangles_.resize(blockOf.size());
  std::vector<std::int32_t> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t t = 0; t < blockOf.size(); ++t)
  {
    triangles_[static_cast<std::size_t>(next[blockOf[t]]++)] = static_cast<std::int32_t>(t);
  }
  for (auto k = static_cast<std::size_t>(begin_[blocks]); k < triangles_.size(); ++k)
  {
    large_.push_back({ triangles_[k], boxOf(mesh, mesh.triangles[triangles_[k]]) });
  }
}

std::int32_t TriangleBlocks::blockAlong(int axis, double coordinate) const
{
  const double block = (coordinate - low_[axis]) / side_;
  return static_cast<std::int32_t>(std::clamp(block, 0.0, static_cast<double>(size_[axis] - 1)));
}

std::vector<std::int32_t> TriangleBlocks::near(const std::vector<Box3>& boxes) const
{
  std::vector<std::int32_t> blocks;
  Box3 all;
  const double slack = kSlack * side_ * kMostAlong;
  for (const Box3& box : boxes)
  {
    all.extend(box);
    std::array<std::int32_t, 3> from{}, to{};
    for (int axis = 0; axis < 3; ++axis)
    {
      from[axis] = this->blockAlong(axis, box.min()[axis] - side_ - slack);
      to[axis] = this->blockAlong(axis, box.max()[axis] + slack);
    }
    for (std::int32_t z = from[2]; z <= to[2]; ++z)
    {
      for (std::int32_t y = from[1]; y <= to[1]; ++y)
      {
        for (std::int32_t x = from[0]; x <= to[0]; ++x)
        {
          const std::int32_t block = (z * size_[1] + y) * size_[0] + x;
          if (begin_[block] < begin_[block + 1])
          {
            blocks.push_back(block);
          }
        }
      }
    }
  }
  std::sort(blocks.begin(), blocks.end());
  blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
  std::vector<std::int32_t> result;
  for (const std::int32_t block : blocks)
  {
    result.insert(
      result.end(), triangles_.begin() + begin_[block], triangles_.begin() + begin_[block + 1]);
  }
  for (const Large& large : large_)
  {
    if (large.box.intersects(all))
    {
      result.push_back(large.triangle);
    }
  }
  sortNumbers(result, triangles_.size());
  return result;
}

} // namespace hybridtree
