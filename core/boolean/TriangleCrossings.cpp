// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/TriangleCrossings.h"

#include "core/base/Error.h"
#include "core/base/Parallel.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hybridtree
{
namespace
{

constexpr std::size_t kPairs = 1024;
constexpr std::size_t kPairsPerTask = 16;
constexpr double kDoubt = 6.0 * 40.0 * 0x1p-53; // six products, as the filter of the predicates

struct NodePair
{
  BoxTree::Node a;
  BoxTree::Node b;

  bool isLeaf() const { return a.level == 0 && b.level == 0; }
};

// Opens the node of the higher level.
template <class Visit>
void forEachBelow(const BoxTree& treeA, const BoxTree& treeB, const NodePair& pair, Visit&& visit)
{
  if (pair.a.level >= pair.b.level)
  {
    treeA.forEachChild(pair.a, pair.b.box,
      [&](const BoxTree::Node& child) {
        visit(NodePair{ child, pair.b });
      });
  }
  else
  {
    treeB.forEachChild(pair.b, pair.a.box,
      [&](const BoxTree::Node& child) {
        visit(NodePair{ pair.a, child });
      });
  }
}

// Two triangles, and what is known of how they lie to each other.
class TrianglePair
{
public:
  TrianglePair(const MeshOperand& a, const MeshOperand& b, const PerturbedPredicates& predicates)
    : operand_{ &a, &b }, predicates_(predicates)
  {
  }

  /// Whether they cross; if so the segment is filled in.
  bool cross(std::int32_t triangleA, std::int32_t triangleB, Segment& segment)
  {
    triangle_ = { triangleA, triangleB };
    for (std::size_t mesh = 0; mesh < 2; ++mesh)
    {
      const MeshOperand& operand = *operand_[mesh];
      corner_[mesh] = operand.mesh().triangles[std::size_t(triangle_[mesh])];
      for (std::size_t k = 0; k < 3; ++k)
      {
        site_[mesh][k] = siteOf(operand, corner_[mesh][k], mesh == 1);
      }
    }
    if (!this->straddles(0) || !this->straddles(1))
    {
      return false;
    }
    this->compareEdges();
    return this->collect(segment);
  }

private:
  // Whether a triangle has corners on both sides of the other's plane.
  bool straddles(std::size_t mesh)
  {
    const std::array<Site, 3>& plane = site_[1 - mesh];
    for (std::size_t k = 0; k < 3; ++k)
    {
      side_[mesh][k] = predicates_.side(plane[0], plane[1], plane[2], site_[mesh][k]);
    }
    return side_[mesh][0] != side_[mesh][1] || side_[mesh][1] != side_[mesh][2];
  }

  bool isSplit(std::size_t mesh, std::size_t edge) const
  {
    return side_[mesh][edge] != side_[mesh][(edge + 1) % 3];
  }

  // How the edges of one turn around those of the other, where it matters.
  void compareEdges()
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      for (std::size_t j = 0; j < 3; ++j)
      {
        turn_[i][j] = this->isSplit(0, i) || this->isSplit(1, j)
          ? predicates_.side(site_[0][i], site_[0][(i + 1) % 3], site_[1][j], site_[1][(j + 1) % 3])
          : 0;
      }
    }
  }

  bool meets(std::size_t mesh, std::size_t edge) const
  {
    if (!this->isSplit(mesh, edge))
    {
      return false;
    }
    const auto turn = [&](std::size_t k) { return mesh == 0 ? turn_[edge][k] : turn_[k][edge]; };
    return turn(0) == turn(1) && turn(1) == turn(2);
  }

  bool collect(Segment& segment) const
  {
    int starts = 0;
    int ends = 0;
    for (std::size_t mesh = 0; mesh < 2; ++mesh)
    {
      for (std::size_t edge = 0; edge < 3; ++edge)
      {
        if (!this->meets(mesh, edge))
        {
          continue;
        }
        // Into A's triangle goes what comes over an edge that runs inward through B; into B's, one
        // that runs outward through A.
        const bool outside = side_[mesh][edge] > 0;
        const bool isStart = outside == (mesh == 0);
        (isStart ? segment.start : segment.end) = this->makeEnd(mesh, edge, outside);
        ++(isStart ? starts : ends);
      }
    }
    if (starts == 0 && ends == 0)
    {
      return false;
    }
    if (starts != 1 || ends != 1)
    {
      throw InvalidGeometry("Triangle " + std::to_string(triangle_[0]) +
        " of the first mesh and triangle " + std::to_string(triangle_[1]) +
        " of the second lie so that their crossing cannot be told. Move one mesh a little.");
    }
    segment.triangle[0] = triangle_[0];
    segment.triangle[1] = triangle_[1];
    return true;
  }

  SegmentEnd makeEnd(std::size_t mesh, std::size_t edge, bool outside) const
  {
    const std::int32_t from = corner_[mesh][edge];
    const std::int32_t to = corner_[mesh][(edge + 1) % 3];
    return { std::min(from, to), std::max(from, to), triangle_[mesh], triangle_[1 - mesh],
      std::int8_t(mesh), std::int8_t(edge), from < to, outside == (from < to) };
  }

  std::array<const MeshOperand*, 2> operand_;
  const PerturbedPredicates& predicates_;
  std::array<std::int32_t, 2> triangle_{};
  std::array<Triangle, 2> corner_{};
  std::array<std::array<Site, 3>, 2> site_;
  std::array<std::array<int, 3>, 2> side_{};
  std::array<std::array<int, 3>, 3> turn_{};
};

