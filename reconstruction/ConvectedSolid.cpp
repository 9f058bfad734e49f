// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/ConvectedSolid.h"

#include "reconstruction/BallSides.h"
#include "reconstruction/FacetSize.h"
#include "reconstruction/Front.h"
#include "reconstruction/Holes.h"
#include "reconstruction/Regions.h"
#include "reconstruction/SheetSides.h"
#include "reconstruction/Sides.h"
#include "reconstruction/SolidBoundary.h"
#include "reconstruction/SolidRepair.h"
#include "reconstruction/SpatialOrder.h"
#include "reconstruction/SurfaceParts.h"
#include "reconstruction/WorkEstimate.h"

#include "core/base/Error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

namespace hybridtree
{
namespace
{

// Tetrahedra of at least this size are told apart by the watershed; smaller ones are left to the
// flow. Low, since the watershed weighs both sides and the flow only knows one.
constexpr double kWide = 1.0;
// SideOptions::poles, for solids and where parts are missing.
constexpr double kPoles = 0.7;
constexpr double kPolesOfHoles = 1.5;
// Where fewer of the points than this share are on the surface, a part of it was perhaps not
// entered, or broken into: a second way to tell inside from outside is tried.
constexpr double kFewUsed = 0.9;
// Where as many are, no better way is looked for.
constexpr double kMostUsed = 0.97;
// It is kept if it reaches this many times as many.
constexpr double kMoreUsed = 1.05;
// Where points that lie together are hidden, the empty balls are asked (BallSides.h). What they say
// is taken if it leaves at most this share of the hidden points hidden, and if they agree: at most
// this share of the points is contradicted. Where a part is missing, as behind thin walls, more may
// be (0.01 in the worst drawings of meshes); in noise points see the same side both ways (0.13 and
// more): of what is found there, no handle is believed.
constexpr double kFewerHidden = 0.5;
constexpr double kContradicted = 0.0025;
constexpr double kNoisy = 0.05;

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

using Solid = std::vector<std::uint8_t>;

Solid solid(const Tetrahedralization& tetrahedra, const FacetSize& sizes,
  const std::vector<Region>& regions, bool openPockets, Voids voids, const Progress& progress)
{
  Front front(tetrahedra, sizes, regions);
  front.run(openPockets, voids, progress);
  std::vector<std::uint8_t> inside = front.inside();
  repairSolid(tetrahedra, inside, voids, progress);
  return inside;
}

// With two colours, which is slower.
Solid solidBySides(const Tetrahedralization& tetrahedra, const FacetSize& sizes,
  const SideOptions& options, bool openPockets, const Progress& progress)
{
  return solid(tetrahedra, sizes, findSides(tetrahedra, sizes, options, progress), openPockets,
    options.normals ? Voids::Kept : Voids::Filled, progress);
}

// What convection finds when it may nowhere change the topology: never nothing.
Solid solidFromHull(
  const Tetrahedralization& tetrahedra, const FacetSize& sizes, const Progress& progress)
{
  const std::vector<Region> regions(tetrahedra.cellCount(), Region::Surface);
  return solid(tetrahedra, sizes, regions, false, Voids::Filled, progress);
}

// Per point: whether it is on the boundary of a solid.
std::vector<std::uint8_t> usedBy(
  const Tetrahedralization& tetrahedra, const Solid& inside, const Progress& progress)
{
  std::vector<std::uint8_t> used(tetrahedra.points().size(), 0);
  for (const std::int32_t halfFacet : boundaryFacets(tetrahedra, inside, progress))
  {
    for (const std::int32_t vertex : tetrahedra.facet(halfFacet >> 2, halfFacet & 3))
    {
      used[vertex] = 1;
    }
  }
  return used;
}

double share(const std::vector<std::uint8_t>& used)
{
  return double(std::count(used.begin(), used.end(), 1)) / double(used.size());
}

// Whether a solid goes through clearly more points than another, and not by handles and crumbs but
// where there was nothing else.
bool isBetter(const Tetrahedralization& tetrahedra, const Solid& solid, const Solid& than,
  const Progress& progress, double pointsOfPart = kPointsOfPart)
{
  const SurfaceParts now = partsOfBoundary(tetrahedra, solid, progress);
  const SurfaceParts before = partsOfBoundary(tetrahedra, than, progress);
  return double(now.points) > kMoreUsed * double(before.points) &&
    (isPaidByPoints(now, before, pointsOfPart) || solidIsMissing(tetrahedra, than));
}

// Whether points that are not used lie together: single ones are noise, or where a surface is
// sharp; many, a wall, a hole or a gap that was not entered.
bool someAreHidden(
  const Tetrahedralization& tetrahedra, const FacetSize& sizes, std::vector<std::uint8_t> used)
{
  constexpr std::size_t kMany = 16;
  constexpr double kNear = 2.0; // spacings
  const auto& points = tetrahedra.points();
  std::vector<std::int32_t> group;
  for (std::int32_t seed = 0; seed < static_cast<std::int32_t>(used.size()); ++seed)
  {
    if (used[seed])
    {
      continue;
    }
    group.assign(1, seed);
    used[seed] = 1;
    for (std::size_t k = 0; k < group.size(); ++k)
    {
      const double reach = kNear * sizes.spacing(group[k]);
      for (const std::int32_t cell : tetrahedra.star(group[k]))
      {
        for (const std::int32_t other : tetrahedra.cell(cell))
        {
          if (other != Tetrahedralization::kInfinite && !used[other] &&
            (points[other] - points[group[k]]).norm() < reach)
          {
            used[other] = 1;
            group.push_back(other);
          }
        }
      }
    }
    if (group.size() >= kMany)
    {
      return true;
    }
  }
  return false;
}

// The solid that the empty balls tell, if it hides much less than another.
std::optional<Solid> solidByBalls(const Tetrahedralization& tetrahedra, const FacetSize& sizes,
  const Solid& than, const Progress& progress)
{
  const std::vector<std::uint8_t> used = usedBy(tetrahedra, than, progress);
  if (!someAreHidden(tetrahedra, sizes, used))
  {
    return std::nullopt;
  }
  const double before = share(used);
  BallSides sides = findSidesByBalls(tetrahedra, sizes, progress);
  if (sides.contradicted > kContradicted && before >= kFewUsed)
  {
    return std::nullopt;
  }
  repairSolid(tetrahedra, sides.inside, Voids::Filled, progress);
  const double now = share(usedBy(tetrahedra, sides.inside, progress));
  const bool clear =
    sides.contradicted <= kContradicted && 1.0 - now < kFewerHidden * (1.0 - before);
  const double price =
    sides.contradicted > kNoisy ? std::numeric_limits<double>::infinity() : kPointsOfPart;
  if (clear || (before < kFewUsed && isBetter(tetrahedra, sides.inside, than, progress, price)))
  {
    return std::move(sides.inside);
  }
  return std::nullopt;
}

// Whether the hull lies on both sides of a surface.
bool isOpen(const Tetrahedralization& tetrahedra, const std::vector<std::uint8_t>& inside)
{
  constexpr double kLeast = 0.05;
  const auto infinite = inside.begin() + tetrahedra.finiteCellCount();
  const double behind =
    double(std::count(infinite, inside.end(), 1)) / double(inside.end() - infinite);
  return behind > kLeast && behind < 1.0 - kLeast;
}

// What lies behind an open sheet, as far as to the hull: under a landscape, or what was seen from
// one side. Of both its sides that with more points, if no normals tell. Nothing if it is not open.
std::optional<Solid> solidBehindSheet(const Tetrahedralization& tetrahedra, const FacetSize& sizes,
  SiteNormals normals, const Progress& progress)
{
  const std::vector<std::uint8_t> inside = findSheetByBalls(tetrahedra, sizes, normals, progress);
  if (!isOpen(tetrahedra, inside))
  {
    return std::nullopt;
  }
  const auto bySide = [&](std::uint8_t side)
  {
    Solid solid(inside.size(), 0);
    std::transform(inside.begin(), inside.begin() + tetrahedra.finiteCellCount(), solid.begin(),
      [&](std::uint8_t of) { return static_cast<std::uint8_t>(of == side ? 1 : 0); });
    repairSolid(tetrahedra, solid, normals ? Voids::Kept : Voids::Filled, progress);
    return solid;
  };
  Solid behind = bySide(1);
  const double reached = share(usedBy(tetrahedra, behind, progress));
  if (!normals && reached < kMostUsed)
  {
    Solid before = bySide(0);
    if (share(usedBy(tetrahedra, before, progress)) > kMoreUsed * reached)
    {
      return before;
    }
  }
  return behind;
}

// Share of a solid's surface that is wider than the sampling anywhere near.
double shareOverNothing(const Tetrahedralization& tetrahedra, const FacetSize& sizes,
  const Solid& inside, const Progress& progress)
{
  constexpr double kNothing = 8.0; // spacings at the sparsest corner
  double all = 0.0;
  double over = 0.0;
  for (const std::int32_t halfFacet : boundaryFacets(tetrahedra, inside, progress))
  {
    const auto v = tetrahedra.facet(halfFacet >> 2, halfFacet & 3);
    const auto& p = tetrahedra.points();
    const double area = (p[v[1]] - p[v[0]]).cross(p[v[2]] - p[v[0]]).norm();
    all += area;
    over += sizes.certainOfFacet(halfFacet >> 2, halfFacet & 3) > kNothing ? area : 0.0;
  }
  return all > 0.0 ? over / all : 0.0;
}

void warnOfMissingParts(double share, std::vector<std::string>& warnings)
{
  constexpr double kMuch = 0.15;
  if (share > kMuch)
  {
    std::ostringstream text;
    text
      << std::lround(100.0 * share)
      << " % of the surface spans places without points: parts of it are missing, or it is open. "
         "It was closed over them; switch CloseHoles off to leave them open.";
    warnings.push_back(text.str());
  }
}

void checkMemory(std::size_t points, std::size_t limit)
{
  const double bytes = estimateWork(points).bytes;
  if (bytes <= static_cast<double>(limit))
  {
    return;
  }
  const double mib = std::ldexp(1.0, 20);
  std::ostringstream text;
  text << "Reconstruction of " << points << " points takes some " << std::ceil(bytes / mib)
       << " MiB of memory; the limit is " << std::floor(static_cast<double>(limit) / mib)
       << " MiB, enough for " << std::floor(static_cast<double>(limit) / estimateWork(1).bytes)
       << " points. Thin them by a larger Spacing.";
  throw TooLarge(text.str());
}

} // namespace

void checkOptions(std::size_t points, const ConvectionOptions& options)
{
  if (!(options.pocketFactor >= 1.0) || !std::isfinite(options.pocketFactor))
  {
    throw InvalidParameter("PocketFactor", options.pocketFactor, "a finite number from 1 on");
  }
  if (!options.closeHoles)
  {
    checkHoleFactor(options.holeFactor);
  }
  checkMemory(points, options.maxMemory);
}

void checkExtent(const std::vector<Vec3>& points)
{
  checkFinite(points);
  constexpr double kLargest = 1e50;
  Box3 box;
  for (const Vec3& point : points)
  {
    box.extend(point);
  }
  if (points.empty())
  {
    return;
  }
  const double most =
    std::max(box.min().lpNorm<Eigen::Infinity>(), box.max().lpNorm<Eigen::Infinity>());
  const double extent = box.sizes().maxCoeff();
  if (most > kLargest || (extent > 0.0 && extent < 1.0 / kLargest))
  {
    std::ostringstream text;
    text << "The points have coordinates up to " << most << " and an extent of " << extent
         << ": scale them, to an extent above 1e-50 and coordinates up to 1e50.";
    throw InvalidGeometry(text.str());
  }
}

void checkNormals(std::size_t points, const ConvectionOptions& options)
{
  if (!options.normals.empty() && options.normals.size() != points)
  {
    throw InvalidParameter("normals", double(options.normals.size()), "as many as points, or none");
  }
  for (std::size_t k = 0; k < options.normals.size(); ++k)
  {
    if (!options.normals[k].allFinite())
    {
      throw InvalidGeometry("The normal of point " + std::to_string(k) +
        " is not finite: mend it, use 0 for one that is not known, or reconstruct without "
        "normals.");
    }
  }
}

std::vector<std::uint8_t> convectSolid(const Tetrahedralization& tetrahedra,
  const ConvectionOptions& options, SiteNormals normals, std::vector<std::string>& warnings,
  const Progress& progress)
{
  const FacetSize sizes(tetrahedra, progress);
  SideOptions sides{ kWide, options.pocketFactor, false, kPoles, normals };
  const auto bySides = [&](double from, double to)
  {
    progress.check();
    progress.report(from);
    return solidBySides(
      tetrahedra, sizes, sides, options.openPockets, ProgressPart(progress, from, to));
  };
  Solid told; // by normals
  double toldUsed = 0.0;
  if (normals)
  {
    told = bySides(0.1, 1.0);
    toldUsed = solidIsMissing(tetrahedra, told) ? 0.0 : share(usedBy(tetrahedra, told, progress));
    if (toldUsed >= kFewUsed)
    {
      warnOfMissingParts(shareOverNothing(tetrahedra, sizes, told, progress), warnings);
      return told;
    }
  }
  Solid inside =
    solid(tetrahedra, sizes, findRegions(tetrahedra, sizes, kWide, options.pocketFactor, progress),
      options.openPockets, Voids::Filled, ProgressPart(progress, 0.1, 0.7));
  double used = share(usedBy(tetrahedra, inside, progress));
  const auto takeIfBetter = [&](Solid& other)
  {
    if (isBetter(tetrahedra, other, inside, progress))
    {
      inside.swap(other);
      used = share(usedBy(tetrahedra, inside, progress));
    }
  };
  // At first as mouths are wide; then, as where a part is missing, no mouth is taken for granted.
  for (const double mouth : { options.pocketFactor, std::numeric_limits<double>::infinity() })
  {
    if (used < kFewUsed)
    {
      sides.mouth = mouth;
      sides.poles = std::isinf(mouth) ? kPolesOfHoles : kPoles;
      Solid other = bySides(0.7, 0.8);
      takeIfBetter(other);
    }
  }
  std::optional<Solid> behind;
  if (used < kFewUsed)
  {
    behind = solidBehindSheet(tetrahedra, sizes, normals, ProgressPart(progress, 0.8, 0.85));
  }
  const bool reached = behind && share(usedBy(tetrahedra, *behind, progress)) >= kMostUsed;
  if (options.openPockets && !reached)
  {
    if (auto other = solidByBalls(tetrahedra, sizes, inside, ProgressPart(progress, 0.85, 0.9)))
    {
      inside.swap(*other);
    }
  }
  if (behind)
  {
    takeIfBetter(*behind);
  }
  if (toldUsed > 0.0 && !isBetter(tetrahedra, inside, told, progress))
  {
    inside.swap(told);
  }
  if (solidIsMissing(tetrahedra, inside))
  {
    warnings.push_back("The points are too few, too scattered or on too open a surface to tell "
                       "inside from outside: only dents were followed.");
    inside = solidFromHull(tetrahedra, sizes, ProgressPart(progress, 0.9, 1.0));
  }
  else
  {
    warnOfMissingParts(shareOverNothing(tetrahedra, sizes, inside, progress), warnings);
  }
  return inside;
}

std::vector<std::uint8_t> convectSheet(const Tetrahedralization& tetrahedra,
  const ConvectionOptions& options, SiteNormals normals, const Progress& progress)
{
  const FacetSize sizes(tetrahedra, progress);
  const SideOptions sides{ kWide, options.pocketFactor, true, kPolesOfHoles, normals };
  const Voids voids = normals ? Voids::Kept : Voids::Filled;
  const std::vector<Region> regions = findSides(tetrahedra, sizes, sides, progress);
  Front front(tetrahedra, sizes, regions);
  front.run(options.openPockets, voids, progress);
  std::vector<std::uint8_t> inside = front.inside();
  repairSheet(tetrahedra, inside, voids, progress);
  return inside;
}

std::vector<std::uint8_t> sheetByBalls(
  const Tetrahedralization& tetrahedra, SiteNormals normals, const Progress& progress)
{
  const FacetSize sizes(tetrahedra, progress);
  std::vector<std::uint8_t> inside = findSheetByBalls(tetrahedra, sizes, normals, progress);
  repairSheet(tetrahedra, inside, normals ? Voids::Kept : Voids::Filled, progress);
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
