// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/SplineCurve.h"
#include "core/nodes/Node.h"
#include "core/nodes/Potential.h"

namespace hybridtree
{

/// How curves become one node.
struct CurveTreeOptions
{
  /// Of a curve without radii. The potential of one with radii is this, scaled such that its
  /// surface radius is the largest of them; along the curve the surface is at the radius, and the
  /// field ends as far outside of it as there.
  Potential potential;
  /// Blend all curves; otherwise they are united, and only parts of one curve join smoothly.
  bool blendAcross = true;
  /// Curves are simplified within the detailTolerance() of their own bounds.
  int levelOfDetail = 4;
};

/// One primitive for each curve, all together one tree: hundreds of curve skeletons as one object
/// ([HT] 6.3). A curve of a single point is a point skeleton, a straight one without radii a
/// segment, others splines (or chains of segments) by their kind.
///
/// The balls of a curve's own radii, not hulls of a few: its surface is exactly what they sweep.
/// \throws InvalidGeometry naming the curve when a number is not finite or a radius negative, when
/// the radii of a curve are all 0, or when radii are given and the potential has no surface radius.
NodePtr makeCurveTree(const std::vector<SplineCurve>& curves, const CurveTreeOptions& options);

} // namespace hybridtree
