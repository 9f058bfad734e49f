// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/polygonize/FieldSource.h"

#include <algorithm>
#include <vector>

namespace hybridtree
{

/// A field that is made by adding up, over FieldSource or a class derived from it: to overwrite is
/// to add to 0.
template <typename Base>
class SummedField : public Base
{
public:
  using Base::Base;

  void field(PointBatch points, double* value) const final
  {
    std::fill_n(value, points.size, 0.0);
    this->addField(points, value);
  }

  void fieldAndGradient(PointBatch points, double* value, VectorBatch gradient) const final
  {
    for (double* numbers : { value, gradient.x, gradient.y, gradient.z })
    {
      std::fill_n(numbers, points.size, 0.0);
    }
    this->addFieldAndGradient(points, value, gradient);
  }
};

///@{
/// Adds `count` times the field of a source, which is asked once.
void addMultiple(const FieldSource& source, int count, PointBatch points, double* sum);
void addMultiple(
  const FieldSource& source, int count, PointBatch points, double* sum, VectorBatch gradientSum);
///@}

/// The sum of the fields of some sources.
class BlendSource final : public SummedField<FieldSource>
{
public:
  struct Term
  {
    FieldSourcePtr source; ///< not null
    int count;             ///< how often it is added
  };

  explicit BlendSource(std::vector<Term> terms);

  void addField(PointBatch points, double* sum) const override;
  void addFieldAndGradient(PointBatch points, double* sum, VectorBatch gradientSum) const override;
  Interval range(const Box3& box) const override;
  FieldSourcePtr restrictedTo(const Box3& box) const override;

  /// The source of a sum: null for no term, a single term itself.
  static FieldSourcePtr of(std::vector<Term> terms);

private:
  std::vector<Term> terms_;
};

/// `count` times the range.
inline Interval multiple(Interval range, int count)
{
  return { count * range.min, count * range.max };
}

} // namespace hybridtree
