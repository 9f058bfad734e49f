// SPDX-License-Identifier: BSD-3-Clause
// Edits below local blends: what they leave as it was is taken over, and the mesh is that of a cold
// start, bit for bit.
#include "core/base/Parallel.h"
#include "core/mesh/MeshChecks.h"
#include "core/nodes/BlendMesh.h"
#include "core/nodes/Boolean.h"
#include "core/nodes/LocalBlend.h"
#include "core/nodes/MeshNode.h"
#include "core/nodes/Primitive.h"
#include "core/skeletons/Point.h"

#include "tests/support/Random.h"
#include "tests/support/SameMesh.h"
#include "tests/support/TestMeshes.h"

#include <gtest/gtest.h>

#include <array>
#include <map>

namespace hybridtree::test
{
namespace
{

constexpr double kEdge = 0.05;

struct Ball
{
  Vec3 center;
  double radius;

  bool operator<(const Ball& other) const
  {
    const auto key = [](const Ball& ball) {
      return std::array{ ball.center.x(), ball.center.y(), ball.center.z(), ball.radius };
    };
    return key(*this) < key(other);
  }
};

/// A bumpy sphere with balls on it, which are blended in regions of their own.
struct Scene
{
  MeshPtr body = std::make_shared<const TriangleMesh>(bumpySphere(0.6, 4));
  std::vector<Ball> onBody; ///< blended with the body everywhere
  std::vector<Ball> others;
  std::vector<Ball> regions;
  std::vector<Ball> secondOthers; ///< by a local blend above, where there are any
  std::vector<Ball> secondRegions;
  bool unite = false; ///< regions by Booleans, as the filter does, or by a blend
};

/// Nodes as a pipeline keeps them: what has not changed is the same object.
class Pipeline
{
public:
  struct Made
  {
    NodePtr node;
    TriangleMesh mesh;
    BlendMeshReport report;
  };

  Made make(const Scene& scene)
  {
    NodePtr& body = bodies_[scene.body];
    body = body ? body : makeMeshNode(scene.body, 1.0, 0.1, 2);
    std::vector<NodePtr> first = this->ballsOf(scene.onBody);
    first.insert(first.begin(), body);
    NodePtr node =
      this->localBlend(this->joined(first, false), this->joined(this->ballsOf(scene.others), false),
        this->joined(this->ballsOf(scene.regions), scene.unite));
    if (!scene.secondOthers.empty())
    {
      node = this->localBlend(node, this->joined(this->ballsOf(scene.secondOthers), false),
        this->joined(this->ballsOf(scene.secondRegions), scene.unite));
    }
    Made made{ node, {}, {} };
    const std::vector<NodePtr> parts = node->children();
    NodePtr& both = unions_[{ parts[0], parts[1] }];
    both =
      both ? both : makeBoolean(BooleanOperation::Union, parts[0], parts[1], BooleanForm::Smooth);
    made.mesh =
      localBlendMesh(*node, { parts[0].get(), parts[1].get(), parts[2].get(), both.get() },
        { BlendMethod::PrimitiveBased, 0.5 }, kEdge, made.report);
    return made;
  }

private:
  std::vector<NodePtr> ballsOf(const std::vector<Ball>& balls)
  {
    std::vector<NodePtr> nodes;
    for (const Ball& ball : balls)
    {
      NodePtr& node = balls_[ball];
      node = node ? node
                  : makePrimitive(std::make_shared<PointSkeleton>(ball.center),
                      Potential::bySurfaceRadius(ball.radius, 2.0 * ball.radius, 2));
      nodes.push_back(node);
    }
    return nodes;
  }

  NodePtr joined(const std::vector<NodePtr>& nodes, bool unite)
  {
    NodePtr& known = joined_[{ nodes, unite }];
    if (known)
    {
      return known;
    }
    NodePtr node = nodes.front();
    for (std::size_t k = 1; k < nodes.size() && unite; ++k)
    {
      node = makeBoolean(BooleanOperation::Union, node, nodes[k]);
    }
    return known = unite ? node : makeBlend(nodes, { BlendMethod::PrimitiveBased, 0.5 });
  }

  NodePtr localBlend(const NodePtr& a, const NodePtr& b, const NodePtr& region)
  {
    NodePtr& known = locals_[{ a, b, region }];
    known = known ? known : makeLocalBlend(a, b, region, { BlendMethod::PrimitiveBased, 0.5 });
    return known;
  }

