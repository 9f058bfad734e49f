// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/SpatialOrder.h"

#include "reconstruction/ParallelSort.h"
#include "reconstruction/SpreadBits.h"

#include "core/base/Error.h"
#include "core/base/Parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace hybridtree
{
namespace
{

constexpr std::size_t kGrain = 4096;
constexpr int kBits = 20; // per axis

struct Sortable
{
  std::uint64_t key;
  std::int32_t point;
  bool operator<(const Sortable& other) const
  {
    return key != other.key ? key < other.key : point < other.point;
  }
};

// All bits 0, or 1 where the bit is set. Branches on bits would be guessed wrong half of the time.
std::uint32_t maskOf(std::uint32_t bits, std::uint32_t bit)
{
  return 0u - std::uint32_t((bits & bit) != 0);
}

// Place on the Hilbert curve, by J. Skilling, Programming the Hilbert curve (2004).
std::uint64_t hilbertKey(std::array<std::uint32_t, 3> x)
{
  for (std::uint32_t bit = 1u << (kBits - 1); bit > 1; bit >>= 1)
  {
    const std::uint32_t below = bit - 1;
    for (std::uint32_t& axis : x)
    {
      const std::uint32_t set = maskOf(axis, bit);
      const std::uint32_t swapped = (x[0] ^ axis) & below & ~set;
      x[0] ^= swapped | (below & set);
      axis ^= swapped;
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t flip = 0;
  for (std::uint32_t bit = 1u << (kBits - 1); bit > 1; bit >>= 1)
  {
    flip ^= maskOf(x[2], bit) & (bit - 1);
  }
  return spreadBits(x[0] ^ flip) << 2 | spreadBits(x[1] ^ flip) << 1 | spreadBits(x[2] ^ flip);
}

// Round in which a point is inserted, 0 for seven of eight, 1 for seven of eight of the others ...
int roundOf(std::uint64_t index)
{
  std::uint64_t bits = index + 0x9e3779b97f4a7c15ull; // splitmix64
  bits = (bits ^ bits >> 30) * 0xbf58476d1ce4e5b9ull;
  bits = (bits ^ bits >> 27) * 0x94d049bb133111ebull;
  bits ^= bits >> 31;
  int round = 0;
  while ((bits & 7u) == 0 && round < 21)
  {
    bits >>= 3;
    ++round;
  }
  return round;
}

} // namespace

void checkFinite(const std::vector<Vec3>& points)
{
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    if (!points[k].allFinite())
    {
      throw InvalidGeometry("Point " + std::to_string(k) +
        " has a coordinate that is not a finite number: remove it, or mend it where it was made.");
    }
  }
}

std::vector<std::int32_t> spatialOrder(const std::vector<Vec3>& points, const Progress& progress)
{
  checkFinite(points);
  Box3 box;
  for (const Vec3& p : points)
  {
    box.extend(p);
  }
  const double cells = std::ldexp(1.0, kBits);
  const double edge = points.empty() ? 0.0 : box.sizes().maxCoeff();
  const double scale = edge > 0.0 && std::isfinite(edge) ? cells / edge : 0.0;
  std::vector<Sortable> sorted(points.size());
  parallelFor(points.size(), kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      progress.check();
      for (std::size_t k = begin; k < end; ++k)
      {
        std::array<std::uint32_t, 3> cell;
        for (int axis = 0; axis < 3; ++axis)
        {
          const double at = (points[k][axis] - box.min()[axis]) * scale;
          cell[axis] = static_cast<std::uint32_t>(std::min(at, cells - 1.0));
        }
        sorted[k] = { hilbertKey(cell), static_cast<std::int32_t>(k) };
      }
    });
  parallelSort(sorted, progress);
  std::vector<std::int32_t> order(points.size());
  std::transform(
    sorted.begin(), sorted.end(), order.begin(), [](const Sortable& item) { return item.point; });
  return order;
}

std::vector<std::int32_t> insertionOrder(std::size_t count)
{
  int rounds = 1;
  for (std::size_t left = count / 8; left > 500; left /= 8)
  {
    ++rounds;
  }
  std::vector<std::vector<std::int32_t>> parts(rounds);
  for (std::size_t k = 0; k < count; ++k)
  {
    parts[std::min(roundOf(k), rounds - 1)].push_back(static_cast<std::int32_t>(k));
  }
  std::vector<std::int32_t> order;
  order.reserve(count);
  for (auto part = parts.rbegin(); part != parts.rend(); ++part)
  {
    order.insert(order.end(), part->begin(), part->end());
  }
  return order;
}

} // namespace hybridtree
