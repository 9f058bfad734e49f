// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/MixBlends.h"

#include "core/convolution/BlendMixture.h"
#include "core/convolution/FarBlends.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

constexpr std::size_t kMostNumbers = 1 << 20; // in the largest array

Box3 boxOf(PointBatch points)
{
  Box3 box;
  for (std::size_t k = 0; k < points.size; ++k)
  {
    box.extend(points[k]);
  }
  return box;
}

void clear(std::size_t count, double* value, const VectorBatch* gradient)
{
  std::fill_n(value, count, 0.0);
  for (double* array : { gradient ? gradient->x : value, gradient ? gradient->y : value,
         gradient ? gradient->z : value })
  {
    std::fill_n(array, count, 0.0);
  }
}

// Where fields end: from the pieces that reach the points.
void mixNear(
  const PiecesNear& pieces, PointBatch points, double* value, const VectorBatch* gradient)
{
  PieceFields fields(pieces, points);
  std::vector<double> bounds(pieces.groupCount());
  ScratchArray sum(points.size);
  std::fill_n(sum.data(), points.size, 0.0);
  for (std::size_t number = 0; number < bounds.size(); ++number)
  {
    const double* field = fields.field(number);
    bounds[number] = *std::max_element(field, field + points.size);
    for (std::size_t k = 0; k < points.size; ++k)
    {
      sum[k] += field[k];
    }
  }
  BlendMixture mixture(fields, bounds);
  std::vector<std::size_t> changed;
  for (std::size_t k = 0; k < points.size; ++k)
  {
    if (mixture.best(k) < sum[k])
    {
      value[k] = mixture.best(k);
      changed.push_back(k);
    }
  }
  if (gradient && !changed.empty())
  {
    mixture.findGradients(changed, *gradient);
  }
}

// mix(points, value, gradient) for parts of them.
template <typename Mix>
void forParts(
  std::size_t step, PointBatch points, double* value, const VectorBatch* gradient, const Mix& mix)
{
  for (std::size_t begin = 0; begin < points.size; begin += step)
  {
    const std::size_t count = std::min(step, points.size - begin);
    const VectorBatch slopes = gradient ? gradient->slice(begin) : VectorBatch{};
    mix(points.slice(begin, count), value + begin, gradient ? &slopes : nullptr);
  }
}

} // namespace

void mixBlends(
  const BlendGroups& groups, PointBatch points, double* value, const VectorBatch* gradient)
{
  if (groups.farGroups.empty())
  {
    mixBlends(PiecesNear(groups, boxOf(points)), points, value, gradient);
    return;
  }
  mixFarBlends(groups, points, value, gradient);
}

void mixBlends(
  const PiecesNear& pieces, PointBatch points, double* value, const VectorBatch* gradient)
{
  if (pieces.size() == 0)
  {
    clear(points.size, value, gradient);
    return;
  }
  forParts(std::clamp<std::size_t>(kMostNumbers / pieces.size(), 8, BlendMixture::kMostPoints),
    points, value, gradient,
    [&](PointBatch part, double* values, const VectorBatch* slopes)
    { mixNear(pieces, part, values, slopes); });
}

} // namespace hybridtree
