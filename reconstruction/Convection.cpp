// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/Convection.h"

#include "reconstruction/ConvectedSolid.h"
#include "reconstruction/EstimateNormals.h"
#include "reconstruction/Holes.h"
#include "reconstruction/SolidBoundary.h"
#include "reconstruction/SpatialOrder.h"
#include "reconstruction/Tetrahedralization.h"

#include "core/mesh/MeshChecks.h"

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

// Above this share of the points a sheet is taken as it is, without looking for a better one.
constexpr double kNearlyAll = 0.99;

ReconstructedSurface sheetBy(const Tetrahedralization& tetrahedra, const ConvectionOptions& options,
  SiteNormals normals, const Progress& progress)
{
  ReconstructedSurface sheet;
  appendBoundary(tetrahedra, convectSheet(tetrahedra, options, normals, progress), sheet, progress);
  openHoles(sheet, tetrahedra.points(), options.holeFactor, progress);
  return sheet;
}

// Clearly more points in no more pieces, or anything where nothing is.
bool isBetter(const ReconstructedSurface& sheet, const ReconstructedSurface& than)
{
  constexpr double kMore = 1.01;
  return double(sheet.pointIds.size()) > kMore * double(than.pointIds.size()) &&
    (than.mesh.triangles.empty() ||
      checkMesh(sheet.mesh).components <= checkMesh(than.mesh).components);
}

// Sizes tell sides where most of a solid is there. What lies open on both sides, as a landscape,
// has no inside that they could see, but it is mostly smooth: there normals can be estimated.
ReconstructedSurface bestSheet(const Tetrahedralization& tetrahedra,
  const ConvectionOptions& options, SiteNormals normals, const Progress& progress)
{
  const std::vector<Vec3>& points = tetrahedra.points();
  ReconstructedSurface sheet =
    sheetBy(tetrahedra, options, normals, ProgressPart(progress, 0.0, 0.5));
  if (normals || double(sheet.pointIds.size()) >= kNearlyAll * double(points.size()))
  {
    return sheet;
  }
  const std::vector<Vec3> estimated = estimateNormals(points, ProgressPart(progress, 0.5, 0.6));
  if (estimated.empty())
  {
    return sheet;
  }
  ReconstructedSurface other =
    sheetBy(tetrahedra, options, &estimated, ProgressPart(progress, 0.6, 1.0));
  return isBetter(other, sheet) ? other : sheet;
}

// Through which points the sheet goes, if it finds one; else the boundary of the solid.
ReconstructedSurface convect(const Tetrahedralization& tetrahedra, const ConvectionOptions& options,
  SiteNormals normals, const Progress& progress)
{
  ReconstructedSurface surface;
  if (!options.closeHoles)
  {
    surface = bestSheet(tetrahedra, options, normals, progress);
    if (2 * surface.pointIds.size() > tetrahedra.points().size())
    {
      return surface;
    }
    surface = {};
  }
  appendBoundary(tetrahedra, convectSolid(tetrahedra, options, normals, surface.warnings, progress),
    surface, progress);
  if (!options.closeHoles)
  {
    openHoles(surface, tetrahedra.points(), options.holeFactor, progress);
  }
  return surface;
}

template <typename Item>
std::vector<Item> inOrder(const std::vector<Item>& items, const std::vector<std::int32_t>& order)
{
  std::vector<Item> ordered(order.size());
  std::transform(
    order.begin(), order.end(), ordered.begin(), [&](std::int32_t item) { return items[item]; });
  return ordered;
}

} // namespace

ReconstructedSurface reconstruct(
  const std::vector<Vec3>& points, const ConvectionOptions& options, const Progress& progress)
{
  checkOptions(points.size(), options);
  checkExtent(points);
  checkNormals(points.size(), options);
  const std::vector<std::int32_t> order = spatialOrder(points, progress);
  const std::vector<Vec3> ordered = inOrder(points, order);
  const std::vector<Vec3> normals =
    options.normals.empty() ? std::vector<Vec3>() : inOrder(options.normals, order);
  const Tetrahedralization tetrahedra(ordered, ProgressPart(progress, 0.0, 0.6));
  ReconstructedSurface surface = convect(
    tetrahedra, options, normals.empty() ? nullptr : &normals, ProgressPart(progress, 0.6, 1.0));
  for (std::int32_t& point : surface.pointIds)
  {
    point = order[point];
  }
  progress.check();
  setAreaNormals(surface.mesh);
  return surface;
}

} // namespace hybridtree
