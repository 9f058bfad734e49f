// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/RandomTree.h"
#include "core/mesh/MeshChecks.h"
#include "core/tree/Serialize.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

namespace hybridtree::test
{
namespace
{

constexpr int kDepth = 6;
constexpr std::uint64_t kTrees = 300;
constexpr std::uint64_t kTreesPerTest = 30;

// Kinds whose mesh is made by the lattice from their own field.
bool isLatticeNode(const Node& node)
{
  const std::string kind = node.kind();
  return kind == "blend" || kind == "localBlend" || kind == "boolean";
}

std::vector<double> fieldAt(const FieldSource& source, PointBatch points)
{
  std::vector<double> value(points.size);
  source.field(points, value.data());
  return value;
}

NodePtr reread(const Node& node)
{
  const auto meshes = meshesOf(node);
  const std::map<std::string, MeshPtr> byHash(meshes.begin(), meshes.end());
  return fromText(toText(node), [&](const std::string& hash) { return byHash.at(hash); });
}

// The surface passes within `reach` of the point: f - T has both signs along the gradient there, or
// along an axis where the field has a corner or a jump.
bool isNearSurface(const Node& node, const Vec3& point, const Vec3& gradient, double reach)
{
  PointList around;
  std::vector<Vec3> directions{ Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ() };
  if (gradient.norm() > 0.0)
  {
    directions.push_back(gradient.normalized());
  }
  for (const Vec3& direction : directions)
  {
    around.add(point - reach * direction);
    around.add(point + reach * direction);
  }
  const std::vector<double> value = fieldAt(node, around);
  const auto [low, high] = std::minmax_element(value.begin(), value.end());
  return *low <= kThreshold && *high >= kThreshold;
}

using PointSet = std::set<std::array<double, 3>>;

std::array<double, 3> asKey(const Vec3& point)
{
  return { point[0], point[1], point[2] };
}

// Points of the meshes below a blend, which it may have taken over as they are.
void addPointsBelow(const Node& node, double edge, PointSet& points)
{
  for (const NodePtr& child : node.children())
  {
    if (!child->isNegative())
    {
      for (const Vec3& point : child->mesh(edge)->points)
      {
        points.insert(asKey(point));
      }
      addPointsBelow(*child, edge, points);
    }
  }
}

bool cutsBelow(const Node& node)
{
  const std::vector<NodePtr> children = node.children();
  return std::any_of(children.begin(), children.end(),
    [](const NodePtr& child)
    { return std::string(child->kind()) == "boolean" || cutsBelow(*child); });
}

void markOnSurface(
  const Node& node, const std::vector<Vec3>& vertices, double allowed, std::vector<bool>& on)
{
  const PointList points(vertices);
  VectorList gradient(points.size());
  std::vector<double> value(points.size());
  node.fieldAndGradient(points, value.data(), gradient);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    on[k] = on[k] || std::abs(value[k] - kThreshold) <= allowed * gradient[k].norm() ||
      isNearSurface(node, points[k], gradient[k], allowed);
  }
}

void expectMeshOnTheSurface(const Node& tree)
{
  const Box3 bounds = tree.surfaceBounds();
  if (bounds.isEmpty())
  {
    EXPECT_TRUE(tree.mesh(0.1)->empty());
    return;
  }
  const double edge = bounds.sizes().maxCoeff() / 20.0;
  const MeshPtr mesh = tree.mesh(edge);
  const MeshReport report = checkMesh(*mesh);
  EXPECT_TRUE(report.closedManifold()) << tree.kind() << ": " << report.describe();
  EXPECT_EQ(mesh->normals.size(), mesh->points.size());
  EXPECT_EQ(mesh->sourceLeaf.size(), mesh->triangles.size());
  if (!isLatticeNode(tree) || mesh->empty())
  {
    return;
  }
  // A Boolean's surface is made of its children's; where a child has corners its mesh has notches,
  // and what lies in one is not cut away.
  const bool isBoolean = std::string(tree.kind()) == "boolean";
  std::vector<bool> on(mesh->points.size(), false);
  for (const NodePtr& node : isBoolean ? tree.children() : std::vector<NodePtr>{ nullptr })
  {
    markOnSurface(node ? *node : tree, mesh->points, 1e-3 * edge, on);
  }
  PointSet below;
  if (std::count(on.begin(), on.end(), false) > 0)
  {
    addPointsBelow(tree, edge, below);
  }
  std::size_t off = 0;
  for (std::size_t k = 0; k < on.size(); ++k)
  {
    off += !on[k] && below.count(asKey(mesh->points[k])) == 0;
  }
  // Points of a cut stay on the meshes where moving them would turn triangles over, and what a
  // blend makes of such edges lies beside the surface as they do.
  const std::size_t allowed = isBoolean ? on.size() / 20 : cutsBelow(tree) ? on.size() / 100 : 0;
  EXPECT_LE(off, allowed) << "of " << on.size() << " vertices";
}

void expectQueriesThatAgree(const Node& tree, std::uint64_t seed)
{
  const Box3 reach = tree.influenceBounds();
  if (reach.isEmpty())
  {
    return;
  }
  Random random(seed);
  const PointList points = randomPoints(random, reach, 200);
  const std::vector<double> value = fieldAt(tree, points);
  std::vector<std::int8_t> side(points.size());
  tree.membership(points, side.data());
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    if (std::abs(value[k] - kThreshold) > 1e-7)
    {
      EXPECT_EQ(int(side[k]), value[k] > kThreshold ? 1 : -1) << points[k].transpose();
    }
  }
  const Interval whole = tree.range(reach);
  EXPECT_LE(whole.min, *std::min_element(value.begin(), value.end()) + 1e-12);
  EXPECT_GE(whole.max, *std::max_element(value.begin(), value.end()) - 1e-12);

