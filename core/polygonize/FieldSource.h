// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"

#include <memory>

namespace hybridtree
{

class FieldSource;
using FieldSourcePtr = std::shared_ptr<const FieldSource>;

/// A scalar field in space, asked in batches. All that polygonization knows of a tree.
///
/// Immutable: one object serves any number of threads. Batches of a few hundred points are best.
class FieldSource
{
public:
  virtual ~FieldSource() = default;

  /// value[k] = f(p_k), for points.size values, overwritten.
  virtual void field(PointBatch points, double* value) const = 0;

  /// As field(), and gradient k = grad f(p_k). Where f is not differentiable one of the one-sided
  /// gradients is given; where the nearest skeleton point is not unique, one of the nearest is
  /// used.
  virtual void fieldAndGradient(PointBatch points, double* value, VectorBatch gradient) const = 0;

  ///@{
  /// The same, added to what the arrays hold: sums of many sources need no memory between. The
  /// default calls the overwriting form; leaves that are summed by the hundred do better.
  virtual void addField(PointBatch points, double* sum) const;
  virtual void addFieldAndGradient(PointBatch points, double* sum, VectorBatch gradientSum) const;
  ///@}

  /// [min, max] with min <= f(p) <= max for every p in the box. Conservative, and the tighter the
  /// smaller the box: as the box shrinks to a point both ends go to f(p).
  virtual Interval range(const Box3& box) const = 0;

  /// A source with the same field at every point of the box, that has dropped what does not reach
  /// it; null when the field is 0 throughout. Only valid inside the box. Cheap: called per brick.
  /// Lives no longer than this source.
  virtual FieldSourcePtr restrictedTo(const Box3& box) const = 0;
};

} // namespace hybridtree
