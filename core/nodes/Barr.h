// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/Node.h"
#include "core/nodes/NodeMaker.h"

namespace hybridtree
{

/// Where a Barr deformation acts. World units.
struct BarrFrame
{
  Vec3 origin = Vec3::Zero();
  /// Direction of the axis through the origin; any length but 0.
  Vec3 axis = Vec3::UnitZ();
  /// Direction towards which a bend turns, made orthogonal to the axis; for twist and taper any
  /// direction across the axis gives the same shape.
  Vec3 normal = Vec3::UnitX();
  ///@{ Part of the axis that is deformed, measured along it from the origin. begin < end.
  double begin = 0.0;
  double end = 1.0;
  ///@}
};

/// Largest bend, in radians: beyond it the straight ends overlap and no inverse exists.
inline constexpr double kLargestBend = 4.5;

/// Largest twist, in radians: a thousand turns. Triangles of any size wind up beyond.
inline constexpr double kLargestTwist = 6283.2;

/// Barr's twist ([HT] 4.5.1): turns cross sections about the axis by an angle that grows linearly
/// from 0 at begin to `angle`, in radians, at end. Before begin nothing changes; beyond end all is
/// turned by `angle`. \throws InvalidParameter: an axis of length 0, a normal along the axis, begin
/// >= end, a number that is not finite, or an angle beyond kLargestTwist. \pre child not null. The
/// same of the next two.
NodePtr makeTwist(NodePtr child, const BarrFrame& frame, double angle);

/// Barr's taper: scales cross sections about the axis by a factor that goes linearly from 1 at
/// begin to `factor` > 0 at end. Before begin nothing changes; beyond end all is scaled by
/// `factor`.
NodePtr makeTaper(NodePtr child, const BarrFrame& frame, double factor);

/// Barr's bend: the axis turns towards the normal (away from it for a negative angle) by a constant
/// rate from begin on, by `angle` radians in all at end. Before begin nothing changes; beyond end
/// the shape goes straight on. |angle| <= kLargestBend. Warns when the shape reaches past the
/// centre line of the bend, (end - begin) / |angle| away from the axis: what would overlap is cut
/// off.
NodePtr makeBend(NodePtr child, const BarrFrame& frame, double angle);

/// The kinds "twist", "taper" and "bend": parameters "frame" (columns: normal, binormal, axis,
/// origin; of any length and skew, as affine maps leave them), "begin" and "end" in lengths of the
/// axis column, "angle" in radians or "factor".
///@{
NodePtr twistFromParameters(
  const Parameters& parameters, const std::vector<NodePtr>& children, const MeshLookup& lookup);
NodePtr taperFromParameters(
  const Parameters& parameters, const std::vector<NodePtr>& children, const MeshLookup& lookup);
NodePtr bendFromParameters(
  const Parameters& parameters, const std::vector<NodePtr>& children, const MeshLookup& lookup);
///@}

} // namespace hybridtree
