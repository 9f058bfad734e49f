// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"

namespace hybridtree
{

/// Where something that turns around an axis stands. `axis` and `side` are unit vectors at right
/// angles; angles around the axis count from `side`.
struct AxisFrame
{
  Vec3 origin = Vec3::Zero();
  Vec3 axis = Vec3::UnitZ();
  Vec3 side = Vec3::UnitX();
};

} // namespace hybridtree
