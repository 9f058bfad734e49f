// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/polygonize/FieldSource.h"

#include <cstdint>

namespace hybridtree
{

/// Fields of single elements of a coarse skeleton, for points that are known to belong to one of
/// them ([SUB] 5). Any number of threads may ask.
class ElementFields
{
public:
  virtual ~ElementFields() = default;

  /// Whether they are less than the whole field: sums of single elements and their neighbours.
  virtual bool areOwnSums() const = 0;

  /// Overwrites `value`, and `gradient` unless null.
  virtual void evaluate(
    std::int32_t element, PointBatch points, double* value, const VectorBatch* gradient) const = 0;
};

/// The field around a skeleton, and what it is near single elements where that is known.
struct PlacedField
{
  const FieldSource& whole;
  const ElementFields* elements; ///< null: the whole everywhere
  const Progress& progress;      ///< asked between batches whether to go on

  PlacedField(const FieldSource& field, const ElementFields* ofElements = nullptr,
    const Progress& whileAsking = Progress::none())
    : whole(field), elements(ofElements), progress(whileAsking)
  {
  }

  /// As ElementFields. \param element of the coarse skeleton: a segment's number, or a triangle's
  /// behind those of all segments.
  void evaluate(
    std::int32_t element, PointBatch points, double* value, const VectorBatch* gradient) const
  {
    if (elements)
    {
      elements->evaluate(element, points, value, gradient);
    }
    else if (gradient)
    {
      whole.fieldAndGradient(points, value, *gradient);
    }
    else
    {
      whole.field(points, value);
    }
  }
};

} // namespace hybridtree
