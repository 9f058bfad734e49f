// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/BlendCost.h"
#include "core/nodes/Deformation.h"
#include "core/nodes/DeformedBlendCost.h"
#include "core/nodes/MarkedCells.h"

#include <vector>

namespace hybridtree
{

/// What the terms of a blend tell of its mesh before there is one, for BlendCost. All of it is the
/// same for the same terms.

/// What a value of the field costs: terms count by what they have of the surface, and by what they
/// have in common with others.
BlendCost::Sample sampleCost(const std::vector<MarkTerm>& terms, double edgeLength);

/// Area of the surfaces of the terms that keep their mesh, in squared cells, by how many of some
/// hundred points lie near the surface; right to about a tenth.
double squaresByPoints(const std::vector<MarkTerm>& terms, double cellSize);

/// The same of terms that give up their mesh, as far as they lie outside of the others' boxes. By
/// the sides of boxes, which is two to three times too large for limbs that lie slant in theirs.
double squaresGivenUp(const std::vector<MarkTerm>& terms, double cellSize);

/// Points on meshes: the middles of some triangles.
SurfaceSample sampleSurfaces(const std::vector<MeshPtr>& meshes);

/// Some hundred points near the surface of a blend of skeletons, spread evenly.
class BlendSample
{
public:
  /// \param shapes that make its surface, and which of them keep their mesh. Must outlive this.
  BlendSample(const Node& blend, const std::vector<MarkTerm>& shapes, double cellSize);

  const SurfaceSample& surface() const { return surface_; }
  double squares() const; ///< its area, in squared cells

  /// How marked cells divide the surfaces of the shapes that keep their mesh.
  DeformedBlendCost::Division division(const CellSet& cells, const CellGrid& grid) const;

private:
  /// Of one shape.
  struct Part
  {
    const MarkTerm* shape;
    double squaresPerPoint;
    double reach; ///< of the points from the surface
    std::vector<Vec3> points;
    std::vector<Vec3> normals;
    std::vector<double> fields; ///< of the shape alone
  };

  void addVisible(const Node& blend, const Part& part);

  std::vector<Part> parts_;
  SurfaceSample surface_;
};

} // namespace hybridtree