// A triangle in a group that is compared with another group: what can be known of it beforehand.
struct Candidate
{
  std::int32_t triangle;
  BoxTree::Box box;
  std::array<Vec3, 3> corner;
  Vec3 normal;
  double size;  ///< of the products that make a distance from the plane, per length
  double reach; ///< how far from the plane rounding goes, times the length of the normal

  // Whether a triangle lies on one side of the plane of this one beyond doubt, and not on the plane
  // but for rounding.
  bool isBeside(const Candidate& other) const
  {
    int above = 0;
    int below = 0;
    std::array<double, 3> distance;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const Vec3 d = other.corner[k] - corner[0];
      distance[k] = normal.dot(d);
      const double doubt = size * d.cwiseAbs().maxCoeff();
      above += distance[k] > doubt;
      below += distance[k] < -doubt;
    }
    return (above == 3 || below == 3) &&
      (std::abs(distance[0]) > reach || std::abs(distance[1]) > reach ||
        std::abs(distance[2]) > reach);
  }

  // Whether it lies on the plane but for rounding.
  bool hasOn(const Candidate& other) const
  {
    return std::all_of(other.corner.begin(), other.corner.end(),
      [this](const Vec3& p) { return std::abs(normal.dot(p - corner[0])) <= reach; });
  }
};

// The triangles of a node, made ready once for the many nodes that it is compared with in a row.
class CandidateCache
{
public:
  struct Group
  {
    std::uint32_t node = 0xffffffffu;
    std::size_t count = 0;
    std::array<Candidate, BoxTree::kWidth> candidates;
  };

  CandidateCache(const MeshOperand& operand, double rounding)
    : operand_(operand), rounding_(rounding), groups_(kGroups)
  {
  }

  const Group& get(const BoxTree::Node& node)
  {
    Group& group = groups_[node.index % kGroups];
    if (group.node != node.index)
    {
      group.node = node.index;
      group.count = 0;
      const BoxTree& tree = operand_.tree();
      for (const std::int32_t* t = tree.begin(node); t != tree.end(node); ++t)
      {
        this->prepare(*t, group.candidates[group.count++]);
      }
    }
    return group;
  }

private:
  static constexpr std::size_t kGroups = 64;

  void prepare(std::int32_t triangle, Candidate& candidate) const
  {
    candidate.triangle = triangle;
    candidate.box = BoxTree::Box::nothing();
    for (std::size_t k = 0; k < 3; ++k)
    {
      const std::int32_t vertex = operand_.mesh().triangles[std::size_t(triangle)][k];
      candidate.corner[k] = operand_.mesh().points[std::size_t(vertex)];
      candidate.box.extend(candidate.corner[k]);
    }
    const Vec3 u = candidate.corner[1] - candidate.corner[0];
    const Vec3 v = candidate.corner[2] - candidate.corner[0];
    candidate.normal = u.cross(v);
    candidate.size = kDoubt * u.cwiseAbs().maxCoeff() * v.cwiseAbs().maxCoeff();
    candidate.reach = rounding_ * candidate.normal.norm();
    candidate.box.grow(rounding_);
  }

