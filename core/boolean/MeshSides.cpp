// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/MeshSides.h"

#include "core/base/Parallel.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

namespace hybridtree
{
namespace
{

// How many parts that crossings reach are asked again, by a ray, whether they are right.
constexpr int kVerified = 64;

class Components
{
public:
  explicit Components(std::size_t size) : parent_(size)
  {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  std::int32_t find(std::int32_t v)
  {
    while (parent_[std::size_t(v)] != v)
    {
      std::int32_t& parent = parent_[std::size_t(v)];
      parent = parent_[std::size_t(parent)];
      v = parent;
    }
    return v;
  }

  void join(std::int32_t a, std::int32_t b)
  {
    a = this->find(a);
    b = this->find(b);
    parent_[std::size_t(std::max(a, b))] = std::min(a, b);
  }

private:
  std::vector<std::int32_t> parent_;
};

// How often a mesh goes around a vertex of the other: signed crossings of a way out of its bounds.
class Winding
{
public:
  Winding(const MeshOperand& operand, bool second, const PerturbedPredicates& predicates)
    : operand_(operand), second_(second), predicates_(predicates)
  {
  }

  int at(const Site& site)
  {
    const BoxTree::Box& bounds = operand_.tree().bounds();
    int axis = 0;
    double out = 0.0;
    double shortest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k)
    {
      const double p = site.position[k];
      const double below = p - bounds.lower[std::size_t(k)];
      const double above = bounds.upper[std::size_t(k)] - p;
      if (below < 0.0 || above < 0.0)
      {
        return 0;
      }
      if (std::min(below, above) < shortest)
      {
        shortest = std::min(below, above);
        axis = k;
        const double step = above + below + std::abs(p) + std::numeric_limits<double>::min();
        out =
          below < above ? bounds.lower[std::size_t(k)] - step : bounds.upper[std::size_t(k)] + step;
      }
    }
    from_ = site;
    to_ = site;
    to_.position[axis] = out;
    to_.index = -1;
    way_ = BoxTree::Box::nothing();
    way_.extend(from_.position);
    way_.extend(to_.position);
    sum_ = 0;
    this->visit(operand_.tree().root());
    return sum_;
  }

private:
  void visit(const BoxTree::Node& node)
  {
    if (node.level > 0)
    {
      operand_.tree().forEachChild(
        node, way_, [this](const BoxTree::Node& child) { this->visit(child); });
      return;
    }
    for (const std::int32_t* t = operand_.tree().begin(node); t != operand_.tree().end(node); ++t)
    {
      sum_ += this->crossing(*t);
    }
  }

  // 1 where the way leaves through the triangle, -1 where it enters.
  int crossing(std::int32_t triangle) const
  {
    const Triangle& corner = operand_.mesh().triangles[std::size_t(triangle)];
    std::array<Site, 3> site;
    BoxTree::Box box = BoxTree::Box::nothing();
    for (std::size_t k = 0; k < 3; ++k)
    {
      site[k] = siteOf(operand_, corner[k], second_);
      box.extend(site[k].position);
    }
    if (!box.meets(way_))
    {
      return 0;
    }
    const int start = predicates_.side(site[0], site[1], site[2], from_);
    if (start == predicates_.side(site[0], site[1], site[2], to_))
    {
      return 0;
    }
    const int turn = predicates_.side(from_, to_, site[0], site[1]);
    if (turn != predicates_.side(from_, to_, site[1], site[2]) ||
      turn != predicates_.side(from_, to_, site[2], site[0]))
    {
      return 0;
    }
    return -start;
  }

  const MeshOperand& operand_;
  const bool second_;
  const PerturbedPredicates& predicates_;
  Site from_, to_;
  BoxTree::Box way_;
  int sum_ = 0;
};

// The vertices of one mesh.
class VertexSides
{
public:
  VertexSides(const MeshOperand& mine, const MeshOperand& other, int mesh,
    const PerturbedPredicates& predicates, const CutCurves& curves, MeshSides& sides)
    : mine_(mine)
    , winding_(other, mesh == 0, predicates)
    , mesh_(mesh)
    , curves_(curves)
    , cut_(sides.cut[std::size_t(mesh)])
    , outside_(sides.outside[std::size_t(mesh)])
    , components_(mine.mesh().points.size())
  {
  }

