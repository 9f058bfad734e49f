// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/BorderSigns.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

using Place = PatchBricks::Place;

// Samples that decide between the two possibilities of a part of the border. All but those beside
// the line agree, if the line is that of the field at all.
constexpr std::size_t kVotes = 64;

/// Walks along the edges of the border from corner to corner.
class SignWalker
{
public:
  SignWalker(PatchBricks& bricks, const BorderCrossings& crossings)
    : bricks_(bricks)
    , seen_(bricks.all().size())
    , told_(bricks.all().size())
    , odd_(bricks.all().size())
  {
    crossings.forEach(
      [&](const LatticeEdge& edge, const std::vector<std::int32_t>& vertices)
      {
        const Place low = bricks_.locate(edge.low);
        if (low.brick && vertices.size() % 2 == 1)
        {
          odd_[this->number(low)][edge.axis][low.z] |= bit(low);
        }
      });
  }

  std::vector<Index3> run(const Progress& progress)
  {
    for (std::size_t b = 0; b < bricks_.all().size(); ++b)
    {
      for (int n = 0; n < kBrickPoints; ++n)
      {
        const int z = n / (kBrickSide * kBrickSide);
        const std::uint64_t bit = std::uint64_t(1) << (n % (kBrickSide * kBrickSide));
        if ((bricks_.all()[b].border[z] & bit) != 0 && (seen_[b][z] & bit) == 0)
        {
          this->walkFrom({ &bricks_.all()[b], n % kBrickSide, n / kBrickSide % kBrickSide, z });
        }
      }
    }
    this->askVoters(progress);
    for (const std::vector<Place>& component : components_)
    {
      this->decide(component);
    }
    return std::move(contradictions_);
  }

private:
  std::size_t number(const Place& place) const
  {
    return static_cast<std::size_t>(place.brick - bricks_.all().data());
  }
  static std::uint64_t bit(const Place& place)
  {
    return std::uint64_t(1) << (kBrickSide * place.y + place.x);
  }
  static Index3 indexOf(const Place& place)
  {
    const Index3& brick = place.brick->index;
    return { kBrickSide * brick[0] + place.x, kBrickSide * brick[1] + place.y,
      kBrickSide * brick[2] + place.z };
  }
  bool told(const Place& place) const
  {
    return (told_[this->number(place)][place.z] & bit(place)) != 0;
  }

  void visit(const Place& place, bool side)
  {
    seen_[this->number(place)][place.z] |= bit(place);
    told_[this->number(place)][place.z] |= side ? bit(place) : 0;
    components_.back().push_back(place);
  }

  /// Tells the sides as they are if the start is outside.
  void walkFrom(const Place& start)
  {
    components_.emplace_back();
    this->visit(start, false);
    for (std::size_t k = 0; k < components_.back().size(); ++k)
    {
      const Place at = components_.back()[k];
      for (unsigned axis = 0; axis < 3; ++axis)
      {
        this->step(at, axis, 1);
        this->step(at, axis, -1);
      }
    }
  }

  /// Places of a component that are asked, from the start on evenly spread.
  template <class Visit>
  static void forEachVoter(const std::vector<Place>& component, Visit&& visit)
  {
    const std::size_t votes = std::min(component.size(), kVotes);
    for (std::size_t k = 0; k < votes; ++k)
    {
      visit(component[k * component.size() / votes]);
    }
  }

  void askVoters(const Progress& progress)
  {
    std::vector<BrickBits> voters(bricks_.all().size());
    for (const std::vector<Place>& component : components_)
    {
      SignWalker::forEachVoter(
        component, [&](const Place& place) { voters[this->number(place)][place.z] |= bit(place); });
    }
    bricks_.ask(voters, true, progress);
  }

  /// By most of the votes; if they are equal, by that of the start.
  void decide(const std::vector<Place>& component)
  {
    const auto agrees = [&](const Place& place) {
      return PatchBrick::has(place.brick->inside, place.x, place.y, place.z) == this->told(place);
    };
    std::size_t agree = 0;
    std::size_t votes = 0;
    SignWalker::forEachVoter(component,
      [&](const Place& place)
      {
        agree += agrees(place);
        ++votes;
      });
    const bool turn = 2 * agree < votes || (2 * agree == votes && !agrees(component.front()));
    for (const Place& place : component)
    {
      std::uint64_t& word = place.brick->inside[place.z];
      word = this->told(place) != turn ? word | bit(place) : word & ~bit(place);
    }
  }

  void step(const Place& at, unsigned axis, int direction)
  {
    const auto next = bricks_.locate(*at.brick, at.x + (axis == 0 ? direction : 0),
      at.y + (axis == 1 ? direction : 0), at.z + (axis == 2 ? direction : 0));
    if (!next.brick)
    {
      return;
    }
    const Place& low = direction > 0 ? at : next;
    const PatchBrick& owner = *low.brick;
    if (!PatchBrick::has(owner.edges[axis], low.x, low.y, low.z) ||
      PatchBrick::has(owner.inner[axis], low.x, low.y, low.z))
    {
      return;
    }
    const bool isOdd = PatchBrick::has(odd_[this->number(low)][axis], low.x, low.y, low.z);
    const bool side = this->told(at) != isOdd;
    if ((seen_[this->number(next)][next.z] & bit(next)) == 0)
    {
      this->visit(next, side);
    }
    else if (this->told(next) != side)
    {
      contradictions_.push_back(indexOf(low));
    }
  }

  PatchBricks& bricks_;
  std::vector<BrickBits> seen_;
  std::vector<BrickBits> told_;
  std::vector<std::array<BrickBits, 3>> odd_; ///< [axis]: edges with an odd number of crossings
  std::vector<std::vector<Place>> components_;
  std::vector<Index3> contradictions_;
};

} // namespace

BorderCrossings::BorderCrossings(const std::vector<BorderCrossing>& crossings)
{
  std::vector<BorderCrossing> sorted = crossings;
  std::sort(sorted.begin(), sorted.end(),
    [](const BorderCrossing& a, const BorderCrossing& b)
    { return a.at < b.at || (a.at == b.at && a.vertex < b.vertex); });
  for (const BorderCrossing& crossing : sorted)
  {
    vertices_[{ crossing.low, crossing.axis }].push_back(crossing.vertex);
  }
}

const std::vector<std::int32_t>* BorderCrossings::find(const LatticeEdge& edge) const
{
  const auto found = vertices_.find(edge);
  return found == vertices_.end() ? nullptr : &found->second;
}

std::vector<Index3> alignBorderSigns(
  PatchBricks& bricks, const BorderCrossings& crossings, const Progress& progress)
{
  return SignWalker(bricks, crossings).run(progress);
}

} // namespace hybridtree
