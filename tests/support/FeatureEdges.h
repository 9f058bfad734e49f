// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <vector>

namespace hybridtree::test
{

struct FeatureEdge
{
  Vec3 from;
  Vec3 to;

  double distance(const Vec3& p) const;
};

/// Edges of a closed mesh at which the triangles turn by more than an angle, in degrees, each once.
std::vector<FeatureEdge> featureEdges(const TriangleMesh& mesh, double angle = 25.0);

/// Whether one of the edges runs within `reach` of the point.
bool isCovered(const std::vector<FeatureEdge>& edges, const Vec3& p, double reach);

} // namespace hybridtree::test
