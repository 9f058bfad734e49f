// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/Node.h"
#include "core/nodes/NodeMaker.h"

#include <array>
#include <optional>
#include <vector>

namespace hybridtree
{

/// Control lattice of a free-form deformation (Sederberg and Parry 1986; [HT] 4.5.2). World units.
struct FreeFormLattice
{
  /// Control points along each edge of the lattice box; each 2 to kLargestLattice.
  std::array<int, 3> dimensions{ 4, 4, 4 };
  /// Corner of the lattice box, where control point (0, 0, 0) is at rest.
  Vec3 origin = Vec3::Zero();
  /// Columns: the full edges of the lattice box from the origin; they must span space.
  Mat3 axes = Mat3::Identity();
  /// How far each control point is moved: l * m * n vectors, i fastest, then j, then k. Empty:
  /// none.
  std::vector<Vec3> displacements;
};

inline constexpr int kLargestLattice = 64;

/// How the field of a freely deformed shape is made.
enum class FieldFrom
{
  /// [HT] 4.5.2: distance to the child's mesh after deformation. Serves any deformation, folds too.
  DeformedMesh,
  /// f_A o w^-1 with the exact inverse. Only where the lattice does not fold; elsewhere the node
  /// warns and falls back on DeformedMesh.
  InverseMap,
};

/// Free-form deformation of a child: w(p) = p + sum_ijk B_i(s) B_j(t) B_k(u) d_ijk within the
/// lattice box, with Bernstein polynomials of degree dimensions - 1; the identity outside of it. So
/// w is continuous where control points on the faces of the box stay at rest; displaced ones tear
/// what reaches through these faces, which the node warns about.
///
/// DeformedMesh: the child's mesh at edgeLength (0: its default) is deformed, remeshed where
/// stretched and becomes the mesh behind a mesh field, at the first query that needs it. Over a
/// single leaf that field keeps the leaf's I, R and n: the field outside falls off as the leaf's
/// does. Over several it has I = 1, n = 2 and a reach of diagonal / 10. mesh() gives that same mesh
/// at whatever length asked. InverseMap: at points where nothing is deformed to, the field is 0;
/// where both a deformed and a resting part of the child are (displaced faces), the deformed part
/// counts.
///
/// \param edgeLength of the mesh behind DeformedMesh, finite and >= 0.
/// \throws InvalidParameter for dimensions, axes, displacements or an edge length out of range.
/// \pre child not null.
NodePtr makeFreeForm(
  NodePtr child, const FreeFormLattice& lattice, FieldFrom fieldFrom, double edgeLength = 0.0);

/// The kind "freeForm": parameters "dimensions", "frame" (columns: edges of the lattice box,
/// origin), "displacements" (three numbers each, in units of these edges), "fieldFrom"
/// ("deformedMesh" or "inverseMap"), "edgeLength", and "map": what affine maps have made of a
/// DeformedMesh node, whose child and lattice stay as they were before them.
NodePtr freeFormFromParameters(
  const Parameters& parameters, const std::vector<NodePtr>& children, const MeshLookup& lookup);

/// A deformed lattice as it is to be drawn.
struct ControlLattice
{
  std::array<int, 3> dimensions;
  std::vector<Vec3> points;                       ///< i fastest, then j, then k
  std::vector<std::array<std::int32_t, 2>> edges; ///< between neighbours along i, j and k
};

/// Displaced control points and the edges between them. \throws InvalidParameter as makeFreeForm().
ControlLattice controlLattice(const FreeFormLattice& lattice);

/// That of a free-form node, under the affine maps it has taken; empty for every other kind.
std::optional<ControlLattice> controlLattice(const Node& node);

} // namespace hybridtree
