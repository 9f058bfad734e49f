// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/SkeletonLocalField.h"
#include "core/subdivision/PieceMeshes.h"

#include <memory>

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
    local = std::make_unique<SkeletonLocalField>(static_cast<const SubdivisionSkeleton&>(*node));
  }

  SkeletonField field() const
  {
    const auto& leaf = static_cast<const SubdivisionSkeleton&>(*node);
    const bool isSmooth = leaf.options().blending.kind == BlendingKind::All;
    return { graph, refined, level, *node, nullptr, isSmooth, local.get() };
  }

  SkeletonGraph graph;
  int level;
  RefinedSkeleton refined;
  NodePtr node;
  std::unique_ptr<SkeletonLocalField> local;
};

} // namespace hybridtree::test
