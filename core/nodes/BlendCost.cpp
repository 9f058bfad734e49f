// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/BlendCost.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

// Of one value of the field.
constexpr double kSkeletonSample = 0.015;
constexpr double kMeshSample = 1.6;

// Per point of the surface: bricks of 8^3 samples have some hundred points each.
constexpr double kPointsPerSquare = 1.4;
constexpr double kSamplesPerPoint = 5.0;
constexpr double kPoint = 0.12; // to place and to connect

// Per marked cell. Where there are few, most are at the border, which is cut, joined and mended;
// where there are many, local has lost already.
constexpr double kSamplesPerCell = 2.0;
constexpr double kCell = 5.0;

// Per square of what is kept: two triangles or more, checked and copied.
constexpr double kKeptSquare = 0.13;

} // namespace

BlendCost::BlendCost(bool faceted) : perSample_(faceted ? kMeshSample : kSkeletonSample) {}

double BlendCost::global(double squares) const
{
  return kPointsPerSquare * squares * (kPoint + kSamplesPerPoint * perSample_);
}

double BlendCost::local(std::size_t cells, double squares) const
{
  return static_cast<double>(cells) * (kCell + kSamplesPerCell * perSample_) +
    kKeptSquare * squares;
}

std::size_t BlendCost::mostCells(double squares) const
{
  const double left = this->global(squares) - this->local(0, squares);
  return static_cast<std::size_t>(
    std::clamp(left / (kCell + kSamplesPerCell * perSample_), 0.0, 1e15));
}

} // namespace hybridtree
