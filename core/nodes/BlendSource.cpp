// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/BlendSource.h"

#include "core/base/Scratch.h"

namespace hybridtree
{
namespace
{

void add(int count, const double* values, std::size_t size, double* sum)
{
  for (std::size_t k = 0; k < size; ++k)
  {
    sum[k] += count * values[k];
  }
}

} // namespace

void addMultiple(const FieldSource& source, int count, PointBatch points, double* sum)
{
  if (count == 1)
  {
    source.addField(points, sum);
    return;
  }
  ScratchArray value(points.size);
  source.field(points, value.data());
  add(count, value.data(), points.size, sum);
}

void addMultiple(
  const FieldSource& source, int count, PointBatch points, double* sum, VectorBatch gradientSum)
{
  if (count == 1)
  {
    source.addFieldAndGradient(points, sum, gradientSum);
    return;
  }
  ScratchArray value(points.size);
  ScratchVectors gradient(points.size);
  source.fieldAndGradient(points, value.data(), gradient.batch());
  add(count, value.data(), points.size, sum);
  add(count, gradient.batch().x, points.size, gradientSum.x);
  add(count, gradient.batch().y, points.size, gradientSum.y);
  add(count, gradient.batch().z, points.size, gradientSum.z);
}

BlendSource::BlendSource(std::vector<Term> terms) : terms_(std::move(terms)) {}

void BlendSource::addField(PointBatch points, double* sum) const
{
  for (const Term& term : terms_)
  {
    addMultiple(*term.source, term.count, points, sum);
  }
}

void BlendSource::addFieldAndGradient(PointBatch points, double* sum, VectorBatch gradientSum) const
{
  for (const Term& term : terms_)
  {
    addMultiple(*term.source, term.count, points, sum, gradientSum);
  }
}

Interval BlendSource::range(const Box3& box) const
{
  Interval sum;
  for (const Term& term : terms_)
  {
    sum = sum + multiple(term.source->range(box), term.count);
  }
  return sum;
}

FieldSourcePtr BlendSource::restrictedTo(const Box3& box) const
{
  std::vector<Term> kept;
  kept.reserve(terms_.size());
  for (const Term& term : terms_)
  {
    if (FieldSourcePtr restricted = term.source->restrictedTo(box))
    {
      kept.push_back({ std::move(restricted), term.count });
    }
  }
  return BlendSource::of(std::move(kept));
}

FieldSourcePtr BlendSource::of(std::vector<Term> terms)
{
  if (terms.empty())
  {
    return nullptr;
  }
  if (terms.size() == 1 && terms.front().count == 1)
  {
    return std::move(terms.front().source);
  }
  return std::make_shared<BlendSource>(std::move(terms));
}

} // namespace hybridtree