  Box3 part(random.inBox(reach));
  part.extend(random.inBox(reach));
  const PointList inside = randomPoints(random, part, 60);
  const std::vector<double> expected = fieldAt(tree, inside);
  const FieldSourcePtr restricted = tree.restrictedTo(part);
  const std::vector<double> partly =
    restricted ? fieldAt(*restricted, inside) : std::vector<double>(inside.size(), 0.0);
  const Interval range = tree.range(part);
  for (std::size_t k = 0; k < inside.size(); ++k)
  {
    EXPECT_NEAR(partly[k], expected[k], 1e-9) << inside[k].transpose();
    EXPECT_GE(expected[k], range.min - 1e-12) << inside[k].transpose();
    EXPECT_LE(expected[k], range.max + 1e-12) << inside[k].transpose();
  }
  EXPECT_EQ(fieldAt(*reread(tree), points), value);

  const Affine3 map = randomMap(random);
  PointList mapped;
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    mapped.add(map * points[k]);
  }
  const std::vector<double> image = fieldAt(*tree.affine(map), mapped);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    EXPECT_NEAR(image[k], value[k], 1e-6) << points[k].transpose();
  }
}

class RandomTree : public testing::TestWithParam<std::uint64_t>
{
};

TEST_P(RandomTree, MeshIsAClosedManifoldOnTheSurface)
{
  for (std::uint64_t seed = this->GetParam(); seed < this->GetParam() + kTreesPerTest; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expectMeshOnTheSurface(*randomTree(seed, kDepth));
  }
}

TEST_P(RandomTree, QueriesAgree)
{
  for (std::uint64_t seed = this->GetParam(); seed < this->GetParam() + kTreesPerTest; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expectQueriesThatAgree(*randomTree(seed, kDepth), seed);
  }
}

// Seeds that once failed: vertices beside a crease.
TEST(Corpus, SeedsThatOnceFailed)
{
  for (const std::uint64_t seed : { 410, 753, 1898, 1907 })
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expectMeshOnTheSurface(*randomTree(seed, kDepth));
  }
}

// Trees that once failed, kept as text. They have no mesh leaves.
TEST(Corpus, TreesThatOnceFailed)
{
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(HYBRIDTREE_CORPUS))
  {
    SCOPED_TRACE(entry.path().filename().string());
    std::ifstream file(entry.path());
    const std::string text{ std::istreambuf_iterator<char>(file), {} };
    const NodePtr tree = fromText(text);
    expectMeshOnTheSurface(*tree);
    expectQueriesThatAgree(*tree, 0);
    ++count;
  }
  EXPECT_GT(count, 0);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomTree, testing::Range(std::uint64_t(0), kTrees, kTreesPerTest),
  [](const testing::TestParamInfo<std::uint64_t>& info)
  { return "From" + std::to_string(info.param); });

} // namespace
} // namespace hybridtree::test
