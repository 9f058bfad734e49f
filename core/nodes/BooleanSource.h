// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/BooleanField.h"
#include "core/polygonize/FieldSource.h"

#include <initializer_list>

namespace hybridtree
{

/// Boolean field function over two sources: what a Boolean node evaluates, whole or for a brick.
class BooleanSource final : public FieldSource
{
public:
  /// A null operand is a field of 0. \pre one is not null; form is not Automatic.
  BooleanSource(BooleanOperation operation, BooleanForm form, FieldSourcePtr a, FieldSourcePtr b);

  /// The same, of operands restricted to a box, over which they have these ranges.
  BooleanSource(BooleanOperation operation, BooleanForm form, FieldSourcePtr a, FieldSourcePtr b,
    const Box3& box, Interval rangeA, Interval rangeB);

  void field(PointBatch points, double* value) const override;
  void fieldAndGradient(PointBatch points, double* value, VectorBatch gradient) const override;
  Interval range(const Box3& box) const override;
  FieldSourcePtr restrictedTo(const Box3& box) const override;

  /// A solid less itself: a field of 0, where the formula would reach T all along its surface.
  bool isNothing() const { return operation_ == BooleanOperation::Difference && a_ == b_; }

private:
  BooleanOperation operation_;
  BooleanForm form_;
  FieldSourcePtr a_;
  FieldSourcePtr b_;
  Box3 box_;       ///< where the range is known; asked for again by every node above
  Interval range_; ///< over that box
};

/// The Boolean of two sources that are already restricted to the box (null: 0), with every operand
/// left out that cannot matter in it; null where it is 0 throughout.
FieldSourcePtr booleanSource(BooleanOperation operation, BooleanForm form, FieldSourcePtr a,
  FieldSourcePtr b, const Box3& box);

///@{
/// As the methods of FieldSource, for a source that may be null: a field of 0.
void fieldOf(const FieldSource* source, PointBatch points, double* value);
void fieldAndGradientOf(
  const FieldSource* source, PointBatch points, double* value, VectorBatch gradient);
Interval rangeOf(const FieldSource* source, const Box3& box);
FieldSourcePtr restrictionOf(const FieldSource* source, const Box3& box);
///@}

/// A source to ask, null for a field of 0, and where its answers go.
struct Question
{
  const FieldSource* source;
  double* value;
  VectorBatch gradient = {};
};

///@{
/// Asks several sources about the same points, and one that stands in more than one place once: a
/// chain of nodes that take their child twice would ask its leaf for each of its 2^n paths.
void askFields(std::initializer_list<Question> questions, PointBatch points);
void askFieldsAndGradients(std::initializer_list<Question> questions, PointBatch points);
///@}

} // namespace hybridtree
