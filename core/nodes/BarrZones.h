// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/IntervalMath.h"

#include <algorithm>

namespace hybridtree
{

/// The three zones of Barr's deformations along their axis: before the range, within it, beyond.

/// Share of the range that t has gone through: 0 before begin, 1 beyond end.
inline double along(double t, double begin, double end)
{
  return (std::clamp(t, begin, end) - begin) / (end - begin);
}

inline bool within(double t, double begin, double end)
{
  return begin <= t && t <= end;
}

inline Interval component(const Box3& box, int axis)
{
  return { box.min()[axis], box.max()[axis] };
}

/// Value of a rate that is `inside` within the range and `outside` beyond, over an interval of t.
/// At the ends themselves both one-sided values count.
inline Interval zoned(Interval t, double begin, double end, Interval inside, double outside)
{
  const bool touchesInside = t.max >= begin && t.min <= end;
  const bool touchesOutside = t.min <= begin || t.max >= end;
  if (!touchesInside)
  {
    return { outside, outside };
  }
  return touchesOutside ? hull(inside, { outside, outside }) : inside;
}

} // namespace hybridtree
