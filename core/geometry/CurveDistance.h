// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/CubicSpan.h"

#include <vector>

namespace hybridtree
{

/// Distance to a chain of cubic spans, in batches: bounds of the batch leave a few spans, bounds of
/// each vector of points fewer, and those are solved for all points of the vector at once
/// (CubicSpan.h has the equation). A value depends on its point alone, not on its place in the
/// batch. Immutable.
class CurveDistance
{
public:
  CurveDistance() = default;
  explicit CurveDistance(const std::vector<CubicSpan>& spans) { this->assign(spans); }

  /// Takes another curve, reusing memory.
  void assign(const std::vector<CubicSpan>& spans);

  /// Per point: the vector from the nearest curve point to it, and the curve's radius there (which
  /// may be null for thin curves). The distance is that of the vector less the radius; of a thick
  /// curve, the point whose ball is nearest counts.
  /// \param reach points farther than this from the curve may get any vector longer than it.
  void offsets(PointBatch points, VectorBatch offset, double* radius, double reach) const;

  /// Of the balls.
  const Box3& bounds() const { return bounds_; }
  bool thick() const { return thick_; }

private:
  void slice(PointBatch points, VectorBatch offset, double* radius, double reach) const;

  std::vector<PreparedSpan> spans_;
  Box3 bounds_;
  double size_ = 0.0; // of the curve, for rounding
  bool thick_ = false;
};

///@{
/// Vectors from the nearest point of several thin spans to each point, or from the centre of the
/// nearest ball of thick ones, and its radius. \pre count > 0.
/// Chosen at run time for this processor's widest vectors.
void nearestOnSpans(
  const PreparedSpan* const* spans, std::size_t count, PointBatch points, VectorBatch offset);
void nearestOnThickSpans(const PreparedSpan* const* spans, std::size_t count, PointBatch points,
  VectorBatch offset, double* radius);
///@}

} // namespace hybridtree
