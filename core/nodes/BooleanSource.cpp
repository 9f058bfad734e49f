// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/BooleanSource.h"

#include "core/base/Scratch.h"

#include <algorithm>
#include <limits>

namespace hybridtree
{
namespace
{

// A source with its values cut to [0, max].
class ClampedSource final : public FieldSource
{
public:
  ClampedSource(FieldSourcePtr source, double max) : source_(std::move(source)), max_(max) {}

  void field(PointBatch points, double* value) const override
  {
    source_->field(points, value);
    for (std::size_t k = 0; k < points.size; ++k)
    {
      value[k] = std::clamp(value[k], 0.0, max_);
    }
  }

  void fieldAndGradient(PointBatch points, double* value, VectorBatch gradient) const override
  {
    source_->fieldAndGradient(points, value, gradient);
    for (std::size_t k = 0; k < points.size; ++k)
    {
      if (value[k] < 0.0 || value[k] > max_)
      {
        value[k] = std::clamp(value[k], 0.0, max_);
        gradient.set(k, Vec3::Zero());
      }
    }
  }

  Interval range(const Box3& box) const override
  {
    const Interval range = source_->range(box);
    return { std::clamp(range.min, 0.0, max_), std::clamp(range.max, 0.0, max_) };
  }

  FieldSourcePtr restrictedTo(const Box3& box) const override;

private:
  FieldSourcePtr source_;
  double max_;
};

// `source`, restricted to the box and of that range in it, cut to [0, max] where it leaves that.
FieldSourcePtr clamped(FieldSourcePtr source, Interval range, double max)
{
  if (!source || range.max <= 0.0)
  {
    return nullptr;
  }
  if (range.min >= 0.0 && range.max <= max)
  {
    return source;
  }
  return std::make_shared<ClampedSource>(std::move(source), max);
}

FieldSourcePtr ClampedSource::restrictedTo(const Box3& box) const
{
  FieldSourcePtr source = source_->restrictedTo(box);
  const Interval range = rangeOf(source.get(), box);
  return clamped(std::move(source), range, max_);
}

const Question& firstOf(const FieldSource* source, std::initializer_list<Question> questions)
{
  return *std::find_if(questions.begin(), questions.end(),
    [&](const Question& question) { return question.source == source; });
}

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

} // namespace

void fieldOf(const FieldSource* source, PointBatch points, double* value)
{
  if (source)
  {
    source->field(points, value);
    return;
  }
  std::fill_n(value, points.size, 0.0);
}

void fieldAndGradientOf(
  const FieldSource* source, PointBatch points, double* value, VectorBatch gradient)
{
  if (source)
  {
    source->fieldAndGradient(points, value, gradient);
    return;
  }
  std::fill_n(value, points.size, 0.0);
  std::fill_n(gradient.x, points.size, 0.0);
  std::fill_n(gradient.y, points.size, 0.0);
  std::fill_n(gradient.z, points.size, 0.0);
}

Interval rangeOf(const FieldSource* source, const Box3& box)
{
  return source ? source->range(box) : Interval{ 0.0, 0.0 };
}

FieldSourcePtr restrictionOf(const FieldSource* source, const Box3& box)
{
  return source ? source->restrictedTo(box) : nullptr;
}

void askFields(std::initializer_list<Question> questions, PointBatch points)
{
  for (const Question& question : questions)
  {
    const Question& first = firstOf(question.source, questions);
    if (&first == &question)
    {
      fieldOf(question.source, points, question.value);
      continue;
    }
    std::copy_n(first.value, points.size, question.value);
  }
}

void askFieldsAndGradients(std::initializer_list<Question> questions, PointBatch points)
{
  for (const Question& question : questions)
  {
    const Question& first = firstOf(question.source, questions);
    if (&first == &question)
    {
      fieldAndGradientOf(question.source, points, question.value, question.gradient);
      continue;
    }
    std::copy_n(first.value, points.size, question.value);
    std::copy_n(first.gradient.x, points.size, question.gradient.x);
    std::copy_n(first.gradient.y, points.size, question.gradient.y);
    std::copy_n(first.gradient.z, points.size, question.gradient.z);
  }
}

BooleanSource::BooleanSource(
  BooleanOperation operation, BooleanForm form, FieldSourcePtr a, FieldSourcePtr b)
  : operation_(operation), form_(form), a_(std::move(a)), b_(std::move(b))
{
}

BooleanSource::BooleanSource(BooleanOperation operation, BooleanForm form, FieldSourcePtr a,
  FieldSourcePtr b, const Box3& box, Interval rangeA, Interval rangeB)
  : operation_(operation)
  , form_(form)
  , a_(std::move(a))
  , b_(std::move(b))
  , box_(box)
  , range_(booleanRange(operation, form, rangeA, rangeB))
{
}

void BooleanSource::field(PointBatch points, double* value) const
{
  if (this->isNothing())
  {
    fieldOf(nullptr, points, value);
    return;
  }
  ScratchArray other(points.size);
  askFields({ { a_.get(), value }, { b_.get(), other.data() } }, points);
  booleanField(operation_, form_, value, other.data(), value, points.size);
}

void BooleanSource::fieldAndGradient(PointBatch points, double* value, VectorBatch gradient) const
{
  if (this->isNothing())
  {
    fieldAndGradientOf(nullptr, points, value, gradient);
    return;
  }
  ScratchArray other(points.size);
  ScratchVectors otherGradient(points.size);
  const VectorBatch g = otherGradient.batch();
  askFieldsAndGradients({ { a_.get(), value, gradient }, { b_.get(), other.data(), g } }, points);
  for (std::size_t k = 0; k < points.size; ++k)
  {
    const BooleanValue result = booleanValue(operation_, form_, value[k], other[k]);
    value[k] = result.value;
    gradient.x[k] = result.byA * gradient.x[k] + result.byB * g.x[k];
    gradient.y[k] = result.byA * gradient.y[k] + result.byB * g.y[k];
    gradient.z[k] = result.byA * gradient.z[k] + result.byB * g.z[k];
  }
}

Interval BooleanSource::range(const Box3& box) const
{
  if (!box_.isEmpty() && box.min() == box_.min() && box.max() == box_.max())
  {
    return range_;
  }
  if (this->isNothing())
  {
    return { 0.0, 0.0 };
  }
  const Interval rangeA = rangeOf(a_.get(), box);
  return booleanRange(operation_, form_, rangeA, a_ == b_ ? rangeA : rangeOf(b_.get(), box));
}

FieldSourcePtr BooleanSource::restrictedTo(const Box3& box) const
{
  if (this->isNothing())
  {
    return nullptr;
  }
  FieldSourcePtr a = restrictionOf(a_.get(), box);
  FieldSourcePtr b = a_ == b_ ? a : restrictionOf(b_.get(), box);
  return booleanSource(operation_, form_, std::move(a), std::move(b), box);
}

FieldSourcePtr booleanSource(
  BooleanOperation operation, BooleanForm form, FieldSourcePtr a, FieldSourcePtr b, const Box3& box)
{
  const Interval rangeA = rangeOf(a.get(), box);
  const Interval rangeB = a == b ? rangeA : rangeOf(b.get(), box);
  const bool noA = !a || rangeA.max <= 0.0;
  const bool noB = !b || rangeB.max <= 0.0;
  const bool sharp = form == BooleanForm::MinMax;
  if (noA && noB)
  {
    return nullptr;
  }
  if (operation == BooleanOperation::Difference)
  {
    if (noA || rangeB.min >= 2.0 * kThreshold)
    {
      return nullptr;
    }
    if (noB || (sharp && rangeA.max <= 2.0 * kThreshold - rangeB.max))
    {
      return clamped(std::move(a), rangeA, 2.0 * kThreshold);
    }
  }
  // The printed forms are neither neutral nor compact: they need an operand even where it is 0.
  else if (form != BooleanForm::Paper)
  {
    const bool unite = operation == BooleanOperation::Union;
    if (!unite && (noA || noB))
    {
      return nullptr;
    }
    if (noB || (sharp && (unite ? rangeA.min >= rangeB.max : rangeA.max <= rangeB.min)))
    {
      return clamped(std::move(a), rangeA, kNoLimit);
    }
    if (noA || (sharp && (unite ? rangeB.min >= rangeA.max : rangeB.max <= rangeA.min)))
    {
      return clamped(std::move(b), rangeB, kNoLimit);
    }
  }
  return std::make_shared<BooleanSource>(
    operation, form, std::move(a), std::move(b), box, rangeA, rangeB);
}

} // namespace hybridtree
