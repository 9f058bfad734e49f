// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/MeshSides.h"

#include "core/base/Parallel.h"
#include "core/geometry/PointTriangle.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace hybridtree
{
namespace
{

constexpr int kMost = 100; // of shells around a point

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

// Whether a mesh is no farther from a point than a distance.
class Nearness
{
public:
  Nearness(const MeshOperand& operand, double distance) : operand_(operand), distance_(distance) {}

  bool at(const Vec3& p) const
  {
    BoxTree::Box box = BoxTree::Box::nothing();
    box.extend(Vec3(p.array() - distance_));
    box.extend(Vec3(p.array() + distance_));
    return operand_.tree().bounds().meets(box) && this->visit(operand_.tree().root(), box, p);
  }

private:
  bool visit(const BoxTree::Node& node, const BoxTree::Box& box, const Vec3& p) const
  {
    const BoxTree& tree = operand_.tree();
    bool found = false;
    if (node.level > 0)
    {
      tree.forEachChild(node, box,
        [&](const BoxTree::Node& child) { found = found || this->visit(child, box, p); });
      return found;
    }
    return std::any_of(tree.begin(node), tree.end(node),
      [&](std::int32_t t)
      {
        const Triangle& c = operand_.mesh().triangles[std::size_t(t)];
        const auto corner = [&](std::size_t k)
        { return operand_.mesh().points[std::size_t(c[k])]; };
        return nearestOnTriangle(p, corner(0), corner(1), corner(2)).squaredDistance <=
          distance_ * distance_;
      });
  }

  const MeshOperand& operand_;
  const double distance_;
};

// The vertices of one mesh.
class VertexSides
{
public:
  VertexSides(const MeshOperand& mine, const MeshOperand& other, int mesh,
    const PerturbedPredicates& predicates, const CutCurves& curves, double tolerance,
    MeshSides& sides)
    : mine_(mine)
    , ray_(other, mesh == 0, predicates)
    , nearness_(other, tolerance)
    , mesh_(mesh)
    , curves_(curves)
    , cut_(sides.cut[std::size_t(mesh)])
    , winding_(sides.winding[std::size_t(mesh)])
    , components_(mine.mesh().points.size())
  {
  }

  /// Whether what is inside can be told.
  bool run()
  {
    this->markCuts();
    this->joinVertices();
    this->linkAcrossCrossings();
    this->spread();
    return told_ && this->isToldAlongEdges();
  }

private:
  // From one part without crossings to another, over an edge.
  struct Link
  {
    std::int32_t from, to;
    std::int32_t step; // of the winding number

    bool operator<(const Link& other) const
    {
      return std::tie(from, to, step) < std::tie(other.from, other.to, other.step);
    }
  };

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
    winding_.assign(mine_.mesh().points.size(), MeshSides::kUnused);
    for (std::size_t t = 0; t < cut_.size(); ++t)
    {
      const Triangle& corner = mine_.mesh().triangles[t];
      for (std::size_t k = 0; k < 3; ++k)
      {
        winding_[std::size_t(corner[k])] = 0;
        if ((cut_[t] & (1 << k)) == 0)
        {
          components_.join(corner[k], corner[(k + 1) % 3]);
        }
      }
    }
  }

  // Calls visit(first, last) for the crossings on each edge, and each row of them.
  template <class Visit>
  void forEachCrossedEdge(Visit&& visit) const
  {
    const std::vector<Crossing>& all = curves_.crossings;
    for (std::size_t first = 0, last = 0; first < all.size(); first = last)
    {
      const auto key = [&](std::size_t k)
      { return std::tie(all[k].mesh, all[k].low, all[k].high, all[k].row); };
      while (last < all.size() && key(last) == key(first))
      {
        ++last;
      }
      if (all[first].mesh == mesh_)
      {
        visit(first, last);
      }
    }
  }

  static int stepAt(const Crossing& crossing) { return crossing.lowOutside ? 1 : -1; }

  void linkAcrossCrossings()
  {
    this->forEachCrossedEdge(
      [this](std::size_t first, std::size_t last)
      {
        const Crossing& edge = curves_.crossings[first];
        const std::int32_t low = components_.find(edge.low);
        const std::int32_t high = components_.find(edge.high);
        int step = 0;
        for (std::size_t k = first; k < last; ++k)
        {
          step += stepAt(curves_.crossings[k]);
        }
        links_.push_back({ low, high, step });
        links_.push_back({ high, low, -step });
      });
    std::sort(links_.begin(), links_.end());
    links_.erase(std::unique(links_.begin(), links_.end(),
                   [](const Link& a, const Link& b) { return !(a < b) && !(b < a); }),
      links_.end());
  }

  // A ray for the first vertex of every part of the mesh.
  void spread()
  {
    known_.assign(winding_.size(), MeshSides::kUnused);
    for (std::size_t v = 0; v < winding_.size(); ++v)
    {
      if (winding_[v] == MeshSides::kUnused)
      {
        continue;
      }
      const std::int32_t root = components_.find(std::int32_t(v));
      if (known_[std::size_t(root)] == MeshSides::kUnused)
      {
        this->spreadFrom(root, ray_.at(siteOf(mine_, root, mesh_ == 1)));
      }
      winding_[v] = known_[std::size_t(root)];
    }
    for (std::size_t v = 0; v < winding_.size() && crossesItself_ && told_; ++v)
    {
      told_ = winding_[v] == MeshSides::kUnused || this->isTold(winding_[v]) ||
        nearness_.at(mine_.mesh().points[v]);
    }
  }

  static bool isTold(int winding) { return winding == 0 || winding == 1; }

  void spreadFrom(std::int32_t root, int winding)
  {
    const auto linksOf = [this](std::int32_t from) {
      return std::lower_bound(links_.begin(), links_.end(), Link{ from, -1, 0 });
    };
    const auto first = linksOf(root);
    if (first == links_.end() || first->from != root)
    {
      winding = std::min(winding, 1); // inside of several shells, no matter of which
    }
    std::vector<std::int32_t> front = { root };
    this->set(root, winding);
    while (!front.empty())
    {
      const std::int32_t from = front.back();
      front.pop_back();
      for (auto link = linksOf(from); link != links_.end() && link->from == from; ++link)
      {
        const int next = known_[std::size_t(from)] + link->step;
        if (known_[std::size_t(link->to)] == MeshSides::kUnused)
        {
          this->set(link->to, next);
          front.push_back(link->to);
        }
        told_ = told_ && known_[std::size_t(link->to)] == next;
      }
    }
  }

  void set(std::int32_t root, int winding)
  {
    told_ = told_ && std::abs(winding) <= kMost;
    crossesItself_ = crossesItself_ || !this->isTold(winding);
    known_[std::size_t(root)] = std::int8_t(std::clamp(winding, -kMost, kMost));
  }

  // Between crossings too the other mesh may cross itself by rounding only.
  bool isToldAlongEdges() const
  {
    bool told = true;
    this->forEachCrossedEdge(
      [&](std::size_t first, std::size_t last)
      {
        int winding = winding_[std::size_t(curves_.crossings[first].low)];
        for (std::size_t k = first; k + 1 < last && told; ++k)
        {
          winding += stepAt(curves_.crossings[k]);
          told = this->isTold(winding) ||
            nearness_.at(0.5 * (curves_.crossings[k].position + curves_.crossings[k + 1].position));
        }
      });
    return told;
  }

  const MeshOperand& mine_;
  Winding ray_;
  const Nearness nearness_;
  const int mesh_;
  const CutCurves& curves_;
  std::vector<std::uint8_t>& cut_;
  std::vector<std::int8_t>& winding_;
  Components components_;
  std::vector<Link> links_;
  std::vector<std::int8_t> known_; // per root; kUnused for not yet
  bool crossesItself_ = false;     // the other mesh, around a vertex
  bool told_ = true;
};

} // namespace

MeshSides meshSides(const MeshOperand& a, const MeshOperand& b,
  const PerturbedPredicates& predicates, const CutCurves& curves, double tolerance)
{
  MeshSides sides;
  std::atomic<bool> told{ true };
  parallelFor(2, 1,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t mesh = begin; mesh < end; ++mesh)
      {
        VertexSides mine(
          mesh == 0 ? a : b, mesh == 0 ? b : a, int(mesh), predicates, curves, tolerance, sides);
        if (!mine.run())
        {
          told = false;
        }
      }
    });
  sides.contradictory = !told;
  return sides;
}

} // namespace hybridtree
