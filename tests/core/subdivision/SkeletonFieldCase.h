// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/SubdivisionSkeleton.h"
#include "core/subdivision/PieceMeshes.h"

namespace hybridtree::test
{

/// A skeleton and the leaf around it, as meshes of pieces want them.
struct SkeletonFieldCase
{
  explicit SkeletonFieldCase(SkeletonGraph shape, int level = 2,
    SubdivisionScheme scheme = SubdivisionScheme::Approximating,
    BlendingKind blending = BlendingKind::All)
    : graph(std::move(shape)), level(level), refined(subdivide(graph, scheme, level))
  {
    SubdivisionSkeletonOptions options;
    options.scheme = scheme;
    options.level = level;
    options.blending.kind = blending;
    node = makeSubdivisionSkeleton(graph, options);
  }

  SkeletonField field() const { return { graph, refined, level, *node, 2.0, 0 }; }

  SkeletonGraph graph;
  int level;
  RefinedSkeleton refined;
  NodePtr node;
};

} // namespace hybridtree::test
