// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <vtkNew.h>
#include <vtkPolyData.h>

#include <functional>

namespace benchmarks
{

/// How good the triangles of a mesh are, and how near to the surface they should be on.
struct MeshQuality
{
  std::size_t triangles = 0;
  double error = 0.0;       ///< root mean square of the distance of triangle centres to the surface
  double meanLeast = 0.0;   ///< mean of the triangles' least angles, degrees
  double below25 = 0.0;     ///< share of triangles with an angle below 25 degrees
  double aspectRatio = 0.0; ///< mean of longest side over twice sqrt(3) inradius; 1 is equilateral
};

/// \param distance of a point (x, y, z) to the surface.
MeshQuality qualityOf(
  const hybridtree::TriangleMesh& mesh, const std::function<double(const double*)>& distance);

///@{
/// The triangles of any result.
inline const hybridtree::TriangleMesh& trianglesOf(const hybridtree::TriangleMesh& mesh)
{
  return mesh;
}
hybridtree::TriangleMesh trianglesOf(vtkPolyData* data);
template <class Algorithm>
hybridtree::TriangleMesh trianglesOf(const vtkNew<Algorithm>& algorithm)
{
  return trianglesOf(algorithm->GetOutput());
}
///@}

} // namespace benchmarks
