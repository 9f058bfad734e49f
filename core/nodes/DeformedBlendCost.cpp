// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/DeformedBlendCost.h"

namespace hybridtree
{
namespace
{

// To map a triangle, and to split it, the more the map stretches the surface. Fitted to balls and
// limbs under twists, tapers and bends.
constexpr double kLatticeTriangles = 3.0; // per square
constexpr double kKeptTriangles = 3.8;    // of shapes that are meshed directly
constexpr double kNewTriangles = 0.45;    // per marked cell
constexpr double kMap = 0.13;
constexpr double kSplit = 0.45;
constexpr double kSplitLattice = 1.8;
constexpr double kSplitNew = 0.7; // more than of others

// To mend it where it is thin, on average.
constexpr double kMendLattice = 0.5;
constexpr double kMendNew = 0.16;

// How long the lines are along which meshes are cut tells the cost of a patch better than the cells
// at its border: most of those only lie above others.
constexpr double kKeptSquare = 0.2; // made, checked and copied
constexpr double kPatchCell = 0.60;
constexpr double kPatchLine = 36.0;

// Before all cells are marked: little.
constexpr double kLeastKept = 0.3;
constexpr double kLeastLine = 0.01; // per marked cell

// The estimate is right to about a fifth. Where it is not, the lattice shall be what was taken too
// often.
constexpr double kDoubt = 1.15;

} // namespace

bool DeformedBlendCost::isLocalCheaper(
  const CellSet& cells, const BlendCost::Surface& surface, const Division& division) const
{
  return this->local(static_cast<double>(cells.size()), division) <= this->global(surface);
}

std::size_t DeformedBlendCost::mostCells(const BlendCost::Surface& surface) const
{
  const double kept = kLeastKept * (surface.kept + surface.givenUp);
  return BlendCost::mostCells(
    [&](double cells) {
      return this->local(cells, { kept, kLeastLine * cells });
    },
    this->global(surface));
}

bool DeformedBlendCost::isLocalCheaper(const CellSet& cells, const Surface& surface) const
{
  return this->local(static_cast<double>(cells.size()), static_cast<double>(cells.borderCount()),
           surface) <= this->global(surface.plain);
}

std::size_t DeformedBlendCost::mostCells(const Surface& surface) const
{
  return BlendCost::mostCells([&](double cells)
    { return this->local(cells, BlendCost::usualBorder(cells), surface); },
    this->global(surface.plain));
}

double DeformedBlendCost::global(const BlendCost::Surface& surface) const
{
  return plain_.global(surface) +
    kLatticeTriangles * (surface.kept + surface.givenUp) *
    (kMap + kSplitLattice * growth_ + (mends_ ? kMendLattice : 0.0));
}

double DeformedBlendCost::local(double cells, const Division& division) const
{
  return kDoubt *
    (kPatchLine * division.border + cells * (kPatchCell + sample_.inCell) +
      kKeptSquare * division.kept +
      this->deforming(kKeptTriangles * division.kept, kNewTriangles * cells));
}

double DeformedBlendCost::local(double cells, double border, const Surface& surface) const
{
  return kDoubt *
    (plain_.local(cells, border, surface.plain) +
      this->deforming(surface.triangles, kNewTriangles * cells));
}

double DeformedBlendCost::deforming(double kept, double made) const
{
  return (kept + made) * (kMap + kSplit * growth_) +
    made * (kSplitNew * growth_ + (mends_ ? kMendNew : 0.0));
}

} // namespace hybridtree
