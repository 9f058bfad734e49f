// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/mesh/TriangleMesh.h"
#include "core/polygonize/CreaseLoops.h"
#include "core/polygonize/FieldSource.h"

#include <vector>

namespace hybridtree
{

/// A point of a polygon in which the surface has an edge or a corner.
struct CreasePoint
{
  bool found = false;
  /// Not found, and it was no even curve either: from near it looked like a crease up to the end,
  /// or its corners face so differently, without the field's normal turning by and by from one to
  /// the other, that the lattice cannot have followed the surface between them.
  bool suspected = false;
  Vec3 point = Vec3::Zero();
  /// In the middle of those of the faces that meet there, unit length.
  Vec3 normal = Vec3::Zero();
  /// |grad f| beside it.
  double slope = 0.0;
  /// Of the field at each corner of the polygon, unit length, outward.
  std::vector<Vec3> cornerNormals;
};

/// Looks for the point of the crease that crosses each polygon.
///
/// The planes that touch the field's level at the corners meet near it (Kobbelt et al. 2001), in
/// the sense of least squares, as a corner or an edge as their normals span space or a plane. From
/// there the field is asked again, nearer and nearer around it: on a curved crease that leads to
/// the crease itself, and tells it from a surface that is merely curved, which is flat when seen
/// from near. Edges and tips that are round by less than about a tenth of a cell count as sharp.
/// The point is found only if it lies on f = T, within half a cell of its own, and the straight
/// lines from it to the corners lie on the surface, nearly.
///
/// The same for any number of threads. \throws Cancelled.
std::vector<CreasePoint> findCreasePoints(const FieldSource& field, const Lattice& lattice,
  const TriangleMesh& mesh, const std::vector<CreaseLoop>& loops, double leastAngle,
  const Progress& progress);

} // namespace hybridtree
