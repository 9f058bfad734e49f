// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/SheetSides.h"

#include "reconstruction/EmptyBalls.h"
#include "reconstruction/JoinedParts.h"
#include "reconstruction/ParallelSort.h"
#include "reconstruction/SignedHarmonic.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace hybridtree
{
namespace
{

constexpr std::size_t kGrain = 2048;
// How many steps between two looks at whether to go on.
constexpr std::size_t kBreath = 65536;
// Cosine between the ways to both poles, one of them turned round, at least.
constexpr double kOpposite = 0.3;
// Poles that see fewer spacings than this count for less.
constexpr double kFar = 3.0;
// Weight of what the surest links say of a cell, against those to its neighbours.
constexpr float kPull = 0.01f;

// The poles of points, by which links are opposite: of all pairs of cells at a point that with the
// largest balls, which the hull's half-spaces are, too.
class SheetPoles
{
public:
  SheetPoles(const Tetrahedralization& tetrahedra, const FacetSize& sizes, const EmptyBalls& balls)
    : tetrahedra_(tetrahedra), sizes_(sizes), balls_(balls)
  {
    Box3 box;
    for (const Vec3& point : tetrahedra.points())
    {
      box.extend(point);
    }
    extent_ = box.diagonal().norm();
  }

  std::vector<SignedLink> opposite(const Progress& progress) const
  {
    return this->collect(progress,
      [this](std::int32_t point, Candidates& candidates, std::vector<SignedLink>& links)
      { this->addPair(point, candidates, links); });
  }

  /// Links of the poles along known normals to a node that stands for the outside.
  std::vector<SignedLink> alongNormals(
    const std::vector<Vec3>& normals, std::int32_t outside, const Progress& progress) const
  {
    return this->collect(progress,
      [&](std::int32_t point, Candidates& candidates, std::vector<SignedLink>& links)
      {
        const Vec3 normal = normals[point].stableNormalized();
        if (normal != Vec3::Zero())
        {
          this->fill(point, candidates);
          this->addAlong(point, normal, 1.0f, outside, candidates, links);
          this->addAlong(point, -normal, -1.0f, outside, candidates, links);
        }
      });
  }

private:
  struct Candidate
  {
    double size; // world units
    std::int32_t cell;
    Vec3 way;
    bool operator<(const Candidate& other) const
    {
      return size != other.size ? size > other.size : cell < other.cell;
    }
  };
  using Candidates = std::vector<Candidate>;

  template <typename Add>
  std::vector<SignedLink> collect(const Progress& progress, const Add& add) const
  {
    return collectInParts<SignedLink>(tetrahedra_.points().size(), kGrain, progress,
      [&](std::size_t begin, std::size_t end, std::vector<SignedLink>& links)
      {
        Candidates candidates;
        for (std::size_t point = begin; point < end; ++point)
        {
          add(static_cast<std::int32_t>(point), candidates, links);
        }
      });
  }

  // The largest at a point, largest first.
  void fill(std::int32_t point, Candidates& candidates) const
  {
    constexpr std::size_t kMost = 64; // pairs are tried: not quadratic where many cells meet
    candidates.clear();
    for (const std::int32_t cell : tetrahedra_.star(point))
    {
      // Of slivers the balls are larger than what they see.
      const double size = balls_.isHalfSpace(cell)
        ? extent_
        : std::min(balls_.diameter(cell), double(sizes_.lengthOfCell(cell)));
      candidates.push_back({ size, cell, balls_.way(point, cell) });
    }
    const std::size_t most = std::min(kMost, candidates.size());
    std::partial_sort(
      candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(most), candidates.end());
    candidates.resize(most);
  }

  float weight(std::int32_t point, double cosine, double size) const
  {
    const double seen = size / (kFar * sizes_.spacing(point));
    return EmptyBalls::weight(cosine) * static_cast<float>(std::min(1.0, seen));
  }

  void addPair(std::int32_t point, Candidates& candidates, std::vector<SignedLink>& links) const
  {
    this->fill(point, candidates);
    SignedLink pair{ -1, -1, 0.0f };
    double most = 0.0;
    for (std::size_t b = 1; b < candidates.size() && candidates[b].size > most; ++b)
    {
      const double size = candidates[b].size; // of the two the smaller
      for (std::size_t a = 0; a < b; ++a)
      {
        const double against = -candidates[a].way.dot(candidates[b].way);
        if (against >= kOpposite && size * against > most)
        {
          most = size * against;
          pair = { candidates[a].cell, candidates[b].cell, -this->weight(point, against, size) };
        }
      }
    }
    if (most > 0.0)
    {
      links.push_back(pair);
    }
  }

  void addAlong(std::int32_t point, const Vec3& way, float sign, std::int32_t outside,
    const Candidates& candidates, std::vector<SignedLink>& links) const
  {
    const Candidate* best = nullptr;
    double most = 0.0;
    for (const Candidate& candidate : candidates)
    {
      const double along = candidate.way.dot(way);
      if (along >= kOpposite && along * candidate.size > most)
      {
        most = along * candidate.size;
        best = &candidate;
      }
    }
    if (best)
    {
      links.push_back(
        { best->cell, outside, sign * this->weight(point, best->way.dot(way), best->size) });
    }
  }

  const Tetrahedralization& tetrahedra_;
  const FacetSize& sizes_;
  const EmptyBalls& balls_;
  double extent_ = 0.0;
};

// Disjoint sets whose members know whether they are turned against their set's first.
class TurnedSets
{
public:
  explicit TurnedSets(std::size_t size) : parent_(size), turned_(size, 0)
  {
    std::iota(parent_.begin(), parent_.end(), std::int32_t(0));
  }

  bool isTurned(std::int32_t member) { return this->rootOf(member).second; }

  // Joins the sets of a and b such that the two are turned against each other, or alike.
  void join(std::int32_t a, std::int32_t b, bool against)
  {
    const auto [rootA, turnedA] = this->rootOf(a);
    const auto [rootB, turnedB] = this->rootOf(b);
    if (rootA != rootB)
    {
      parent_[std::max(rootA, rootB)] = std::min(rootA, rootB);
      turned_[std::max(rootA, rootB)] = turnedA != turnedB ? !against : against;
    }
  }

private:
  std::pair<std::int32_t, bool> rootOf(std::int32_t member)
  {
    bool turned = false;
    while (parent_[member] != member)
    {
      const std::int32_t parent = parent_[member];
      turned_[member] = turned_[member] != turned_[parent]; // of the grandparent
      parent_[member] = parent_[parent];
      turned = turned != bool(turned_[member]);
      member = parent_[member];
    }
    return { member, turned };
  }

  std::vector<std::int32_t> parent_;
  std::vector<std::uint8_t> turned_; // against the parent
};

struct Rank
{
  float weight;
  std::int32_t link;
  bool operator<(const Rank& other) const
  {
    return weight != other.weight ? weight > other.weight : link < other.link;
  }
};

// Per cell 0 or 1, by the surest links. Of opposite ones the root counts: in noise poles are less
// opposite than balls are alike that roll around the rim.
std::vector<std::uint8_t> sidesBySurest(
  const std::vector<SignedLink>& links, std::size_t cells, const Progress& progress)
{
  std::vector<Rank> ranks(links.size());
  for (std::size_t k = 0; k < links.size(); ++k)
  {
    const float weight = links[k].weight;
    ranks[k] = { weight < 0.0f ? std::sqrt(-weight) : weight, static_cast<std::int32_t>(k) };
  }
  parallelSort(ranks, progress);
  TurnedSets sets(cells);
  for (std::size_t k = 0; k < ranks.size(); ++k)
  {
    if (k % kBreath == 0)
    {
      progress.check();
    }
    const SignedLink& link = links[ranks[k].link];
    sets.join(link.a, link.b, link.weight < 0.0f);
  }
  std::vector<std::uint8_t> turned(cells);
  for (std::size_t cell = 0; cell < cells; ++cell)
  {
    turned[cell] = sets.isTurned(static_cast<std::int32_t>(cell)) ? 1 : 0;
  }
  return turned;
}

// Whether cells marked 1 have more of the hull.
bool haveHull(const Tetrahedralization& tetrahedra, const std::vector<std::uint8_t>& inside)
{
  const auto infinite = inside.begin() + tetrahedra.finiteCellCount();
  return 2 * std::count(infinite, inside.end(), 1) > inside.end() - infinite;
}

void turn(std::vector<std::uint8_t>& inside)
{
  std::transform(inside.begin(), inside.end(), inside.begin(),
    [](std::uint8_t side) { return static_cast<std::uint8_t>(side ^ 1); });
}

// Whether most of what normals say of cells is against their sides.
bool contradicts(const std::vector<SignedLink>& told, const std::vector<std::uint8_t>& inside)
{
  double agreement = 0.0;
  for (const SignedLink& link : told)
  {
    agreement += inside[link.a] ? -double(link.weight) : double(link.weight);
  }
  return agreement < 0.0;
}

} // namespace

std::vector<std::uint8_t> findSheetByBalls(const Tetrahedralization& tetrahedra,
  const FacetSize& sizes, const std::vector<Vec3>* normals, const Progress& progress)
{
  const auto cells = static_cast<std::size_t>(tetrahedra.cellCount());
  const std::int32_t outside = tetrahedra.cellCount();
  std::vector<SignedLink> links;
  std::vector<SignedLink> told;
  {
    const EmptyBalls balls(tetrahedra, progress);
    links = linksOfNeighbors(tetrahedra, balls, progress);
    const SheetPoles poles(tetrahedra, sizes, balls);
    const std::vector<SignedLink> opposite = poles.opposite(progress);
    links.insert(links.end(), opposite.begin(), opposite.end());
    if (normals)
    {
      told = poles.alongNormals(*normals, outside, progress);
    }
  }
  std::vector<std::uint8_t> inside = sidesBySurest(links, cells, progress);
  if (contradicts(told, inside))
  {
    turn(inside);
  }
  links.insert(links.end(), told.begin(), told.end());
  for (std::int32_t cell = 0; cell < tetrahedra.cellCount(); ++cell)
  {
    links.push_back({ cell, outside, inside[cell] ? -kPull : kPull });
  }
  std::vector<float> held(cells + 1, 0.0f);
  held[cells] = 1.0f;
  const std::vector<double> value = signedHarmonic(held, std::move(links), progress);
  std::transform(value.begin(), value.end() - 1, inside.begin(),
    [](double side) { return static_cast<std::uint8_t>(side < 0.0 ? 1 : 0); });
  if (told.empty() && haveHull(tetrahedra, inside))
  {
    turn(inside);
  }
  return inside;
}

} // namespace hybridtree
