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
// are, since ever more of them only lie above others. What is inside comes with it. On meshes the
// border was measured to take less than half as much.
constexpr double kCell = 0.06; // to mark
constexpr double kSamplesPerCell = 1.15;
constexpr double kBorder = 20.4;
constexpr double kBorderOnMeshes = 8.0;
constexpr double kBorderPower = 0.72;

// Marked cells are rings and patches: so many are at the border, before they are known.
constexpr double kUsualBorder = 4.0;
constexpr double kUsualBorderPower = 0.73;

// To look for the points on sharp edges, for each cell of their length: of the whole lattice, or of
// the share of the surface that is made anew.
constexpr double kCrease = 20.0;
constexpr double kCellsPerSquare = 4.0;

// Per square of what is kept: three triangles, checked and copied; and made, which takes the more
// the more a sample does. Only meshes are there already.
constexpr double kKeptSquare = 0.12;
constexpr double kSamplesPerKeptSquare = 3.45;

// Marking is a twentieth of all, and then it is done.
constexpr double kLeftToDo = 0.95;

} // namespace

double BlendCost::usualBorder(double cells)
{
  return std::min(cells, kUsualBorder * std::pow(cells, kUsualBorderPower));
}

double BlendCost::global(const Surface& surface) const
{
  return kPointsPerSquare * (surface.kept + surface.givenUp) *
    (kPoint + kSamplesPerPoint * sample_.onSurface) +
    kCrease * surface.creases;
}

bool BlendCost::isLocalCheaper(const CellSet& cells, const Surface& surface) const
{
  const auto count = static_cast<double>(cells.size());
  return kLeftToDo * this->local(count, static_cast<double>(cells.borderCount()), surface) <=
    this->global(surface);
}

double BlendCost::local(double cells, double border, const Surface& surface) const
{
  const double anew = std::min(cells / (kCellsPerSquare * surface.kept + 1.0), 1.0);
  const double toMake = faceted_ ? 0.0 : kSamplesPerKeptSquare * sample_.onSurface;
  return (faceted_ ? kBorderOnMeshes : kBorder) * std::pow(border, kBorderPower) +
    cells * (kCell + kSamplesPerCell * sample_.inCell) + (kKeptSquare + toMake) * surface.kept +
    anew * kCrease * surface.creases;
}

std::size_t BlendCost::mostCells(const Surface& surface) const
{
  return BlendCost::mostCells([&](double cells)
    { return this->local(cells, BlendCost::usualBorder(cells), surface); },
    this->global(surface));
}

std::size_t BlendCost::mostCells(const std::function<double(double)>& costOfCells, double most)
{
  double least = 0.0;
  double tooMany = 1e15;
  while (tooMany - least > 1.0 + 0.01 * least)
  {
    const double middle = std::sqrt((least + 1.0) * tooMany);
    (costOfCells(middle) <= most ? least : tooMany) = middle;
  }
  return static_cast<std::size_t>(least);
}

} // namespace hybridtree
