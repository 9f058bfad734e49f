// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/subdivision/SkeletonGraph.h"

namespace hybridtree::test
{

/// Coarse skeletons of the size of those of [SUB], made from formulas.
///@{
/// A pretzel: a ring and three arms that meet inside of it. 24 segments, 23 points, three holes.
SkeletonGraph bretzel();
/// A figure with a tail, hands of four fingers and feet of three toes (102 segments), and a head,
/// ears and a back fin of 15 triangles.
SkeletonGraph alien();
/// Two surface pieces and five curve pieces, with every way to meet ([SUB], Figure 7): curves at a
/// junction, a curve that ends inside of a surface, at a border, and surfaces joined by a curve.
SkeletonGraph figure7();
///@}

/// A chain of n segments along a curve in space, radius growing from 0.2 to 0.4.
SkeletonGraph chain(int n);

/// A disc of n triangles around point 0, slightly raised in the middle; closed around or open.
SkeletonGraph fan(int n, bool closed);

} // namespace hybridtree::test
