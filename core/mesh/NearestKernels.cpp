// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/NearestKernels.h"

#include <algorithm>

// Compiled once per instruction set; three of them cover the field.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/mesh/NearestKernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target, as Highway wants it.
#include "core/mesh/PacketSearch-inl.h"
#include "core/mesh/SingleSearch-inl.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hybridtree
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

// So many packets go point by point, after one whose points had little in common, until one is
// tried again.
constexpr std::size_t kApart = 7;

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