  /// Whether all agree.
  bool run()
  {
    this->markCuts();
    this->joinVertices();
    this->seed();
    this->spread();
    return agree_;
  }

private:
  void markCuts()
  {
    cut_.assign(mine_.mesh().triangles.size(), 0);
    for (const Segment& segment : curves_.segments)
    {
      cut_[std::size_t(segment.triangle[mesh_])] |= MeshSides::kCut;
      for (const SegmentEnd* end : { &segment.start, &segment.end })
      {
        if (end->mesh == mesh_)
        {
          cut_[std::size_t(end->own)] |= std::uint8_t(1 << end->corner);
        }
      }
    }
  }

  void joinVertices()
  {
    outside_.assign(mine_.mesh().points.size(), MeshSides::kUnused);
    for (std::size_t t = 0; t < cut_.size(); ++t)
    {
      const Triangle& corner = mine_.mesh().triangles[t];
      for (std::size_t k = 0; k < 3; ++k)
      {
        outside_[std::size_t(corner[k])] = 0;
        if ((cut_[t] & (1 << k)) == 0)
        {
          components_.join(corner[k], corner[(k + 1) % 3]);
        }
      }
    }
  }

  void seed()
  {
    side_.assign(mine_.mesh().points.size(), kUnknown);
    const auto isHere = [&](std::size_t k)
    { return k < curves_.crossings.size() && curves_.crossings[k].mesh == mesh_; };
    std::size_t k = 0;
    while (k < curves_.crossings.size() && !isHere(k))
    {
      ++k;
    }
    for (; isHere(k); ++k)
    {
      const Crossing& crossing = curves_.crossings[k];
      this->set(crossing.low, k, -1, crossing.lowOutside);
      this->set(crossing.high, k, 1, !crossing.lowOutside);
    }
  }

  // The side next to a crossing, toward an end of its edge, is that of the next crossing's near
  // side, or of the end itself.
  void set(std::int32_t vertex, std::size_t crossing, int toward, bool outside)
  {
    const Crossing& here = curves_.crossings[crossing];
    const std::size_t next = crossing + std::size_t(toward); // wraps around to no crossing
    if (next < curves_.crossings.size())
    {
      const Crossing& there = curves_.crossings[next];
      if (there.mesh == here.mesh && there.low == here.low && there.high == here.high &&
        there.row == here.row)
      {
        agree_ = agree_ && there.lowOutside != here.lowOutside;
        return;
      }
    }
    std::int8_t& side = side_[std::size_t(components_.find(vertex))];
    agree_ = agree_ && (side == kUnknown || side == std::int8_t(outside));
    side = std::int8_t(outside);
  }

  void spread()
  {
    int verified = 0;
    for (std::size_t v = 0; v < side_.size(); ++v)
    {
      if (outside_[v] == MeshSides::kUnused)
      {
        continue;
      }
      const std::int32_t root = components_.find(std::int32_t(v));
      std::int8_t& side = side_[std::size_t(root)];
      if (std::size_t(root) == v && (side == kUnknown || verified < kVerified))
      {
        const int winding = winding_.at(siteOf(mine_, root, mesh_ == 1));
        agree_ = agree_ && winding >= 0 &&
          (side == kUnknown || (winding <= 1 && side == std::int8_t(winding == 0)));
        verified += side != kUnknown;
        side = side == kUnknown ? std::int8_t(winding <= 0) : side;
      }
      outside_[v] = side;
    }
  }

  static constexpr std::int8_t kUnknown = -1;

  const MeshOperand& mine_;
  Winding winding_;
  const int mesh_;
  const CutCurves& curves_;
  std::vector<std::uint8_t>& cut_;
  std::vector<std::int8_t>& outside_;
  Components components_;
  std::vector<std::int8_t> side_; // per root: 1 outside, 0 inside
  bool agree_ = true;
};

} // namespace

MeshSides meshSides(const MeshOperand& a, const MeshOperand& b,
  const PerturbedPredicates& predicates, const CutCurves& curves)
{
  MeshSides sides;
  std::atomic<bool> agree{ true };
  parallelFor(2, 1,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t mesh = begin; mesh < end; ++mesh)
      {
        VertexSides mine(
          mesh == 0 ? a : b, mesh == 0 ? b : a, int(mesh), predicates, curves, sides);
        if (!mine.run())
        {
          agree = false;
        }
      }
    });
  sides.contradictory = !agree;
  return sides;
}

} // namespace hybridtree
