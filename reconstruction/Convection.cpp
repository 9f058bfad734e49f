// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/Convection.h"

#include "reconstruction/ConvectedSolid.h"
#include "reconstruction/Holes.h"
#include "reconstruction/NoiseWarning.h"
#include "reconstruction/SolidBoundary.h"
#include "reconstruction/SpatialOrder.h"
#include "reconstruction/SurfaceParts.h"
#include "reconstruction/Tetrahedralization.h"
#include "reconstruction/WorkEstimate.h"

#include "core/mesh/MeshChecks.h"

#include <algorithm>
#include <cmath>
#include <utility>

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

ReconstructedSurface sheetAround(const Tetrahedralization& tetrahedra,
  const std::vector<std::uint8_t>& inside, double holeFactor, const Progress& progress)
{
  ReconstructedSurface sheet;
  appendBoundary(tetrahedra, inside, sheet, progress);
  openHoles(sheet, tetrahedra.points(), holeFactor, progress);
  return sheet;
}

// Clearly more points, and half of the others at least, and not by handles and holes; or anything
// where nothing is.
bool isBetter(
  const ReconstructedSurface& sheet, const ReconstructedSurface& than, std::size_t points)
{
  constexpr double kMore = 1.005;
  constexpr double kFewerLeft = 0.5;
  const auto now = double(sheet.pointIds.size());
  const auto before = double(than.pointIds.size());
  return than.mesh.triangles.empty() ||
    (now > kMore * before && double(points) - now < kFewerLeft * (double(points) - before) &&
      isPaidByPoints(partsOfMesh(sheet.mesh), partsOfMesh(than.mesh)));
}

// Sizes tell sides where most of a solid is there. What lies open on both sides, as a landscape,
// has no inside that they could see: there the empty balls are asked.
ReconstructedSurface bestSheet(const Tetrahedralization& tetrahedra,
  const ConvectionOptions& options, SiteNormals normals, const Progress& progress)
{
  const std::size_t points = tetrahedra.points().size();
  ReconstructedSurface sheet = sheetAround(tetrahedra,
    convectSheet(tetrahedra, options, normals, ProgressPart(progress, 0.0, 0.5)),
    options.holeFactor, progress);
  if (double(sheet.pointIds.size()) >= kNearlyAll * double(points))
  {
    return sheet;
  }
  ReconstructedSurface other =
    sheetAround(tetrahedra, sheetByBalls(tetrahedra, normals, ProgressPart(progress, 0.5, 1.0)),
      options.holeFactor, progress);
  return isBetter(other, sheet, points) ? other : sheet;
}

// Whether an open surface looks inward from the middle of its points or, where that does not tell,
// as of a landscape, down the axis that most of it looks along. Of a closed one it says no.
bool looksInward(const TriangleMesh& mesh)
{
  constexpr double kTelling = 0.2; // share of the surface's moment about the middle
  constexpr double kOpen = 0.01;   // share of the area that does not cancel
  Vec3 middle = Vec3::Zero();
  for (const Vec3& point : mesh.points)
  {
    middle += point / double(mesh.points.size());
  }
  double outward = 0.0;
  double reach = 0.0;
  double area = 0.0;
  Vec3 way = Vec3::Zero();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const Vec3 normal = areaNormal(mesh, t);
    const Vec3 arm = mesh.points[mesh.triangles[t][0]] - middle;
    outward += normal.dot(arm);
    reach += normal.norm() * arm.norm();
    area += normal.norm();
    way += normal;
  }
  int axis = 0;
  way.cwiseAbs().maxCoeff(&axis);
  return std::abs(outward) > kTelling * reach ? outward < 0.0 : way[axis] < -kOpen * area;
}

// What nobody has said which way it looks.
void turnOutward(TriangleMesh& mesh)
{
  if (looksInward(mesh))
  {
    for (Triangle& triangle : mesh.triangles)
    {
      std::swap(triangle[1], triangle[2]);
    }
  }
}

// Through which points the sheet goes, if it finds one; else the boundary of the solid.
ReconstructedSurface convect(const Tetrahedralization& tetrahedra, const ConvectionOptions& options,
  SiteNormals normals, const Progress& progress)
{
  ReconstructedSurface surface;
  if (!options.closeHoles)
  {
    surface = bestSheet(tetrahedra, options, normals, progress);
    if (!normals)
    {
      turnOutward(surface.mesh);
    }
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
  const Tetrahedralization tetrahedra(
    ordered, ProgressPart(progress, 0.0, 0.6), mostTetrahedra(options.maxMemory));
  ReconstructedSurface surface = convect(
    tetrahedra, options, normals.empty() ? nullptr : &normals, ProgressPart(progress, 0.6, 1.0));
  for (std::int32_t& point : surface.pointIds)
  {
    point = order[point];
  }
  progress.check();
  setAreaNormals(surface.mesh);
  warnOfNoise(points, surface);
  return surface;
}

} // namespace hybridtree