  const MeshOperand& operand_;
  const double rounding_;
  std::vector<Group> groups_;
};

class Walk
{
public:
  Walk(const MeshOperand& a, const MeshOperand& b, const PerturbedPredicates& predicates,
    TriangleCrossings& found)
    : a_(a)
    , b_(b)
    , first_(a, std::max(a.rounding(), b.rounding()))
    , second_(b, std::max(a.rounding(), b.rounding()))
    , pair_(a, b, predicates)
    , found_(found)
  {
  }

  void visit(const NodePair& pair)
  {
    if (pair.isLeaf())
    {
      this->visitTriangles(pair);
      return;
    }
    forEachBelow(a_.tree(), b_.tree(), pair, [this](const NodePair& child) { this->visit(child); });
  }

private:
  void visitTriangles(const NodePair& pair)
  {
    const CandidateCache::Group& first = first_.get(pair.a);
    const CandidateCache::Group& second = second_.get(pair.b);
    std::array<const Candidate*, BoxTree::kWidth> near;
    std::size_t count = 0;
    for (std::size_t j = 0; j < second.count; ++j)
    {
      near[count] = &second.candidates[j];
      count += near[count]->box.meets(pair.a.box);
    }
    Segment segment;
    for (std::size_t i = 0; i < first.count && count > 0; ++i)
    {
      const Candidate& mine = first.candidates[i];
      if (!mine.box.meets(pair.b.box))
      {
        continue;
      }
      for (std::size_t j = 0; j < count; ++j)
      {
        const Candidate& other = *near[j];
        if (!mine.box.meets(other.box) || mine.isBeside(other) || other.isBeside(mine))
        {
          continue;
        }
        if (mine.hasOn(other) && other.hasOn(mine))
        {
          found_.touching[0].push_back(mine.triangle);
          found_.touching[1].push_back(other.triangle);
        }
        if (pair_.cross(mine.triangle, other.triangle, segment))
        {
          found_.segments.push_back(segment);
        }
      }
    }
  }

  const MeshOperand& a_;
  const MeshOperand& b_;
  CandidateCache first_;
  CandidateCache second_;
  TrianglePair pair_;
  TriangleCrossings& found_;
};

// Enough pairs of nodes to share out, by levels.
std::vector<NodePair> firstPairs(const BoxTree& a, const BoxTree& b)
{
  std::vector<NodePair> pairs;
  if (a.bounds().meets(b.bounds()))
  {
    pairs.push_back({ a.root(), b.root() });
  }
  for (bool opened = true; opened && pairs.size() < kPairs;)
  {
    opened = false;
    std::vector<NodePair> below;
    for (const NodePair& pair : pairs)
    {
      if (pair.isLeaf())
      {
        below.push_back(pair);
        continue;
      }
      opened = true;
      forEachBelow(a, b, pair, [&](const NodePair& child) { below.push_back(child); });
    }
    pairs.swap(below);
  }
  return pairs;
}

} // namespace

Site siteOf(const MeshOperand& operand, std::int32_t vertex, bool second)
{
  return { operand.mesh().points[std::size_t(vertex)], vertex, second };
}

TriangleCrossings triangleCrossings(const MeshOperand& a, const MeshOperand& b,
  const PerturbedPredicates& predicates, const Progress& progress)
{
  const std::vector<NodePair> pairs = firstPairs(a.tree(), b.tree());
  std::vector<TriangleCrossings> found((pairs.size() + kPairsPerTask - 1) / kPairsPerTask);
  parallelFor(pairs.size(), kPairsPerTask,
    [&](std::size_t begin, std::size_t end)
    {
      progress.check();
      Walk walk(a, b, predicates, found[begin / kPairsPerTask]);
      for (std::size_t k = begin; k < end; ++k)
      {
        walk.visit(pairs[k]);
      }
    });
  std::size_t count = 0;
  for (const TriangleCrossings& part : found)
  {
    count += part.segments.size();
  }
  TriangleCrossings all;
  all.segments.reserve(count);
  for (const TriangleCrossings& part : found)
  {
    all.segments.insert(all.segments.end(), part.segments.begin(), part.segments.end());
    for (std::size_t mesh = 0; mesh < 2; ++mesh)
    {
      all.touching[mesh].insert(
        all.touching[mesh].end(), part.touching[mesh].begin(), part.touching[mesh].end());
    }
  }
  return all;
}

} // namespace hybridtree
