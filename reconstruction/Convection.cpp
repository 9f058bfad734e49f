// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/Convection.h"

#include "reconstruction/FacetSize.h"
#include "reconstruction/Front.h"
#include "reconstruction/Regions.h"
#include "reconstruction/SolidRepair.h"
#include "reconstruction/Tetrahedralization.h"

#include "core/base/Error.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace hybridtree
{
namespace
{

// Peak of the whole process on 200,000 points of a torus. Points that fill a volume have more
// tetrahedra, and take more.
constexpr double kBytesPerPoint = 3200.0;
// Tetrahedra of at least this size are told apart by the watershed; smaller ones are left to the
// flow. Low, since the watershed weighs both sides and the flow only knows one.
constexpr double kWide = 1.0;

void appendBoundary(const Tetrahedralization& tetrahedra, const std::vector<std::uint8_t>& inside,
  ReconstructedSurface& surface)
{
  std::vector<std::int32_t> meshPoint(tetrahedra.points().size(), -1);
  TriangleMesh& mesh = surface.mesh;
  for (std::int32_t cell = 0; cell < tetrahedra.finiteCellCount(); ++cell)
  {
    for (int facet = 0; inside[cell] && facet < 4; ++facet)
    {
      if (inside[tetrahedra.neighbor(cell, facet)])
      {
        continue;
      }
      Triangle triangle = tetrahedra.facet(cell, facet);
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
}

void computeNormals(TriangleMesh& mesh)
{
  mesh.normals.assign(mesh.points.size(), Vec3::Zero());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const Vec3 normal = areaNormal(mesh, t);
    for (const std::int32_t corner : mesh.triangles[t])
    {
      mesh.normals[corner] += normal;
    }
  }
  for (Vec3& normal : mesh.normals)
  {
    normal.normalize();
  }
}

// Whether no solid was found, or but crumbs along the surface of something open: none of them
// touches a hundredth of the points.
bool solidIsMissing(const Tetrahedralization& tetrahedra, const std::vector<std::uint8_t>& inside)
{
  std::vector<std::uint8_t> seen(inside.size(), 0);
  std::vector<std::int32_t> lastSolid(tetrahedra.points().size(), -1); // that touched the point
  std::vector<std::int32_t> cells;
  std::size_t most = 0;
  for (std::int32_t seed = 0; seed < tetrahedra.finiteCellCount(); ++seed)
  {
    if (!inside[seed] || seen[seed])
    {
      continue;
    }
    std::size_t touched = 0;
    cells.assign(1, seed);
    seen[seed] = 1;
    while (!cells.empty())
    {
      const std::int32_t cell = cells.back();
      cells.pop_back();
      for (int k = 0; k < 4; ++k)
      {
        std::int32_t& solid = lastSolid[tetrahedra.cell(cell)[k]];
        touched += solid != seed;
        solid = seed;
        const std::int32_t beyond = tetrahedra.neighbor(cell, k);
        if (inside[beyond] && !seen[beyond])
        {
          seen[beyond] = 1;
          cells.push_back(beyond);
        }
      }
    }
    most = std::max(most, touched);
  }
  return most * 100 < tetrahedra.points().size() || most == 0;
}

std::vector<std::uint8_t> solid(
  const Tetrahedralization& tetrahedra, const ConvectionOptions& options, const Progress& progress)
{
  const FacetSize sizes(tetrahedra, progress);
  const std::vector<Region> regions =
    findRegions(tetrahedra, sizes, kWide, options.pocketFactor, progress);
  Front front(tetrahedra, sizes, regions);
  front.run(options.openPockets, progress);
  std::vector<std::uint8_t> inside = front.inside();
  repairSolid(tetrahedra, inside, progress);
  return inside;
}

// What convection finds when it may nowhere change the topology: never nothing.
std::vector<std::uint8_t> solidFromHull(
  const Tetrahedralization& tetrahedra, const Progress& progress)
{
  const FacetSize sizes(tetrahedra, progress);
  std::vector<Region> regions(tetrahedra.cellCount(), Region::Surface);
  Front front(tetrahedra, sizes, regions);
  front.run(false, progress);
  std::vector<std::uint8_t> inside = front.inside();
  repairSolid(tetrahedra, inside, progress);
  return inside;
}

void checkMemory(std::size_t points, std::size_t limit)
{
  const double bytes = kBytesPerPoint * static_cast<double>(points);
  if (bytes <= static_cast<double>(limit))
  {
    return;
  }
  const double mib = std::ldexp(1.0, 20);
  std::ostringstream text;
  text << "Reconstruction of " << points << " points takes some " << std::ceil(bytes / mib)
       << " MiB of memory; the limit is " << std::floor(static_cast<double>(limit) / mib)
       << " MiB, enough for " << std::floor(static_cast<double>(limit) / kBytesPerPoint)
       << " points. Thin them by a larger Spacing.";
  throw TooLarge(text.str());
}

} // namespace

ReconstructedSurface reconstruct(
  const std::vector<Vec3>& points, const ConvectionOptions& options, const Progress& progress)
{
  if (!(options.pocketFactor > 1.0) || !std::isfinite(options.pocketFactor))
  {
    throw InvalidParameter("PocketFactor", options.pocketFactor, "a finite number above 1");
  }
  checkMemory(points.size(), options.maxMemory);
  const std::vector<std::int32_t> order = spatialOrder(points);
  progress.check();
  std::vector<Vec3> ordered(points.size());
  std::transform(
    order.begin(), order.end(), ordered.begin(), [&](std::int32_t point) { return points[point]; });
  const Tetrahedralization tetrahedra(ordered, ProgressPart(progress, 0.0, 0.6));
  ReconstructedSurface surface;
  std::vector<std::uint8_t> inside = solid(tetrahedra, options, ProgressPart(progress, 0.6, 0.95));
  progress.check();
  progress.report(0.95);
  if (solidIsMissing(tetrahedra, inside))
  {
    surface.warnings.push_back("The points are too few, too scattered or on too open a surface to "
                               "tell inside from outside: only dents were followed.");
    inside = solidFromHull(tetrahedra, ProgressPart(progress, 0.95, 1.0));
  }
  appendBoundary(tetrahedra, inside, surface);
  for (std::int32_t& point : surface.pointIds)
  {
    point = order[point];
  }
  progress.check();
  computeNormals(surface.mesh);
  return surface;
}

} // namespace hybridtree
