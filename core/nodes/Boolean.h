// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/boolean/MergeFacets.h"
#include "core/nodes/BooleanField.h"
#include "core/nodes/BooleanMesh.h"
#include "core/nodes/Node.h"
#include "core/nodes/NodeMaker.h"

namespace hybridtree
{

/// Union, intersection or difference A - B ([HT] 4.4) with the field functions of BooleanField.h.
///
/// Membership follows the children's by Boolean algebra: max, min, and min(cA, -cB) for the
/// difference. (Departs from [HT], whose step 2 keeps what of A's surface lies inside B.)
/// signedDistance() is exact or NaN: it is the children's distance where no part of the child's
/// surface that was cut away can be the nearest.
/// sourceLeaf() names a leaf of the operand whose surface it is at f = T, for every form.
/// The mesh is the children's, cut (BooleanMesh.h); where they cannot be cut, that of the lattice,
/// and warnings() says so from then on. All forms have the same surface, so the same mesh.
/// Disjoint, empty and equal operands are answers, not errors.
/// \param merging which triangles of the mesh are put together again after a cut.
/// \pre no child is null. \throws InvalidParameter.
NodePtr makeBoolean(BooleanOperation operation, NodePtr a, NodePtr b,
  BooleanForm form = BooleanForm::Automatic, FacetMerging merging = FacetMerging::Parts);

/// Where the surfaces of a Boolean's operands cross, as chains of points of its mesh; closed ones
/// end where they begin. Operands that are Booleans themselves add what is left of theirs. Makes
/// the mesh if need be. Empty for any other kind of node, and where the mesh is that of the
/// lattice. \throws as Node::mesh().
std::vector<std::vector<std::int32_t>> curvesOf(
  const Node& node, double edgeLength = 0.0, const Progress& progress = Progress::none());
/// Their points.
std::vector<std::vector<Vec3>> intersectionCurves(
  const Node& node, double edgeLength = 0.0, const Progress& progress = Progress::none());

/// The facets of its mesh, under the same conditions as curvesOf(); empty where each triangle is
/// one of its own.
Facets facetsOf(
  const Node& node, double edgeLength = 0.0, const Progress& progress = Progress::none());

/// Kind "boolean", children A, B; names "operation", "form" and, where it is not Parts, "merging".
NodePtr booleanFromParameters(
  const Parameters& parameters, const std::vector<NodePtr>& children, const MeshLookup& lookup);

} // namespace hybridtree
