// SPDX-License-Identifier: BSD-3-Clause
#include "core/polygonize/FieldSource.h"

#include "core/base/Scratch.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

// Keeps the scratch small whatever the size of the batch.
constexpr std::size_t kSlice = 512;

} // namespace

void FieldSource::addField(PointBatch points, double* sum) const
{
  ScratchArray value(std::min(kSlice, points.size));
  for (std::size_t begin = 0; begin < points.size; begin += kSlice)
  {
    const std::size_t count = std::min(kSlice, points.size - begin);
    this->field(points.slice(begin, count), value.data());
    for (std::size_t k = 0; k < count; ++k)
    {
      sum[begin + k] += value[k];
    }
  }
}

void FieldSource::addFieldAndGradient(PointBatch points, double* sum, VectorBatch gradientSum) const
{
  const std::size_t capacity = std::min(kSlice, points.size);
  ScratchArray value(capacity);
  ScratchVectors gradient(capacity);
  const VectorBatch g = gradient.batch();
  for (std::size_t begin = 0; begin < points.size; begin += kSlice)
  {
    const std::size_t count = std::min(kSlice, points.size - begin);
    this->fieldAndGradient(points.slice(begin, count), value.data(), g);
    const VectorBatch into = gradientSum.slice(begin);
    for (std::size_t k = 0; k < count; ++k)
    {
      sum[begin + k] += value[k];
      into.x[k] += g.x[k];
      into.y[k] += g.y[k];
      into.z[k] += g.z[k];
    }
  }
}

} // namespace hybridtree
