// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/BlendCost.h"

#include <cmath>

namespace hybridtree
{
namespace
{

// A plane cuts 1.5 edges for each of its squares, in the mean over directions. Bricks of 8^3
// samples have some hundred points each.
constexpr double kPointsPerSquare = 1.5;
constexpr double kSamplesPerPoint = 5.0;
constexpr double kPoint = 0.085; // to place and to connect

// The work is at the border, which is cut, joined and mended: the less for each cell the more there
// are, since ever more of them only lie above others. Where little is marked, and the choice is
// open, much that is inside comes with it.
constexpr double kSamplesPerCell = 2.1;
constexpr double kBorder = 31.0;
constexpr double kBorderPower = 0.72;
constexpr double kLeastBorder = 0.5; // of all marked cells, where they are few

// Per square of what is kept: three triangles, checked and copied.
constexpr double kKeptSquare = 0.11;

// The estimate is right to about a tenth. Where it is not, the lattice shall be what was taken too
// often.
constexpr double kDoubt = 1.08;

} // namespace

double BlendCost::global(double squares) const
{
  return kPointsPerSquare * squares * (kPoint + kSamplesPerPoint * sample_.onSurface);
}

bool BlendCost::isLocalCheaper(const CellSet& cells, double kept, double givenUp) const
{
  const auto count = static_cast<double>(cells.size());
  return this->local(count, static_cast<double>(cells.borderCount()), kept) <=
    this->global(kept + givenUp);
}

double BlendCost::local(double cells, double border, double kept) const
{
  return kDoubt *
    (kBorder * std::pow(border, kBorderPower) + cells * kSamplesPerCell * sample_.inCell +
      kKeptSquare * kept);
}

std::size_t BlendCost::mostCells(double kept, double givenUp) const
{
  const double global = this->global(kept + givenUp);
  double least = 0.0;
  double most = 1e15;
  while (most - least > 1.0 + 0.01 * least)
  {
    const double middle = std::sqrt((least + 1.0) * most);
    (this->local(middle, kLeastBorder * middle, kept) <= global ? least : most) = middle;
  }
  return static_cast<std::size_t>(least);
}

} // namespace hybridtree
