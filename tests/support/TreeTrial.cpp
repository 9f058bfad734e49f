// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/TreeTrial.h"

#include "core/base/Error.h"
#include "core/mesh/MeshChecks.h"
#include "tests/support/RandomTree.h"
#include "tests/support/TreeChecks.h"

#include <algorithm>
#include <cstdio>

namespace hybridtree::test
{

const std::array<const char*, kFaults> kFaultNames = { "failed", "open or non-manifold",
  "off in volume", "wrong side", "off the surface", "disagreeing", "wrong side of thin parts",
  "disagreeing at thin parts" };

namespace
{

constexpr std::array<BlendMethod, 4> kMethods = { BlendMethod::Automatic, BlendMethod::NodeBased,
  BlendMethod::PrimitiveBased, BlendMethod::Global };
constexpr std::array<const char*, 4> kNames = { "automatic", "node-based", "primitive-based",
  "global" };
constexpr std::array<double, 3> kThresholds = { 0.0, 0.5, 1.0 };
constexpr int kHalvings = 3;

// In edge lengths.
constexpr double kOnSurface = 1e-3;
constexpr double kFar = 0.5;
constexpr double kNear = 0.5; // one of the points that are so near to each other stands for all

std::string number(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string place(const Vec3& p)
{
  return "(" + number(p.x()) + " " + number(p.y()) + " " + number(p.z()) + ")";
}

struct Made
{
  std::string name;
  NodePtr tree;
  MeshPtr mesh;
};

class Judge
{
public:
  Judge(double edge, std::size_t points, std::uint64_t seed)
    : edge_(edge), points_(points), seed_(seed)
  {
  }

  void look(const Made& made)
  {
    verdict_.warned += made.tree->warnings().empty() ? 0 : 1;
    ++verdict_.meshes;
    const MeshReport report = checkMesh(*made.mesh);
    if (!report.closedManifold())
    {
      verdict_.add(Fault::Open, made.name + ": " + report.describe());
      return;
    }
    this->lookAtSolid(made);
    const std::size_t off = verticesOffSurface(*made.tree, *made.mesh, edge_, kOnSurface * edge_);
    if (off > 0)
    {
      verdict_.add(Fault::OffSurface,
        made.name + ": " + std::to_string(off) + " of " + std::to_string(made.mesh->points.size()) +
          " vertices of a " + made.tree->kind());
    }
  }

  void compare(const Made& a, const Made& b)
  {
    const Apart apart = hausdorff(a.mesh, b.mesh);
    if (apart.distance() > kFar * edge_)
    {
      const bool thin = this->isAllThin(*a.tree, apart.ofA) && this->isAllThin(*a.tree, apart.ofB);
      verdict_.add(thin ? Fault::ThinApart : Fault::Apart,
        a.name + " and " + b.name + ": " + number(apart.distance() / edge_) + " edge lengths, at " +
          place(apart.ofA.farthestPoint()) + ", " + place(apart.ofB.farthestPoint()));
    }
  }

  void failed(const std::string& what) { verdict_.add(Fault::Failed, what); }

  const TreeVerdict& verdict() const { return verdict_; }

private:
  void lookAtSolid(const Made& made)
  {
    const SolidCheck solid = checkSolid(*made.tree, made.mesh, edge_, points_, seed_);
    if (solid.volumeOff())
    {
      verdict_.add(Fault::Volume,
        made.name + ": by " + number(solid.excess) + ", sigma " + number(solid.sigma) +
          ", chords " + number(solid.chords));
    }
    if (solid.wrong.farthest() > kFar * edge_)
    {
      verdict_.add(this->isAllThin(*made.tree, solid.wrong) ? Fault::ThinSide : Fault::Side,
        made.name + ": " + number(solid.wrong.farthest() / edge_) + " edge lengths deep, at " +
          place(solid.wrong.farthestPoint()));
    }
  }

  bool isAllThin(const Node& tree, const FarPoints& far) const
  {
    const std::vector<Vec3> points = far.beyond(kFar * edge_, kNear * edge_);
    return std::all_of(
      points.begin(), points.end(), [&](const Vec3& point) { return isThin(tree, point, edge_); });
  }

  double edge_;
  std::size_t points_;
  std::uint64_t seed_;
  TreeVerdict verdict_;
};

TreeVerdict judge(std::uint64_t seed, double cells, std::size_t points)
{
  Random random(seed);
  const int depth = random.integer(2, 6);
  const double threshold = kThresholds[std::size_t(random.integer(0, 2))];
  const Box3 bounds = randomTree(seed, depth)->surfaceBounds();
  const double edge = bounds.isEmpty() ? 0.1 : bounds.sizes().maxCoeff() / cells;
  Judge judge(edge, points, seed);
  std::vector<Made> all;
  for (std::size_t m = 0; m < kMethods.size(); ++m)
  {
    try
    {
      const NodePtr tree = randomTree(seed, depth, { kMethods[m], threshold }, edge);
      all.push_back({ kNames[m], tree, tree->mesh(edge) });
      judge.look(all.back());
    }
    catch (const Error& error)
    {
      judge.failed(std::string(kNames[m]) + ": " + error.what());
    }
  }
  for (std::size_t m = 0; m < all.size() && !judge.verdict().broken(); ++m)
  {
    for (std::size_t n = m + 1; n < all.size(); ++n)
    {
      judge.compare(all[m], all[n]);
    }
  }
  return judge.verdict();
}

} // namespace

void TreeVerdict::add(Fault fault, const std::string& what)
{
  ++count[std::size_t(fault)];
  text += "  " + std::string(kFaultNames[std::size_t(fault)]) + ": " + what + "\n";
}

bool TreeVerdict::bad() const
{
  return std::any_of(count.begin(), count.begin() + std::ptrdiff_t(Fault::ThinSide),
    [](int faults) { return faults > 0; });
}

std::vector<TreeVerdict> tryTree(std::uint64_t seed, double cells, std::size_t points)
{
  std::vector<TreeVerdict> verdicts;
  for (int halving = 0; halving <= kHalvings; ++halving)
  {
    verdicts.push_back(judge(seed, cells * double(1 << halving), points));
    if (!verdicts.back().bad() || verdicts.back().broken())
    {
      break;
    }
  }
  return verdicts;
}

} // namespace hybridtree::test
