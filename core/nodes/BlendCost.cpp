// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/BlendCost.h"

#include <algorithm>
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
constexpr double kCell = 0.05; // to mark
constexpr double kSamplesPerCell = 1.0;
constexpr double kBorder = 31.0;
constexpr double kBorderPower = 0.72;
constexpr double kLeastBorder = 0.5; // of all marked cells, where they are few

// To look for the points on sharp edges, for each cell of their length: of the whole lattice, or of
// the share of the surface that is made anew.
constexpr double kCrease = 20.0;
constexpr double kCellsPerSquare = 4.0;

// Per square of what is kept: three triangles, checked and copied.
constexpr double kKeptSquare = 0.11;

// The estimate is right to about a tenth. Where it is not, the lattice shall be what was taken too
// often.
constexpr double kDoubt = 1.15;

// On meshes it is less sure, and far more is lost where local would have been faster.
constexpr double kDoubtOnMeshes = 0.93;

} // namespace

double BlendCost::global(const Surface& surface) const
{
  return kPointsPerSquare * (surface.kept + surface.givenUp) *
    (kPoint + kSamplesPerPoint * sample_.onSurface) +
    kCrease * surface.creases;
}

bool BlendCost::isLocalCheaper(const CellSet& cells, const Surface& surface) const
{
  const auto count = static_cast<double>(cells.size());
  return this->local(count, static_cast<double>(cells.borderCount()), surface) <=
    this->global(surface);
}

double BlendCost::local(double cells, double border, const Surface& surface) const
{
  const double anew = std::min(cells / (kCellsPerSquare * surface.kept + 1.0), 1.0);
  return (faceted_ ? kDoubtOnMeshes : kDoubt) *
    (kBorder * std::pow(border, kBorderPower) + cells * (kCell + kSamplesPerCell * sample_.inCell) +
      kKeptSquare * surface.kept + anew * kCrease * surface.creases);
}

std::size_t BlendCost::mostCells(const Surface& surface) const
{
  const double global = this->global(surface);
  double least = 0.0;
  double most = 1e15;
  while (most - least > 1.0 + 0.01 * least)
  {
    const double middle = std::sqrt((least + 1.0) * most);
    (this->local(middle, kLeastBorder * middle, surface) <= global ? least : most) = middle;
  }
  return static_cast<std::size_t>(least);
}

} // namespace hybridtree
