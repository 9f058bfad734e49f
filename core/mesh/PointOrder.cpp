// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/PointOrder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace hybridtree
{
namespace
{

constexpr std::uint32_t kDigit = 11; // bits sorted at a time

// abc... to a00b00c00..., for 10 bits.
std::uint32_t spread(std::uint32_t bits)
{
  bits = (bits | bits << 16) & 0x030000ffu;
  bits = (bits | bits << 8) & 0x0300f00fu;
  bits = (bits | bits << 4) & 0x030c30c3u;
  return (bits | bits << 2) & 0x09249249u;
}

struct Axis
{
  double origin;
  double perLength;
  std::uint32_t last;

  // NaN and infinity end in the first or last cell: an order is only a matter of speed.
  std::uint32_t cell(double value) const
  {
    const double place = (value - origin) * perLength;
    return place > 0.0 ? std::uint32_t(std::min(place, double(last))) : 0u;
  }
};

Axis axisOf(const double* values, std::size_t count, std::uint32_t cells, double& extent)
{
  const auto [low, high] = std::minmax_element(values, values + count);
  extent = *high - *low;
  return { *low, 0.0, cells - 1 };
}

} // namespace

void orderAlongCurve(PointBatch points, std::vector<std::uint32_t>& order)
{
  const std::size_t count = points.size;
  order.resize(count);
  std::iota(order.begin(), order.end(), 0u);
  std::uint32_t bits = 1;
  while (bits < 10 && (std::size_t(1) << (3 * bits)) < count)
  {
    ++bits;
  }
  std::array<double, 3> extent;
  std::array<Axis, 3> axis{ axisOf(points.x, count, 1u << bits, extent[0]),
    axisOf(points.y, count, 1u << bits, extent[1]),
    axisOf(points.z, count, 1u << bits, extent[2]) };
  const double widest = std::max({ extent[0], extent[1], extent[2] });
  if (!(widest > 0.0) || !std::isfinite(widest))
  {
    return;
  }
  for (Axis& one : axis)
  {
    one.perLength = double(1u << bits) / widest; // cubic cells
  }
  thread_local std::vector<std::uint32_t> keys;
  thread_local std::vector<std::uint32_t> next;
  keys.resize(count);
  next.resize(count);
  for (std::size_t k = 0; k < count; ++k)
  {
    keys[k] = spread(axis[0].cell(points.x[k])) | spread(axis[1].cell(points.y[k])) << 1 |
      spread(axis[2].cell(points.z[k])) << 2;
  }
  for (std::uint32_t shift = 0; shift < 3 * bits; shift += kDigit)
  {
    const std::uint32_t mask = (1u << std::min(kDigit, 3 * bits - shift)) - 1;
    std::array<std::uint32_t, (1u << kDigit) + 1> begin{};
    for (const std::uint32_t key : keys)
    {
      ++begin[(key >> shift & mask) + 1];
    }
    for (std::size_t digit = 1; digit <= mask; ++digit)
    {
      begin[digit] += begin[digit - 1];
    }
    for (const std::uint32_t point : order)
    {
      next[begin[keys[point] >> shift & mask]++] = point;
    }
    order.swap(next);
  }
}

} // namespace hybridtree
