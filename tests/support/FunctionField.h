// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/polygonize/FieldSource.h"

#include <functional>
#include <limits>
#include <utility>

namespace hybridtree::test
{

/// A field given by a function, for tests: the gradient by central differences, the range by a
/// Lipschitz constant (infinite: nothing is known of the range).
class FunctionField final : public FieldSource
{
public:
  using Function = std::function<double(const Vec3&)>;

  explicit FunctionField(
    Function function, double lipschitz = std::numeric_limits<double>::infinity())
    : function_(std::move(function)), lipschitz_(lipschitz)
  {
  }

  double operator()(const Vec3& point) const { return function_(point); }

  void field(PointBatch points, double* value) const override
  {
    for (std::size_t k = 0; k < points.size; ++k)
    {
      value[k] = function_(points[k]);
    }
  }

  void fieldAndGradient(PointBatch points, double* value, VectorBatch gradient) const override
  {
    this->field(points, value);
    for (std::size_t k = 0; k < points.size; ++k)
    {
      Vec3 slope;
      for (int axis = 0; axis < 3; ++axis)
      {
        const Vec3 step = 1e-6 * Vec3::Unit(axis);
        slope[axis] = (function_(points[k] + step) - function_(points[k] - step)) / 2e-6;
      }
      gradient.set(k, slope);
    }
  }

  Interval range(const Box3& box) const override
  {
    const double center = function_(box.center());
    const double reach = lipschitz_ * 0.5 * box.diagonal().norm();
    return { center - reach, center + reach };
  }

  FieldSourcePtr restrictedTo(const Box3&) const override
  {
    return FieldSourcePtr(FieldSourcePtr(), this);
  }

private:
  Function function_;
  double lipschitz_;
};

} // namespace hybridtree::test
