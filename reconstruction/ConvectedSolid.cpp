// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/ConvectedSolid.h"

#include "reconstruction/FacetSize.h"
#include "reconstruction/Front.h"
#include "reconstruction/Holes.h"
#include "reconstruction/Regions.h"
#include "reconstruction/Sides.h"
#include "reconstruction/SolidBoundary.h"
#include "reconstruction/SolidRepair.h"
#include "reconstruction/SpatialOrder.h"
#include "reconstruction/Votes.h"
#include "reconstruction/WorkEstimate.h"

#include "core/base/Error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

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
// It is kept if it reaches this many times as many.
constexpr double kMoreUsed = 1.05;
// Where points are overlooked, votes are taken on what is outside (Votes.h). What comes out is kept
// if it leaves at most this share of them hidden.
constexpr double kFewerHidden = 0.5;
// And if it is in no more pieces, each handle more uncovers this many, and what was a ball gets no
// more than one: others may be faults of the sampling.
constexpr std::ptrdiff_t kPointsOfHandle = 30;

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
  const std::vector<Region>& regions, bool openPockets, Voids voids, const Progress& progress,
  Membranes membranes = Membranes::Wide)
{
  Front front(tetrahedra, sizes, regions);
  front.run(openPockets, voids, membranes, progress);
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

// Of a solid's boundary.
struct Outcome
{
  std::vector<std::uint8_t> used; // per point: whether it is on it
  std::size_t points = 0;         // that are
  std::ptrdiff_t handles = 0;     // less components

  double share() const { return double(points) / double(used.size()); }
};

Outcome outcomeOf(
  const Tetrahedralization& tetrahedra, const Solid& inside, const Progress& progress)
{
  Outcome outcome;
  outcome.used.assign(tetrahedra.points().size(), 0);
  const std::vector<std::int32_t> facets = boundaryFacets(tetrahedra, inside, progress);
  for (const std::int32_t halfFacet : facets)
  {
    for (const std::int32_t vertex : tetrahedra.facet(halfFacet >> 2, halfFacet & 3))
    {
      outcome.used[vertex] = 1;
    }
  }
  outcome.points =
    static_cast<std::size_t>(std::count(outcome.used.begin(), outcome.used.end(), 1));
  // Of a closed surface of triangles.
  outcome.handles = (std::ptrdiff_t(facets.size() / 2) - std::ptrdiff_t(outcome.points)) / 2;
  return outcome;
}

// How many a solid falls into; pieces that touch by no facet are two.
int pieces(const Tetrahedralization& tetrahedra, const Solid& inside)
{
  int count = 0;
  Solid left = inside;
  std::vector<std::int32_t> cells;
  for (std::int32_t seed = 0; seed < tetrahedra.finiteCellCount(); ++seed)
  {
    count += left[seed];
    cells.assign(left[seed], seed);
    left[seed] = 0;
    while (!cells.empty())
    {
      const std::int32_t cell = cells.back();
      cells.pop_back();
      for (int facet = 0; facet < 4; ++facet)
      {
        const std::int32_t beyond = tetrahedra.neighbor(cell, facet);
        if (left[beyond])
        {
          left[beyond] = 0;
          cells.push_back(beyond);
        }
      }
    }
  }
  return count;
}

// Whether points that are not used lie together: single ones are noise, or where a surface is
// sharp; many, a wall, a hole or a gap that was not entered.
bool someAreOverlooked(
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
  if (normals)
  {
    Solid inside = bySides(0.1, 1.0);
    if (!solidIsMissing(tetrahedra, inside))
    {
      return inside;
    }
  }
  Solid inside =
    solid(tetrahedra, sizes, findRegions(tetrahedra, sizes, kWide, options.pocketFactor, progress),
      options.openPockets, Voids::Filled, ProgressPart(progress, 0.1, 0.7));
  Outcome outcome = outcomeOf(tetrahedra, inside, progress);
  const auto takeIf = [&](Solid&& other, const auto& better)
  {
    Outcome others = outcomeOf(tetrahedra, other, progress);
    if (better(others))
    {
      inside.swap(other);
      outcome = std::move(others);
    }
  };
  // At first as mouths are wide; then, as where a part is missing, no mouth is taken for granted.
  for (const double mouth : { options.pocketFactor, std::numeric_limits<double>::infinity() })
  {
    if (outcome.share() < kFewUsed)
    {
      sides.mouth = mouth;
      sides.poles = std::isinf(mouth) ? kPolesOfHoles : kPoles;
      takeIf(bySides(0.7, 0.75),
        [&](const Outcome& other) { return other.share() > kMoreUsed * outcome.share(); });
    }
  }
  if (options.openPockets && options.closeHoles &&
    someAreOverlooked(tetrahedra, sizes, outcome.used))
  {
    const std::vector<Region> regions =
      voteOnRegions(tetrahedra, sizes, inside, kWide, ProgressPart(progress, 0.75, 0.8));
    Solid voted = solid(tetrahedra, sizes, regions, true, Voids::Filled,
      ProgressPart(progress, 0.8, 0.9), Membranes::Narrow);
    const bool whole = pieces(tetrahedra, voted) <= pieces(tetrahedra, inside);
    takeIf(std::move(voted),
      [&](const Outcome& other)
      {
        const auto more = std::ptrdiff_t(other.points) - std::ptrdiff_t(outcome.points);
        const std::ptrdiff_t handles = other.handles - outcome.handles;
        return whole && 1.0 - other.share() < kFewerHidden * (1.0 - outcome.share()) &&
          more >= kPointsOfHandle * handles && (outcome.handles > -1 || handles <= 1);
      });
  }
  if (solidIsMissing(tetrahedra, inside))
  {
    warnings.push_back("The points are too few, too scattered or on too open a surface to tell "
                       "inside from outside: only dents were followed.");
    inside = solidFromHull(tetrahedra, sizes, ProgressPart(progress, 0.9, 1.0));
  }
  return inside;
}

std::vector<std::uint8_t> convectSheet(const Tetrahedralization& tetrahedra,
  const ConvectionOptions& options, SiteNormals normals, const Progress& progress)
{
  const FacetSize sizes(tetrahedra, progress);
  const SideOptions sides{ kWide, options.pocketFactor, true, kPolesOfHoles, normals };
  return solidBySides(tetrahedra, sizes, sides, options.openPockets, progress);
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
