// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/AxisFrame.h"
#include "core/geometry/SkeletonKernels.h"

namespace hybridtree
{

///@{
/// Shapes of revolution, as plain numbers; all but the disc are solid. Heights are measured from
/// the origin along the axis. Points of the axis look for their nearest point towards frame.side.

/// At height 0.
struct DiscShape
{
  AxisFrame frame;
  double radius;
};

/// From height -half to half, half > 0.
struct CylinderShape
{
  AxisFrame frame;
  double half;
  double radius;
};

/// A cylinder without the one of the inner radius. 0 <= inner <= outer.
struct HollowCylinderShape
{
  AxisFrame frame;
  double half;
  double outer;
  double inner;
};

/// Truncated cone: radius `bottom` at height -half, `top` at half > 0. Either may be 0.
struct ConeShape
{
  AxisFrame frame;
  double half;
  double bottom;
  double top;
};

/// Convex hull of two balls: radius `bottom` at height 0, `top` at height `length`.
/// \pre length > |bottom - top|, so that neither ball holds the other; or both are the same one:
/// length = 0 and bottom = top.
struct ConeSphereShape
{
  AxisFrame frame;
  double length;
  double bottom;
  double top;
};
///@}

///@{
/// As for the shapes of SkeletonKernels.h. In the half plane through the axis each is a problem of
/// a few segments and arcs (Barbier and Galin, "Fast distance computation between a point and
/// cylinders, cones, line-swept spheres and cone-spheres", 2004).
const SkeletonKernels<DiscShape>& kernelsFor(const DiscShape&);
const SkeletonKernels<CylinderShape>& kernelsFor(const CylinderShape&);
const SkeletonKernels<HollowCylinderShape>& kernelsFor(const HollowCylinderShape&);
const SkeletonKernels<ConeShape>& kernelsFor(const ConeShape&);
const SkeletonKernels<ConeSphereShape>& kernelsFor(const ConeSphereShape&);
///@}

} // namespace hybridtree
