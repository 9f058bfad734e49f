// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/BorderSigns.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

using Place = PatchBricks::Place;

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

  std::vector<Index3> run()
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
    component_.push_back(place);
  }

  void walkFrom(const Place& start)
  {
    component_.clear();
    this->visit(start, PatchBrick::has(start.brick->inside, start.x, start.y, start.z));
    for (std::size_t k = 0; k < component_.size(); ++k)
    {
      const Place at = component_[k];
      for (unsigned axis = 0; axis < 3; ++axis)
      {
        this->step(at, axis, 1);
        this->step(at, axis, -1);
      }
    }
    std::size_t agree = 0;
    for (const Place& place : component_)
    {
      agree += PatchBrick::has(place.brick->inside, place.x, place.y, place.z) == this->told(place);
    }
    const bool turn = 2 * agree < component_.size();
    for (const Place& place : component_)
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
  std::vector<Place> component_;
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

std::vector<Index3> alignBorderSigns(PatchBricks& bricks, const BorderCrossings& crossings)
{
  return SignWalker(bricks, crossings).run();
}

} // namespace hybridtree
