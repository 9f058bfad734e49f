// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/PieceFields.h"

#include <algorithm>

namespace hybridtree
{

PiecesNear::PiecesNear(const BlendGroups& groups, const Box3& box)
  : groups_(groups), numbers_(groups.size())
{
  static thread_local ElementSelection selection; // no allocation once warm
  groups.pieces.select(box, selection);
  const auto placeOf = [&](const auto* element, const std::vector<BlendPieces::Place>& places)
  { return &places[groups.pieces.index(element)]; };
  std::vector<BlendPiece> met;
  met.reserve(selection.segments.size() + selection.triangles.size());
  for (const SegmentElement* segment : selection.segments)
  {
    met.push_back({ segment, nullptr, placeOf(segment, groups.places.segmentPlaces) });
  }
  for (const TriangleElement* triangle : selection.triangles)
  {
    met.push_back({ nullptr, triangle, placeOf(triangle, groups.places.trianglePlaces) });
  }
  std::vector<std::size_t> numbers;
  numbers.reserve(met.size());
  for (const BlendPiece& piece : met)
  {
    numbers.push_back(numbers_.add(piece.place->group));
  }
  begin_.assign(numbers_.size() + 1, 0);
  for (const std::size_t number : numbers)
  {
    ++begin_[number + 1];
  }
  for (std::size_t number = 0; number < numbers_.size(); ++number)
  {
    begin_[number + 1] += begin_[number];
  }
  std::vector<std::size_t> next(begin_.begin(), begin_.end());
  pieces_.resize(met.size());
  for (std::size_t k = 0; k < met.size(); ++k)
  {
    pieces_[next[numbers[k]]++] = met[k];
  }
}

PieceFields::PieceFields(const PiecesNear& pieces, PointBatch points)
  : pieces_(pieces)
  , kernel_(pieces.groups().whole.kernel())
  , kernels_(convolutionKernels(kernel_.kind))
  , farthest_(BlendShare(pieces.groups().control).farthest())
  , points_(points)
  , isKnown_(pieces.groupCount(), 0)
  , distancesAt_(pieces.size())
  , farAt_(pieces.groupCount() * pieces.groupCount(), -1)
  , single_(pieces.size() * points.size)
  , fields_(pieces.groupCount() * points.size)
{
}

const double* PieceFields::field(std::size_t number)
{
  if (!isKnown_[number])
  {
    this->integrate(number);
    isKnown_[number] = 1;
  }
  return this->row(fields_, number);
}

void PieceFields::integrate(std::size_t number)
{
  double* sum = this->row(fields_, number);
  std::fill_n(sum, points_.size, 0.0);
  const std::size_t groups = pieces_.groupCount();
  for (std::size_t k = pieces_.begin(number); k < pieces_.end(number); ++k)
  {
    const BlendPiece& piece = pieces_[k];
    double* value = this->row(single_, k);
    std::fill_n(value, points_.size, 0.0);
    if (piece.segment)
    {
      kernels_.addSegments({ &piece.segment, 1 }, kernel_, points_, value);
    }
    else
    {
      kernels_.addTriangles({ &piece.triangle, 1 }, kernel_, points_, value);
    }
    for (std::size_t i = 0; i < points_.size; ++i)
    {
      sum[i] += value[i];
    }
    distancesAt_[k] = distances_.size();
    distances_.resize(distances_.size() + groups, farthest_);
    double* distances = distances_.data() + distancesAt_[k];
    distances[number] = 0.0;
    for (const GroupDistance& near : piece.place->distances)
    {
      const std::int32_t other = pieces_.find(near.group);
      if (other >= 0)
      {
        distances[other] = near.distance;
      }
    }
  }
}

const double* PieceFields::far(std::size_t number, std::size_t j)
{
  std::int32_t& at = farAt_[number * pieces_.groupCount() + j];
  const std::size_t size = points_.size;
  if (at >= 0)
  {
    return far_.data() + static_cast<std::size_t>(at) * size;
  }
  this->field(number);
  at = static_cast<std::int32_t>(far_.size() / size);
  far_.resize(far_.size() + size, 0.0);
  double* sum = far_.data() + far_.size() - size;
  for (std::size_t k = pieces_.begin(number); k < pieces_.end(number); ++k)
  {
    const double* value = this->row(single_, k);
    const double distance = this->distances(k)[j];
    for (std::size_t i = 0; i < points_.size; ++i)
    {
      sum[i] += distance * value[i];
    }
  }
  return sum;
}

void PieceFields::findNearness(double* rows)
{
  const std::size_t size = points_.size;
  std::fill_n(rows, pieces_.groupCount() * size, 0.0);
  for (std::size_t number = 0; number < pieces_.groupCount(); ++number)
  {
    this->field(number);
  }
  for (std::size_t piece = 0; piece < pieces_.size(); ++piece)
  {
    const double* value = this->row(single_, piece);
    if (std::all_of(value, value + size, [](double field) { return field == 0.0; }))
    {
      continue;
    }
    for (const GroupDistance& near : pieces_[piece].place->distances)
    {
      const std::int32_t other = pieces_.find(near.group);
      if (other >= 0)
      {
        double* sum = rows + static_cast<std::size_t>(other) * size;
        for (std::size_t k = 0; k < size; ++k)
        {
          sum[k] += (farthest_ - near.distance) * value[k];
        }
      }
    }
  }
}

void PieceFields::addFieldAndGradient(
  std::size_t piece, PointBatch points, double* value, VectorBatch gradient) const
{
  const BlendPiece& of = pieces_[piece];
  if (of.segment)
  {
    kernels_.addSegmentsWithGradient({ &of.segment, 1 }, kernel_, points, value, gradient);
  }
  else
  {
    kernels_.addTrianglesWithGradient({ &of.triangle, 1 }, kernel_, points, value, gradient);
  }
}

} // namespace hybridtree
