// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/ConvectedSolid.h"

#include "reconstruction/FacetSize.h"
#include "reconstruction/Front.h"
#include "reconstruction/Regions.h"
#include "reconstruction/SolidRepair.h"

#include "core/base/Error.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace hybridtree
{
namespace
{

// Peak of the whole process on 10^5 to 10^6 points of a bumpy sphere, and a third more: points that
// fill a volume have more tetrahedra.
constexpr double kBytesPerPoint = 1300.0;
// Tetrahedra of at least this size are told apart by the watershed; smaller ones are left to the
// flow. Low, since the watershed weighs both sides and the flow only knows one.
constexpr double kWide = 1.0;

// Whether no solid was found, or but crumbs along the surface of something open: none of them
// touches a hundredth of the points.
bool solidIsMissing(const Tetrahedralization& tetrahedra, const std::vector<std::uint8_t>& inside)
{
  std::vector<std::uint8_t> seen(inside.size(), 0);
  std::vector<std::int32_t> lastSolid(tetrahedra.points().size(), -1); // that touched the point
  std::vector<std::int32_t> cells;
  for (std::int32_t seed = 0; seed < tetrahedra.finiteCellCount(); ++seed)
  {
    if (!inside[seed] || seen[seed])
    {
      continue;
    }
    std::size_t touched = 0;
    cells.assign(1, seed);
    seen[seed] = 1;
    while (!cells.empty() && touched * 100 < tetrahedra.points().size())
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
    if (touched * 100 >= tetrahedra.points().size())
    {
      return false;
    }
  }
  return true;
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

void checkOptions(std::size_t points, const ConvectionOptions& options)
{
  if (!(options.pocketFactor > 1.0) || !std::isfinite(options.pocketFactor))
  {
    throw InvalidParameter("PocketFactor", options.pocketFactor, "a finite number above 1");
  }
  checkMemory(points, options.maxMemory);
}

std::vector<std::uint8_t> convectSolid(const Tetrahedralization& tetrahedra,
  const ConvectionOptions& options, std::vector<std::string>& warnings, const Progress& progress)
{
  std::vector<std::uint8_t> inside = solid(tetrahedra, options, ProgressPart(progress, 0.0, 0.9));
  progress.check();
  progress.report(0.9);
  if (solidIsMissing(tetrahedra, inside))
  {
    warnings.push_back("The points are too few, too scattered or on too open a surface to tell "
                       "inside from outside: only dents were followed.");
    inside = solidFromHull(tetrahedra, ProgressPart(progress, 0.9, 1.0));
  }
  return inside;
}

void setAreaNormals(TriangleMesh& mesh)
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

} // namespace hybridtree
