// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/subdivision/PlacedField.h"

#include <limits>
#include <vector>

namespace hybridtree
{

/// A line on which a vertex finds the surface ([SUB] 4.1): base + t * direction.
struct SkeletonAxis
{
  Vec3 base = Vec3::Zero();
  Vec3 direction = Vec3::Zero(); ///< unit length, from the inside out
  double start = 0.0;            ///< t where the search begins: the last known place is best
  double least = 0.0;            ///< of t
  double most = 0.0;             ///< of t
  double step = 0.0;        ///< longest, as long as the surface is not between two known places
  std::int32_t element = 0; ///< of the coarse skeleton that the vertex belongs to, as PlacedField
  /// The field at the base, not-a-number where it is not known, and its slope along the axis.
  double value = std::numeric_limits<double>::quiet_NaN();
  double slope = 0.0;
};

/// t on f = T for each axis, not-a-number where none was found between least and most.
///
/// Newton's steps, or where they agree those of the cubic through two places, with their slopes,
/// kept within the bracket of an inner and an outer place and halving it where they leave it; until
/// both are known, outwards from inside and inwards from outside by steps that are never longer
/// than `step`. |f - T| <= 1e-7 T at the end. All axes go in step, so that the field is asked in
/// batches, of one element each where there are fields of elements; neighbours in the list should
/// be neighbours in space. \param gradient of the field at each place found; null when nobody asks.
std::vector<double> slideAxes(const PlacedField& field, const std::vector<SkeletonAxis>& axes,
  std::vector<Vec3>* gradient = nullptr);

/// A point, and the element that it belongs to, as SkeletonAxis::element.
struct PlacedPoint
{
  Vec3 at;
  std::int32_t element;
};

/// The field at points, asked in batches. \param gradient null when nobody asks.
std::vector<double> fieldAt(const PlacedField& field, const std::vector<PlacedPoint>& points,
  std::vector<Vec3>* gradient = nullptr);

/// The whole field, wherever the points are.
std::vector<double> fieldAt(
  const FieldSource& field, const std::vector<Vec3>& points, std::vector<Vec3>* gradient = nullptr);

} // namespace hybridtree
