// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/DeformedBlendCost.h"

namespace hybridtree
{
namespace
{

// To map a triangle and mend it where it is thin: on average, and the more the map stretches the
// surface, as that makes triangles. Fitted to balls and limbs under twists, tapers and bends.
constexpr double kLatticeTriangles = 3.0; // per square
constexpr double kKeptTriangles = 3.8;    // of shapes that are meshed directly
constexpr double kNewTriangles = 0.45;    // per marked cell
constexpr double kMendLattice = 0.63;
constexpr double kMendLatticeGrown = 1.8;
constexpr double kMend = 0.13;
constexpr double kMendGrown = 0.45;
constexpr double kMendNew = 0.16; // more than that
constexpr double kMendNewGrown = 0.7;

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
    (kMendLattice + kMendLatticeGrown * growth_);
}

double DeformedBlendCost::local(double cells, const Division& division) const
{
  return kDoubt *
    (kPatchLine * division.border + cells * (kPatchCell + sample_.inCell) +
      kKeptSquare * division.kept +
      this->mending(kKeptTriangles * division.kept, kNewTriangles * cells));
}

double DeformedBlendCost::local(double cells, double border, const Surface& surface) const
{
  return kDoubt *
    (plain_.local(cells, border, surface.plain) +
      this->mending(surface.triangles, kNewTriangles * cells));
}

double DeformedBlendCost::mending(double kept, double made) const
{
  return (kept + made) * (kMend + kMendGrown * growth_) +
    made * (kMendNew + kMendNewGrown * growth_);
}

} // namespace hybridtree
