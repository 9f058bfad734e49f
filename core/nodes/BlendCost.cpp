// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/BlendCost.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

// Of one value of the field.
constexpr double kSkeletonSample = 0.015;
constexpr double kMeshSample = 2.2;

// A plane cuts 1.5 edges for each of its squares, in the mean over directions. Bricks of 8^3
// samples have some hundred points each.
constexpr double kPointsPerSquare = 1.5;
constexpr double kSamplesPerPoint = 5.0;
constexpr double kPoint = 0.125; // to place and to connect

// The work is at the border, which is cut, joined and mended. Where little is marked, and the
// choice is open, all that is inside comes with it.
constexpr double kSamplesPerCell = 2.0;
constexpr double kBorderCell = 5.6;
constexpr double kLeastBorder = 0.6; // of all marked cells, where they are few

// Per square of what is kept: three triangles, checked and copied.
constexpr double kKeptSquare = 0.14;

} // namespace

BlendCost::BlendCost(bool faceted) : perSample_(faceted ? kMeshSample : kSkeletonSample) {}

double BlendCost::global(double squares) const
{
  return kPointsPerSquare * squares * (kPoint + kSamplesPerPoint * perSample_);
}

double BlendCost::local(const CellSet& cells, double squares) const
{
  return static_cast<double>(cells.borderCount()) * kBorderCell +
    static_cast<double>(cells.size()) * kSamplesPerCell * perSample_ + kKeptSquare * squares;
}

std::size_t BlendCost::mostCells(double squares) const
{
  const double left = this->global(squares) - this->local({}, squares);
  const double perCell = kLeastBorder * kBorderCell + kSamplesPerCell * perSample_;
  return static_cast<std::size_t>(std::clamp(left / perCell, 0.0, 1e15));
}

} // namespace hybridtree
