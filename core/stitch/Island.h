// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/stitch/CutMesh.h"
#include "core/stitch/Stitch.h"

#include <utility>
#include <vector>

namespace hybridtree
{

/// A point of one of the parts.
struct PartPoint
{
  std::int32_t part = 0;
  std::int32_t point = 0;

  bool operator<(const PartPoint& other) const
  {
    return std::make_pair(part, point) < std::make_pair(other.part, other.point);
  }
  bool operator==(const PartPoint& other) const
  {
    return part == other.part && point == other.point;
  }
};

/// What the parts are to an island: what goes, and what is cut.
struct IslandCut
{
  std::vector<CutMesh> cuts; ///< per part
  /// The corners of all triangles that are cut or made anew with those, rising. Islands that have
  /// one in common have to be made as one.
  std::vector<PartPoint> rim;
};

/// The surface in some marked cells, which no others touch, and around them up to the triangles
/// that are not cut.
struct Island
{
  std::vector<std::vector<std::int32_t>> gone; ///< per part: triangles that this replaces
  std::vector<PartPoint> rim;
  /// Its first points are the rim; not all of them need have a triangle. The rest is new.
  TriangleMesh mesh;
  std::size_t samplePoints = 0; ///< found on the surface by marching cubes
  std::size_t cutTriangles = 0;
  /// Cells in which something came out wrong. Where there are any, the rest is of no use.
  std::vector<Index3> faults;

  std::size_t bytes() const;
};

std::vector<std::size_t> sizesOf(const std::vector<KeptPart>& parts); ///< in triangles

IslandCut cutIsland(const std::vector<KeptPart>& parts, const CellSet& cells, const CellGrid& grid,
  const Progress& progress);

/// Fills the marked cells up to the cut (Patch.h), gives patch and cut pieces a better shape
/// (PatchShape.h), and checks: closed with what lies around, oriented, a 2-manifold, no triangle
/// turned against the gradient. \throws TooLarge, Cancelled.
Island makeIsland(const IslandField& field, const IslandField::Near& near,
  const std::vector<KeptPart>& parts, IslandCut cut, const CellSet& cells,
  const StitchOptions& options, const Progress& progress);

} // namespace hybridtree
