// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/BlendMesh.h"

#include "core/base/Error.h"
#include "core/base/Parallel.h"
#include "core/mesh/MeshChecks.h"
#include "core/mesh/MeshDistance.h"
#include "core/nodes/LatticeMesh.h"
#include "core/nodes/LocalBlend.h"
#include "core/nodes/MeshNode.h"
#include "core/nodes/Primitive.h"
#include "core/skeletons/Point.h"
#include "core/skeletons/Segment.h"

#include "tests/support/CancelAt.h"
#include "tests/support/Random.h"
#include "tests/support/RandomTree.h"
#include "tests/support/SameMesh.h"
#include "tests/support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace hybridtree::test
{
namespace
{

NodePtr ball(const Vec3& center, double radius, double influence, bool negative = false)
{
  return makePrimitive(std::make_shared<PointSkeleton>(center),
    Potential::bySurfaceRadius(radius, influence, 2, negative));
}

NodePtr limb(const Vec3& a, const Vec3& b, double radius, double influence)
{
  return makePrimitive(
    std::make_shared<SegmentSkeleton>(a, b), Potential::bySurfaceRadius(radius, influence, 2));
}

NodePtr meshLeaf(TriangleMesh mesh, double influence)
{
  return makeMeshNode(std::make_shared<const TriangleMesh>(std::move(mesh)), 1.0, influence, 2);
}

struct Made
{
  NodePtr node;
  MeshPtr mesh;
  BlendMeshReport report;
};

Made make(
  const std::vector<NodePtr>& children, BlendMethod method, double edge, double threshold = 0.5)
{
  Made made;
  const BlendOptions options{ method, threshold };
  made.node = makeBlend(children, options);
  std::vector<BlendPart> parts;
  int leaf = 0;
  for (const NodePtr& child : made.node->children())
  {
    parts.push_back({ child.get(), leaf });
    leaf += child->leafCount();
  }
  made.mesh =
    std::make_shared<const TriangleMesh>(blendMesh(*made.node, parts, options, edge, made.report));
  return made;
}

/// Of the points of one mesh from the other, both ways.
double hausdorff(const MeshPtr& a, const MeshPtr& b)
{
  double worst = 0.0;
  for (const auto& [from, to] : { std::pair(a, b), std::pair(b, a) })
  {
    const PointList points(from->points);
    std::vector<double> distance(points.size());
    MeshDistance(to).distance(points, std::numeric_limits<double>::infinity(), distance.data());
    worst = std::max(worst, *std::max_element(distance.begin(), distance.end()));
  }
  return worst;
}

using Corners = std::array<double, 9>;

Corners cornersOf(const TriangleMesh& mesh, std::size_t t)
{
  Corners corners;
  for (int k = 0; k < 9; ++k)
  {
    corners[k] = mesh.points[mesh.triangles[t][k / 3]][k % 3];
  }
  return corners;
}

/// Kept triangles are triangles of the children, bit for bit, with their normals and leaves.
void expectKept(const Made& made, double edge)
{
  std::map<Corners, std::pair<std::size_t, std::size_t>> known;
  const std::vector<NodePtr> children = made.node->children();
  std::vector<int> firstLeaf;
  int leaf = 0;
  for (std::size_t c = 0; c < children.size(); ++c)
  {
    firstLeaf.push_back(leaf);
    leaf += children[c]->leafCount();
    if (!children[c]->isNegative())
    {
      const MeshPtr mesh = children[c]->mesh(edge);
      for (std::size_t t = 0; t < mesh->triangles.size(); ++t)
      {
        known[cornersOf(*mesh, t)] = { c, t };
      }
    }
  }
  const TriangleMesh& mesh = *made.mesh;
  ASSERT_LE(made.report.keptTriangles, mesh.triangles.size());
  for (std::size_t t = 0; t < made.report.keptTriangles; ++t)
  {
    const auto found = known.find(cornersOf(mesh, t));
    ASSERT_NE(found, known.end()) << t;
    const auto& [c, own] = found->second;
    const TriangleMesh& from = *children[c]->mesh(edge);
    for (int k = 0; k < 3; ++k)
    {
      ASSERT_EQ(mesh.normals[mesh.triangles[t][k]], from.normals[from.triangles[own][k]]);
    }
    const std::int32_t source = from.sourceLeaf[own];
    ASSERT_EQ(mesh.sourceLeaf[t], source < 0 ? -1 : source + firstLeaf[c]);
  }
}

void expectSound(const Made& made)
{
  const MeshReport report = checkMesh(*made.mesh);
  EXPECT_TRUE(report.closedManifold()) << report.describe();
  EXPECT_EQ(report.unusedPoints, 0u);
  EXPECT_EQ(made.report.warning, "");
  EXPECT_EQ(made.mesh->sourceLeaf.size(), made.mesh->triangles.size());
}

TEST(BlendMesh, MethodsAgreeOnBalls)
{
  Random random(3);
  for (int k = 0; k < 12; ++k)
  {
    const Vec3 at = random.uniform(0.4, 1.3) * random.direction();
    const std::vector<NodePtr> children{ ball(Vec3::Zero(), 0.5, 0.8),
      ball(at, random.uniform(0.2, 0.5), 0.7) };
    const double edge = random.uniform(0.04, 0.09);
    const Made global = make(children, BlendMethod::Global, edge);
    for (const double threshold : { 0.5, 1.0 })
    {
      SCOPED_TRACE(k);
      const Made local = make(children, BlendMethod::NodeBased, edge, threshold);
      expectSound(local);
      expectKept(local, edge);
      EXPECT_LE(hausdorff(global.mesh, local.mesh), 0.5 * edge);
      EXPECT_EQ(
        checkMesh(*global.mesh).eulerCharacteristic, checkMesh(*local.mesh).eulerCharacteristic);
    }
  }
}

TEST(BlendMesh, RandomTreesAreClosedAndKeepTriangles)
{
  std::size_t kept = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed)
  {
    SCOPED_TRACE(seed);
    const std::vector<NodePtr> children{ randomTree(3 * seed, 2), randomTree(3 * seed + 1, 2),
      randomTree(3 * seed + 2, 1) };
    const Made local = make(children, BlendMethod::NodeBased, 0.07, seed % 2 == 0 ? 1.0 : 0.5);
    const MeshReport report = checkMesh(*local.mesh);
    EXPECT_TRUE(report.closedManifold()) << report.describe();
    expectKept(local, 0.07);
    kept += local.report.keptTriangles;
    const double whole = signedVolume(latticeMesh(*local.node, 0.07));
    EXPECT_NEAR(signedVolume(*local.mesh), whole, 0.01 + 0.02 * whole);
  }
  EXPECT_GT(kept, 20000u);
}

// Its 12 triangles have the creases; only the two around the ball are cut.
TEST(BlendMesh, CreasesStayWhereNothingBlends)
{
  const Vec3 low(-0.5, -0.5, -0.5);
  const Vec3 high(0.5, 0.5, 0.5);
  const Made made = make({ meshLeaf(box(low, high), 0.2), ball(Vec3(0.5, 0.1, 0.05), 0.1, 0.2) },
    BlendMethod::PrimitiveBased, 0.05);
  expectSound(made);
  expectKept(made, 0.05);
  // The faces beside the cut one are triangulated anew with it, since the sides between are parted.
  EXPECT_GE(made.report.keptTriangles, 2u);
  EXPECT_EQ(made.report.keptTriangles + made.report.cutTriangles, 12u);
  int found = 0;
  for (const Vec3& p : made.mesh->points)
  {
    found += ((p - low).cwiseAbs().array() * (p - high).cwiseAbs().array() == 0.0).all() ? 1 : 0;
  }
  EXPECT_EQ(found, 8);
  EXPECT_GT(signedVolume(*made.mesh), 1.0);
}

TEST(BlendMesh, NegativeBallsCarveAndTheRestIsKept)
{
  const Made made =
    make({ meshLeaf(bumpySphere(0.6, 4), 0.3), ball(Vec3(0.55, 0.2, 0.0), 0.15, 0.3, true) },
      BlendMethod::PrimitiveBased, 0.04);
  expectSound(made);
  expectKept(made, 0.04);
  EXPECT_GT(made.report.keptTriangles, 4000u);
  EXPECT_LT(signedVolume(*made.mesh), signedVolume(bumpySphere(0.6, 4)));
}

// At this edge length the lattice is the cheaper way, and coarser than the mesh.
TEST(BlendMesh, AutomaticKeepsDetailThatTheLatticeWouldLose)
{
  const NodePtr scan = meshLeaf(icosphere(1.0, 6), 0.5);
  const NodePtr bite = ball(Vec3(1.2, 0.2, 0.1), 0.9, 1.6, true);
  const Made made = make({ scan, bite }, BlendMethod::Automatic, 0.1, 1.0);
  expectSound(made);
  expectKept(made, 0.1);
  EXPECT_GT(made.report.keptTriangles, 10000u);
}

// Boxes of influence that overlap nearly wholly, around limbs that meet only in the middle.
TEST(BlendMesh, SlantLimbsAreMarkedWhereTheyMeet)
{
  const std::vector<NodePtr> limbs{ limb(Vec3(-2, -2, -2), Vec3(2, 2, 2), 0.12, 0.25),
    limb(Vec3(-2, -2, 2), Vec3(2, 2, -2), 0.12, 0.25) };
  const double edge = 0.06;
  const Made local = make(limbs, BlendMethod::NodeBased, edge, 1.0);
  expectSound(local);
  expectKept(local, edge);
  const Made global = make(limbs, BlendMethod::Global, edge);
  EXPECT_LT(10 * local.report.samplePoints, global.report.samplePoints);
  EXPECT_LE(hausdorff(global.mesh, local.mesh), 0.5 * edge);
}

TEST(BlendMesh, PrimitiveBasedMakesLessAnewThanNodeBased)
{
  std::vector<NodePtr> parts{ meshLeaf(icosphere(0.6, 4), 0.15) };
  NodePtr nested = parts.front();
  for (const Vec3& at : { Vec3(0.6, 0, 0), Vec3(0, 0.6, 0), Vec3(0, 0, 0.6) })
  {
    nested = makeBlend({ nested, ball(at, 0.08, 0.16) }, { BlendMethod::NodeBased, 0.5 });
  }
  const MeshPtr nodeBased = nested->mesh(0.04);
  EXPECT_TRUE(isClosedManifold(*nodeBased)) << checkMesh(*nodeBased).describe();
  const MeshPtr primitiveBased =
    makeBlend(nested->children(), { BlendMethod::PrimitiveBased, 0.5 })->mesh(0.04);
  EXPECT_TRUE(isClosedManifold(*primitiveBased)) << checkMesh(*primitiveBased).describe();
  EXPECT_LE(hausdorff(nodeBased, primitiveBased), 0.02);
}

TEST(BlendMesh, EqualChildrenAreMadeAnew)
{
  const NodePtr one = ball(Vec3::Zero(), 0.4, 0.8);
  const NodePtr both = makeBlend({ one, one }, { BlendMethod::NodeBased, 1.0 });
  const MeshPtr mesh = both->mesh(0.05);
  EXPECT_TRUE(isClosedManifold(*mesh));
  EXPECT_GT(signedVolume(*mesh), 1.2 * signedVolume(*one->mesh(0.05)));
}

// Outside of the region the mesh is that of the union.
TEST(BlendMesh, LocalBlendsKeepTheUnion)
{
  const NodePtr a = limb(Vec3(-1, 0, 0), Vec3(1, 0, 0), 0.2, 0.4);
  const NodePtr b = limb(Vec3(0, -1, 0.1), Vec3(0, 1, 0.1), 0.2, 0.4);
  const NodePtr region = ball(Vec3::Zero(), 0.3, 0.6);
  const double edge = 0.05;
  const NodePtr local = makeLocalBlend(a, b, region, { BlendMethod::NodeBased, 0.5 });
  const NodePtr global = makeLocalBlend(a, b, region, { BlendMethod::Global, 0.5 });
  EXPECT_TRUE(isClosedManifold(*local->mesh(edge))) << checkMesh(*local->mesh(edge)).describe();
  EXPECT_TRUE(local->warnings().empty());
  EXPECT_LE(hausdorff(local->mesh(edge), global->mesh(edge)), 0.5 * edge);
}

// What earlier meshes have left behind saves work and changes nothing: one primitive moves, grows,
// goes and comes back, over meshes, skeletons and what carves.
TEST(BlendMesh, EditsGiveWhatAFreshStartGives)
{
  std::size_t taken = 0;
  const auto bump = [](Random& random)
  {
    const double radius = random.uniform(0.02, 0.04);
    return ball(0.6 * random.direction(), radius, 2.0 * radius, random.chance(0.3));
  };
  for (std::uint64_t seed = 0; seed < 6; ++seed)
  {
    SCOPED_TRACE(seed);
    Random random(700 + seed);
    std::vector<NodePtr> children{ meshLeaf(bumpySphere(0.6, seed % 3 == 0 ? 2 : 4), 0.1) };
    for (int k = 0; k < 6; ++k)
    {
      children.push_back(bump(random));
    }
    children.push_back(limb(Vec3(0.7, 0, 0), Vec3(1.2, 0.3, 0), 0.1, 0.2));
    children.push_back(randomTree(900 + seed, 1));
    for (int edit = 0; edit < 5; ++edit)
    {
      SCOPED_TRACE(edit);
      children[static_cast<std::size_t>(random.integer(1, 6))] = bump(random);
      if (edit == 1)
      {
        children.pop_back();
      }
      const Made after = make(children, BlendMethod::PrimitiveBased, 0.05);
      taken += after.report.rememberedIslands;
      forgetBlends();
      const Made fresh = make(children, BlendMethod::PrimitiveBased, 0.05);
      EXPECT_EQ(fresh.report.rememberedIslands, 0u);
      expectSame(*after.mesh, *fresh.mesh);
    }
  }
  EXPECT_GT(taken, 25u);
}

// With a map above: what was not edited has the same image as before.
TEST(BlendMesh, EditsBelowAMapKeepWhatWasMade)
{
  Random random(711);
  const Affine3 map = Eigen::Translation3d(1, 2, 3) * random.rotation() * Eigen::Scaling(1.5);
  std::vector<NodePtr> children{ meshLeaf(bumpySphere(0.6, 4), 0.1),
    ball(Vec3(0.6, 0, 0), 0.03, 0.06), ball(Vec3(0, 0.6, 0), 0.03, 0.06),
    ball(Vec3(-0.6, 0, 0), 0.03, 0.06) };
  const auto images = [&] { return makeBlend(children, {})->affine(map)->children(); };
  const std::vector<NodePtr> before = images();
  make(before, BlendMethod::PrimitiveBased, 0.08);
  children[1] = ball(Vec3(0.6, 0.02, 0), 0.03, 0.06);
  const std::vector<NodePtr> after = images();
  EXPECT_EQ(before[0], after[0]);
  EXPECT_NE(before[1], after[1]);
  const Made edited = make(after, BlendMethod::PrimitiveBased, 0.08);
  EXPECT_EQ(edited.report.islands, 3u);
  EXPECT_EQ(edited.report.rememberedIslands, 2u);
  forgetBlends();
  expectSame(*edited.mesh, *make(after, BlendMethod::PrimitiveBased, 0.08).mesh);
}

// The default edge length, and with it the lattice, stays when a part moves a bit outward.
TEST(BlendMesh, SmallMovesKeepTheDefaultEdgeLength)
{
  int changes = 0;
  double last = 0.0;
  for (int k = 0; k < 100; ++k)
  {
    const NodePtr blend =
      makeBlend({ ball(Vec3(0, 0, 0), 0.5, 1.0), ball(Vec3(1.0 + 0.01 * k, 0, 0), 0.5, 1.0) }, {});
    const double length = blend->defaultEdgeLength();
    const double exact = blend->surfaceBounds().diagonal().norm() / 100.0;
    EXPECT_LE(std::abs(std::log2(length / exact)), 1.0 / 16.0 + 1e-12);
    changes += length != last ? 1 : 0;
    last = length;
  }
  EXPECT_LE(changes, 6);
}

// A primitive that is gone may have left its address to the next one.
TEST(BlendMesh, NothingIsTakenFromWhatIsGone)
{
  const NodePtr body = meshLeaf(icosphere(0.6, 3), 0.1);
  for (int k = 0; k < 40; ++k)
  {
    const auto bump = [&] { return ball(Vec3(0.6, 0, 0), 0.05 + 0.001 * k, 0.1); };
    const Made made = make({ body, bump() }, BlendMethod::PrimitiveBased, 0.05);
    EXPECT_EQ(made.report.rememberedIslands, 0u);
  }
}

// Normals over facets are smoothed; a scan that comes into the tree far away must not change what a
// blend of balls was.
TEST(BlendMesh, AMeshFarAwayChangesNothing)
{
  std::vector<NodePtr> children{ ball(Vec3(0, 0, 0), 0.4, 0.6), ball(Vec3(0.7, 0, 0), 0.3, 0.5) };
  make(children, BlendMethod::PrimitiveBased, 0.05, 1.0);
  children.push_back(meshLeaf(icosphere(0.3, 2, Vec3(5, 0, 0)), 0.1));
  const Made after = make(children, BlendMethod::PrimitiveBased, 0.05, 1.0);
  EXPECT_EQ(after.report.rememberedIslands, 1u);
  forgetBlends();
  expectSame(*after.mesh, *make(children, BlendMethod::PrimitiveBased, 0.05, 1.0).mesh);
}

// Wherever it is stopped, what is remembered up to there is whole.
TEST(BlendMesh, ACancelledOneLeavesNothingHalfDone)
{
  Random random(77);
  std::vector<NodePtr> children{ meshLeaf(bumpySphere(0.6, 4), 0.1) };
  for (int k = 0; k < 5; ++k)
  {
    children.push_back(ball(0.6 * random.direction(), 0.04, 0.08));
  }
  forgetBlends();
  const Made fresh = make(children, BlendMethod::PrimitiveBased, 0.05);
  int stopped = 0;
  for (int looks = 1, left = -1; left < 0; looks *= 2)
  {
    forgetBlends();
    const CancelAt stop(looks);
    try
    {
      makeBlend(children, { BlendMethod::PrimitiveBased, 0.5 })->mesh(0.05, stop);
    }
    catch (const Cancelled&)
    {
      ++stopped;
    }
    left = stop.looksLeft();
    expectSame(*make(children, BlendMethod::PrimitiveBased, 0.05).mesh, *fresh.mesh);
  }
  EXPECT_GT(stopped, 3);
}

TEST(BlendMesh, IsTheSameForAnyNumberOfThreads)
{
  const std::vector<NodePtr> children{ meshLeaf(bumpySphere(0.6, 3), 0.3),
    ball(Vec3(0.55, 0.2, 0.0), 0.2, 0.3), ball(Vec3(-0.5, 0.2, 0.1), 0.2, 0.3) };
  setThreadCount(1);
  const Made one = make(children, BlendMethod::PrimitiveBased, 0.04);
  setThreadCount(3);
  forgetBlends();
  const Made three = make(children, BlendMethod::PrimitiveBased, 0.04);
  setThreadCount(0);
  expectSame(*one.mesh, *three.mesh);
}

// Whatever was meshed before, and however many threads there are: the same way, the same mesh.
TEST(BlendMesh, AutomaticChoosesByTheShapeAlone)
{
  std::array<int, 2> taken{};
  Random random(11);
  const NodePtr still = ball(Vec3::Zero(), 0.5, 0.75);
  const NodePtr coarse = meshLeaf(icosphere(0.4, 2, Vec3(0.0, -1.2, 0.0)), 0.1);
  for (int edit = 0; edit < 16; ++edit)
  {
    SCOPED_TRACE(edit);
    std::vector<NodePtr> children{ still, ball(Vec3(1.25 - 0.03 * edit, 0, 0), 0.4, 0.6) };
    if (edit % 4 == 3)
    {
      children.push_back(coarse);
      children.push_back(ball(Vec3(0.0, -1.2, 0.0) + 0.4 * random.direction(), 0.2, 0.3));
    }
    setThreadCount(1);
    const Made after = make(children, BlendMethod::Automatic, 0.02, 1.0);
    setThreadCount(3);
    forgetBlends();
    const Made fresh = make(children, BlendMethod::Automatic, 0.02, 1.0);
    EXPECT_EQ(after.report.method, fresh.report.method);
    expectSame(*after.mesh, *fresh.mesh);
    ++taken[fresh.report.method == BlendMethod::Global ? 0 : 1];
  }
  setThreadCount(0);
  EXPECT_GT(taken[0], 2);
  EXPECT_GT(taken[1], 2);
}

} // namespace
} // namespace hybridtree::test
