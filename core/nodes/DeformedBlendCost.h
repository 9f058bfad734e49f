// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/BlendCost.h"
#include "core/nodes/Deformation.h"

namespace hybridtree
{

/// As BlendCost, of a blend's mesh that a map then deforms: stretched triangles are split, and
/// where shapes become bad thin ones are mended. Of the lattice's more than a quarter are thin, of
/// the meshes that are kept none.
class DeformedBlendCost
{
public:
  /// What is meshed, and more of the meshes that are kept.
  struct Surface
  {
    BlendCost::Surface plain;
    double triangles; ///< of the meshes that are kept
  };

  /// What marked cells leave of the surfaces of parts that keep their meshes.
  struct Division
  {
    double kept;   ///< area, in squared cells
    double border; ///< length of the lines along which they are cut, in cells
  };

  /// \param stretch of the blend's surface.
  DeformedBlendCost(
    const BlendCost& plain, const BlendCost::Sample& sample, const SurfaceStretch& stretch)
    : plain_(plain), sample_(sample), growth_(stretch.growth), mends_(stretch.spoilsShapes)
  {
  }

  ///@{
  /// For skeletons. The sum of their kept and given up area is that of the blend, and tells of it
  /// all.
  bool isLocalCheaper(
    const CellSet& cells, const BlendCost::Surface& surface, const Division& division) const;
  std::size_t mostCells(const BlendCost::Surface& surface) const;
  ///@}

  ///@{
  /// For blends on meshes.
  bool isLocalCheaper(const CellSet& cells, const Surface& surface) const;
  std::size_t mostCells(const Surface& surface) const;
  ///@}

private:
  double global(const BlendCost::Surface& surface) const;
  double local(double cells, const Division& division) const;
  double local(double cells, double border, const Surface& surface) const;
  double deforming(double kept, double made) const; ///< triangles

  const BlendCost plain_;
  const BlendCost::Sample sample_;
  const double growth_;
  const bool mends_;
};

} // namespace hybridtree