  std::map<MeshPtr, NodePtr> bodies_;
  std::map<Ball, NodePtr> balls_;
  std::map<std::pair<std::vector<NodePtr>, bool>, NodePtr> joined_;
  std::map<std::array<NodePtr, 3>, NodePtr> locals_;
  std::map<std::array<NodePtr, 2>, NodePtr> unions_;
};

std::vector<Ball> spread(Random& random, int count, double radius)
{
  std::vector<Ball> balls;
  for (int k = 0; k < count; ++k)
  {
    balls.push_back({ 0.6 * random.direction(), radius * random.uniform(0.8, 1.2) });
  }
  return balls;
}

std::vector<Ball> beside(Random& random, std::vector<Ball> balls)
{
  for (Ball& ball : balls)
  {
    ball.center += 0.05 * random.direction();
    ball.radius = 0.05;
  }
  return balls;
}

Scene randomScene(Random& random, bool nested)
{
  Scene scene;
  scene.onBody = spread(random, 3, 0.04);
  scene.others = spread(random, 5, 0.06);
  scene.regions = beside(random, scene.others);
  if (nested)
  {
    scene.secondOthers = spread(random, 3, 0.06);
    scene.secondRegions = beside(random, scene.secondOthers);
  }
  scene.unite = random.chance(0.5);
  return scene;
}

/// Moves, adds or removes one ball somewhere in the tree.
void edit(Random& random, Scene& scene)
{
  const int which = random.integer(0, scene.secondOthers.empty() ? 2 : 4);
  std::vector<Ball>& balls = which == 0 ? scene.onBody
    : which == 1                        ? scene.others
    : which == 2                        ? scene.regions
    : which == 3                        ? scene.secondOthers
                                        : scene.secondRegions;
  const int what = random.integer(0, 5);
  Ball& ball = balls[static_cast<std::size_t>(random.integer(0, int(balls.size()) - 1))];
  if (what == 0)
  {
    balls.push_back({ 0.6 * random.direction(), 0.05 });
  }
  else if (what == 1 && balls.size() > 2)
  {
    balls.pop_back();
  }
  else
  {
    ball.center += 0.03 * random.direction();
  }
}

void expectEditsAreAsCold(bool nested, std::size_t leastKept)
{
  std::size_t kept = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed)
  {
    SCOPED_TRACE(seed);
    Random random(8800 + seed);
    Scene scene = randomScene(random, nested);
    Pipeline pipeline;
    pipeline.make(scene);
    for (int k = 0; k < 6; ++k)
    {
      SCOPED_TRACE(k);
      edit(random, scene);
      setThreadCount(k % 2 == 0 ? 1 : 3);
      const Pipeline::Made after = pipeline.make(scene);
      kept += after.report.rememberedIslands;
      setThreadCount(k % 3 == 0 ? 2 : 1);
      // Nodes of its own: nothing is remembered of them.
      const Pipeline::Made cold = Pipeline().make(scene);
      EXPECT_EQ(cold.report.rememberedIslands, 0u);
      EXPECT_TRUE(isClosedManifold(cold.mesh)) << checkMesh(cold.mesh).describe();
      expectSame(after.mesh, cold.mesh);
    }
  }
  setThreadCount(0);
  EXPECT_GT(kept, leastKept);
}

TEST(LocalBlendEdits, GiveTheMeshOfAColdStart)
{
  expectEditsAreAsCold(false, 25u);
}

TEST(LocalBlendEdits, GiveTheMeshOfAColdStartInNestedOnes)
{
  expectEditsAreAsCold(true, 15u);
}

/// Balls at the ends of the axes, far from one another.
Scene separateBalls()
{
  Scene scene;
  for (const Vec3& at : { Vec3(0.6, 0, 0), Vec3(-0.6, 0, 0), Vec3(0, 0.6, 0), Vec3(0, -0.6, 0) })
  {
    scene.others.push_back({ at, 0.06 });
    scene.regions.push_back({ 1.1 * at, 0.06 });
  }
  return scene;
}

TEST(LocalBlendEdits, MakeAnewOnlyWhatTheyReach)
{
  Scene scene = separateBalls();
  for (const bool unite : { false, true })
  {
    scene.unite = unite;
    Pipeline pipeline;
    EXPECT_EQ(pipeline.make(scene).report.islands, 4u);
    for (std::vector<Ball>* balls : { &scene.regions, &scene.others })
    {
      (*balls)[1].center += Vec3(0.001, 0.01, 0.0);
      const Pipeline::Made after = pipeline.make(scene);
      EXPECT_EQ(after.report.islands, 4u);
      EXPECT_EQ(after.report.rememberedIslands, 3u);
    }
    scene.onBody.push_back({ Vec3(0.0, 0.0, 0.6), 0.05 });
    const Pipeline::Made more = pipeline.make(scene);
    // It is numbered before the others.
    EXPECT_EQ(more.report.rememberedIslands, 0u);
    scene.onBody.back().center += Vec3(0.01, 0.0, 0.0);
    EXPECT_EQ(pipeline.make(scene).report.rememberedIslands, 4u);
    scene.onBody.clear();
  }
}

} // namespace
} // namespace hybridtree::test
