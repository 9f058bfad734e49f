// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Parameters.h"
#include "core/base/Types.h"
#include "core/geometry/Falloff.h"
#include "core/mesh/TriangleMesh.h"

#include <limits>
#include <memory>
#include <optional>

namespace hybridtree
{

class Skeleton;
using SkeletonPtr = std::shared_ptr<const Skeleton>;

/// A geometric object with an analytic distance, around which a primitive is built ([HT] 4.1).
/// Knows lengths only: potentials belong to the node that holds it. Immutable.
class Skeleton
{
public:
  virtual ~Skeleton() = default;

  /// distance[k] = Euclidean distance of p_k to the skeleton, >= 0; 0 inside a volume skeleton.
  virtual void distance(PointBatch points, double* distance) const = 0;

  /// And its gradient: the unit vector from the nearest skeleton point to p_k; 0 where distance is
  /// 0. Where several skeleton points are nearest, one of them, always the same one.
  virtual void distanceAndGradient(
    PointBatch points, double* distance, VectorBatch gradient) const = 0;

  /// Distance, negative inside a volume skeleton (minus the distance to its boundary).
  virtual void signedDistance(PointBatch points, double* distance) const
  {
    this->distance(points, distance);
  }

  /// Offset surfaces of a radius below this keep clear of themselves: from any point inside of one
  /// it is radius - signedDistance() to it. Infinite for a convex skeleton; the default where that
  /// is not known.
  virtual double reach() const { return 0.0; }
  static constexpr double kConvex = std::numeric_limits<double>::infinity();

  ///@{
  /// sum[k] += h(distance of p_k), and gradientSum k += the gradient of that: what a blend does for
  /// each of its leaves, in one pass. The defaults ask for the distance first.
  virtual void addFalloff(PointBatch points, const Falloff& falloff, double* sum) const;
  virtual void addFalloffWithGradient(
    PointBatch points, const Falloff& falloff, double* sum, VectorBatch gradientSum) const;
  ///@}

  ///@{
  /// What distance() costs for a point of a batch, in microseconds of one processor; only ratios
  /// matter. kClosedForm for arithmetic alone in batches.
  virtual double distanceCost() const = 0;
  static constexpr double kClosedForm = 0.023;
  ///@}

  /// Conservative [min, max] of distance() over a box, tight as the box shrinks.
  virtual Interval distanceRange(const Box3& box) const = 0;

  /// Bounds of the skeleton itself.
  virtual Box3 bounds() const = 0;

  /// Closed 2-manifold mesh of the surface at `radius` from the skeleton, made directly ([HT] 5.1):
  /// edges <= edgeLength where the shape allows, vertices on the surface, exact normals.
  /// No value when this skeleton has no direct mesh for these values (a self-meeting offset): the
  /// caller then uses the lattice. An empty mesh where nothing is enclosed: radius 0 around a
  /// curve. \pre radius >= 0, edgeLength > 0. \throws TooLarge, naming the number of triangles.
  virtual std::optional<TriangleMesh> offsetMesh(double radius, double edgeLength) const = 0;

  /// This skeleton under a similarity of scale `scale`: again one of the same kind.
  virtual SkeletonPtr similarityImage(const Affine3& map, double scale) const = 0;

  /// Name in the serialised tree ("point", "segment", ...), and everything needed to make it again.
  virtual const char* kind() const = 0;
  virtual Parameters parameters() const = 0;
};

} // namespace hybridtree
