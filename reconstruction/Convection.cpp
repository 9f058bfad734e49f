// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/Convection.h"

#include "reconstruction/ConvectedSolid.h"
#include "reconstruction/SolidBoundary.h"
#include "reconstruction/SpatialOrder.h"
#include "reconstruction/Tetrahedralization.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

void appendBoundary(const Tetrahedralization& tetrahedra, const std::vector<std::uint8_t>& inside,
  ReconstructedSurface& surface, const Progress& progress)
{
  std::vector<std::int32_t> meshPoint(tetrahedra.points().size(), -1);
  TriangleMesh& mesh = surface.mesh;
  const std::vector<std::int32_t> facets = boundaryFacets(tetrahedra, inside, progress);
  mesh.triangles.reserve(facets.size());
  for (const std::int32_t facet : facets)
  {
    Triangle triangle = tetrahedra.facet(facet >> 2, facet & 3);
    for (std::int32_t& corner : triangle)
    {
      std::int32_t& point = meshPoint[corner];
      if (point < 0)
      {
        point = static_cast<std::int32_t>(mesh.points.size());
        mesh.points.push_back(tetrahedra.points()[corner]);
        surface.pointIds.push_back(corner);
      }
      corner = point;
    }
    mesh.triangles.push_back(triangle);
  }
}

} // namespace

ReconstructedSurface reconstruct(
  const std::vector<Vec3>& points, const ConvectionOptions& options, const Progress& progress)
{
  checkOptions(points.size(), options);
  const std::vector<std::int32_t> order = spatialOrder(points, progress);
  std::vector<Vec3> ordered(points.size());
  std::transform(
    order.begin(), order.end(), ordered.begin(), [&](std::int32_t point) { return points[point]; });
  const Tetrahedralization tetrahedra(ordered, ProgressPart(progress, 0.0, 0.6));
  ReconstructedSurface surface;
  const std::vector<std::uint8_t> inside =
    convectSolid(tetrahedra, options, surface.warnings, ProgressPart(progress, 0.6, 1.0));
  appendBoundary(tetrahedra, inside, surface, progress);
  for (std::int32_t& point : surface.pointIds)
  {
    point = order[point];
  }
  progress.check();
  setAreaNormals(surface.mesh);
  return surface;
}

} // namespace hybridtree
