// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/boolean/MeshOperand.h"
#include "core/mesh/TriangleMesh.h"

#include <array>
#include <string>
#include <vector>

namespace hybridtree
{

enum class MeshOperation
{
  Union,
  Intersection,
  Difference
};

/// A point of the result that is of neither operand: on an edge of one, in a triangle of the other.
struct CutPoint
{
  std::int8_t operand = 0;          ///< of the edge: 0 for A, 1 for B
  std::int32_t low = -1, high = -1; ///< ends of the edge; -1 for a point inside of `triangle`
  double parameter = 0.0;           ///< 0 at low, 1 at high
  std::int32_t triangle = -1;       ///< of the other operand
  std::array<std::int32_t, 2> home{ -1, -1 }; ///< per operand: a triangle that it lies in
  Vec3 position = Vec3::Zero();               ///< where the meshes cross
};

struct MeshBooleanResult
{
  /// Points: those of A, those of B, those on the cut; each in the order of its operand, bit for
  /// bit. Triangles: kept ones of A, parts of cut ones of A, then those of B.
  TriangleMesh mesh;

  std::vector<std::int8_t> sourceOperand; ///< per triangle: 0 for A, 1 for B
  std::vector<std::int32_t>
    sourceTriangle; ///< per triangle: which; -1 where an open one was closed

  std::vector<std::int32_t> sourcePoint; ///< per point of A and of B: which; -1 as above
  std::size_t firstOfB = 0;              ///< the first point that is not of A
  std::size_t firstCut = 0;              ///< the first point of neither
  std::vector<CutPoint> cutPoints;       ///< for the points from firstCut on

  /// Where the surfaces cross: indices of points; closed curves end where they begin.
  std::vector<std::vector<std::int32_t>> curves;

  /// What the user should know: operands that were open.
  std::vector<std::string> warnings;
  /// False where an operand crosses itself at the cut by more than rounding, or is inside out: the
  /// mesh is then empty, and the last warning says why.
  bool usable = true;
};

/// Union, intersection or difference A - B of two solids given by their surfaces ([HT] 5.3).
///
/// Two closed surfaces, each without crossing itself, give a closed, consistently oriented
/// 2-manifold, also where they coincide, touch or share edges and vertices: topology is decided
/// exactly, for operands that are moved by less than anything (PerturbedPredicates.h), in such a
/// direction that what touches merges and A - A is empty. Then points are rounded, and what
/// has neither length nor height goes (CleanResult.h). Points and triangles away from the cut are
/// copied.
///
/// Surfaces that coincide but for rounding (2^-48 of the largest coordinate) count as coincident
/// where they would leave a gap or a sheet without thickness: B is then cut as if it were larger,
/// for an intersection smaller, by no more than 2^-46.
///
/// An operand may cross itself at the cut by rounding, up to 2^-22 of the smaller operand's size,
/// as results of other cuts do: what is around which part how often is then told exactly, and the
/// result is closed, with such crossings of its own (CutFaces.h).
///
/// Departs from [HT] 5.3: sides spread from the cut over whole parts of a mesh; where no cut comes
/// by, a ray tells, with exact predicates. So no membership is asked for.
/// The same result for any number of threads.
/// \throws Cancelled; TooLarge; InvalidGeometry where even the perturbation leaves ties, which
/// takes a mesh that covers the same triangle twice.
MeshBooleanResult meshBoolean(MeshOperation operation, const MeshOperand& a, const MeshOperand& b,
  const Progress& progress = Progress::none());

} // namespace hybridtree
