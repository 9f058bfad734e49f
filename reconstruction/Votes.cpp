// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/Votes.h"

#include "reconstruction/Poles.h"

#include "core/base/Parallel.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

// How often normals are taken, and how often neighbours are heard in between.
constexpr int kSweeps = 3;
constexpr int kRounds = 3;
// Balls of less than this many spacings across say nothing about a normal; from kFar on, all.
constexpr double kNear = 2.0;
constexpr double kFar = 6.0;
// A neighbour's weight beside that of a corner.
constexpr double kNeighbor = 0.2;
// Tetrahedra larger than this keep their side.
constexpr double kLarge = 4.0;

constexpr std::size_t kGrain = 2048;

// Per cell +1 outside, -1 inside, 0 unknown.
using Values = std::vector<float>;

class Votes
{
public:
  Votes(const Tetrahedralization& tetrahedra, const FacetSize& sizes,
    const std::vector<std::uint8_t>& inside, double wide, const Progress& progress)
    : tetrahedra_(tetrahedra)
    , sizes_(sizes)
    , progress_(progress)
    , centers_(tetrahedra.cellCount())
    , radii_(tetrahedra.cellCount(), 0.0)
    , normals_(tetrahedra.points().size())
    , votes_(tetrahedra.finiteCellCount(), 0.0f)
    , side_(tetrahedra.cellCount())
  {
    std::transform(inside.begin(), inside.end(), side_.begin(),
      [](std::uint8_t within) { return within ? -1.0f : 1.0f; });
    this->forCells(
      [&](std::int32_t cell)
      {
        this->measure(cell);
        side_[cell] = sizes_.ofCell(cell) <= wide ? 0.0f : side_[cell];
      });
    for (std::int32_t cell = tetrahedra_.finiteCellCount(); cell < tetrahedra_.cellCount(); ++cell)
    {
      centers_[cell] = hullNormal(tetrahedra_, cell);
    }
  }

  const Values& run()
  {
    Values next = side_;
    for (int sweep = 0; sweep < kSweeps; ++sweep)
    {
      this->takeNormals();
      this->forCells([this](std::int32_t cell) { votes_[cell] = this->ofCorners(cell); });
      for (int round = 0; round < kRounds; ++round)
      {
        this->forCells([&](std::int32_t cell) { next[cell] = this->decided(cell); });
        side_.swap(next);
      }
    }
    return side_;
  }

private:
  template <typename Work>
  void forCells(const Work& work)
  {
    parallelFor(votes_.size(), kGrain,
      [&](std::size_t begin, std::size_t end)
      {
        progress_.check();
        for (std::size_t cell = begin; cell < end; ++cell)
        {
          work(static_cast<std::int32_t>(cell));
        }
      });
  }

  void measure(std::int32_t cell)
  {
    const auto& v = tetrahedra_.cell(cell);
    const auto& p = tetrahedra_.points();
    const Vec3 a = p[v[1]] - p[v[0]];
    const Vec3 b = p[v[2]] - p[v[0]];
    const Vec3 c = p[v[3]] - p[v[0]];
    const Vec3 bc = b.cross(c);
    const Vec3 center =
      (a.squaredNorm() * bc + b.squaredNorm() * c.cross(a) + c.squaredNorm() * a.cross(b)) /
      (2.0 * a.dot(bc));
    centers_[cell] = p[v[0]] + center;
    radii_[cell] = center.norm();
  }

  // From a point to the middle of a cell's ball, of length 1.
  Vec3 way(std::int32_t point, std::int32_t cell) const
  {
    return (centers_[cell] - tetrahedra_.points()[point]) / radii_[cell];
  }

  void takeNormals()
  {
    parallelFor(normals_.size(), kGrain,
      [&](std::size_t begin, std::size_t end)
      {
        progress_.check();
        for (std::size_t point = begin; point < end; ++point)
        {
          normals_[point] = this->normal(static_cast<std::int32_t>(point));
        }
      });
  }

  // Outward, as long as it is trusted. Balls outside of the hull are the largest.
  Vec3 normal(std::int32_t point) const
  {
    Vec3 hull = Vec3::Zero();
    Vec3 best = Vec3::Zero();
    double largest = 0.0;
    for (const std::int32_t cell : tetrahedra_.star(point))
    {
      if (!tetrahedra_.finite(cell))
      {
        hull += double(side_[cell]) * centers_[cell];
        continue;
      }
      // Of slivers the balls are larger than what they see.
      const double size =
        std::min(sizes_.lengthOfCell(cell), 2.0 * radii_[cell]) / sizes_.spacing(point);
      if (size > largest && side_[cell] != 0.0f)
      {
        largest = size;
        best = double(side_[cell]) * this->way(point, cell);
      }
    }
    if (hull.norm() > 0.5)
    {
      return hull.normalized();
    }
    return largest >= kNear ? Vec3(std::min(1.0, largest / kFar) * best) : Vec3(Vec3::Zero());
  }

  float ofCorners(std::int32_t cell) const
  {
    double sum = 0.0;
    for (const std::int32_t point : tetrahedra_.cell(cell))
    {
      const double seen = std::min(1.0, radii_[cell] / sizes_.spacing(point));
      sum += seen * this->way(point, cell).dot(normals_[point]);
    }
    return static_cast<float>(sum);
  }

  float decided(std::int32_t cell) const
  {
    if (sizes_.ofCell(cell) > kLarge)
    {
      return side_[cell];
    }
    double sum = votes_[cell];
    for (int facet = 0; facet < 4; ++facet)
    {
      const std::int32_t other = tetrahedra_.neighbor(cell, facet);
      const std::int32_t corner = tetrahedra_.facet(cell, facet)[0];
      const Vec3 theirs = tetrahedra_.finite(other) ? this->way(corner, other) : centers_[other];
      sum += kNeighbor * double(side_[other]) * this->way(corner, cell).dot(theirs);
    }
    return sum > 0.0 ? 1.0f : sum < 0.0 ? -1.0f : side_[cell];
  }

  const Tetrahedralization& tetrahedra_;
  const FacetSize& sizes_;
  const Progress& progress_;
  std::vector<Vec3> centers_; // of balls; of infinite cells their direction
  std::vector<double> radii_;
  std::vector<Vec3> normals_; // per point
  Values votes_;              // of the corners, per finite cell
  Values side_;               // per cell
};

} // namespace

std::vector<Region> voteOnRegions(const Tetrahedralization& tetrahedra, const FacetSize& sizes,
  const std::vector<std::uint8_t>& inside, double wide, const Progress& progress)
{
  Votes votes(tetrahedra, sizes, inside, wide, progress);
  const Values& side = votes.run();
  std::vector<Region> regions(tetrahedra.cellCount());
  for (std::int32_t cell = 0; cell < tetrahedra.cellCount(); ++cell)
  {
    const bool small = tetrahedra.finite(cell) && sizes.ofCell(cell) <= wide;
    regions[cell] = small ? Region::Surface : side[cell] > 0.0f ? Region::Outside : Region::Inside;
  }
  return regions;
}

} // namespace hybridtree
