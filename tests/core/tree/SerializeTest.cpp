// SPDX-License-Identifier: BSD-3-Clause
#include "core/tree/Serialize.h"

#include "core/base/Error.h"
#include "core/nodes/Blend.h"
#include "core/nodes/Boolean.h"
#include "core/nodes/LocalBlend.h"
#include "core/nodes/MeshNode.h"
#include "core/nodes/Primitive.h"
#include "core/skeletons/Box.h"
#include "core/skeletons/Point.h"
#include "core/skeletons/Segment.h"
#include "tests/support/Random.h"
#include "tests/support/TestMeshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>

namespace hybridtree::test
{
namespace
{

NodePtr ball(double x, double radius = 0.5)
{
  return makePrimitive(std::make_shared<PointSkeleton>(Vec3(x, 0.1, -0.2)),
    Potential::bySurfaceRadius(radius, 2.0 * radius, 2));
}

NodePtr meshLeaf(const MeshPtr& mesh)
{
  return makeMeshNode(mesh, 1.0, 0.25, 2);
}

// Any finite double whatever.
double anyDouble(Random& random)
{
  for (;;)
  {
    const std::uint64_t bits = random.bits();
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof value);
    if (std::isfinite(value))
    {
      return value;
    }
  }
}

std::string headed(const std::string& nodes)
{
  return R"({"format":"HybridTree","version":1,"nodes":[)" + nodes + "]}";
}

const std::string kPoint =
  R"({"kind":"primitive","parameters":{"skeleton":"point","center":[0,0.5,1],)"
  R"("maximumField":1,"influenceRadius":2,"exponent":2}})";

// What fromText() says of a text that is wrong.
std::string complaint(const std::string& text, const MeshLookup& lookup = {})
{
  try
  {
    fromText(text, lookup);
  }
  catch (const InvalidText& error)
  {
    return error.what();
  }
  return "accepted";
}

void expectComplaint(const std::string& text, const std::string& part)
{
  EXPECT_NE(complaint(text).find(part), std::string::npos)
    << complaint(text) << "\nof " << text.substr(0, 1000);
}

TEST(Serialize, NumbersComeBackBitForBit)
{
  Random random(1);
  int tested = 0;
  for (int round = 0; round < 500; ++round)
  {
    const Vec3 center(anyDouble(random), round == 0 ? -0.0 : anyDouble(random), anyDouble(random));
    const double field = round == 1 ? std::nextafter(0.5, 1.0) : anyDouble(random);
    const double radius = std::abs(anyDouble(random));
    NodePtr node;
    try
    {
      node = makePrimitive(
        std::make_shared<PointSkeleton>(center), Potential(field, radius, random.integer(2, 9)));
    }
    catch (const InvalidParameter&)
    {
      continue; // numbers so far out that the potential has no room for them
    }
    const NodePtr read = fromText(toText(*node));
    const auto before = node->parameters().entries();
    const auto after = read->parameters().entries();
    ASSERT_EQ(before, after);
    const Vec3 again = read->parameters().getVec3("center");
    ASSERT_EQ(std::memcmp(again.data(), center.data(), sizeof(double) * 3), 0);
    ++tested;
  }
  EXPECT_GT(tested, 100);
}

TEST(Serialize, SharedSubtreesStayShared)
{
  const NodePtr a = ball(0.0);
  const NodePtr b = ball(0.7);
  const NodePtr cut = makeBoolean(BooleanOperation::Difference, a, b);
  const NodePtr read = fromText(toText(*makeBlend({ a, cut, cut, b })));
  const std::vector<NodePtr> children = read->children();
  ASSERT_EQ(children.size(), 4u);
  EXPECT_EQ(children[1], children[2]);
  EXPECT_EQ(children[1]->children()[0], children[0]);
  EXPECT_EQ(children[1]->children()[1], children[3]);
}

TEST(Serialize, DoublingChainsGrowLinearly)
{
  NodePtr node = ball(0.0);
  for (int level = 0; level < 16; ++level)
  {
    node = makeBoolean(BooleanOperation::Union, node, node);
  }
  EXPECT_EQ(node->leafCount(), 1 << 16);
  const std::string text = toText(*node);
  EXPECT_LT(text.size(), 3000u);
  EXPECT_EQ(fromText(text)->leafCount(), 1 << 16);
}

TEST(Serialize, ChainsThatExplodeAreRefused)
{
  const std::string boolean =
    R"(,{"kind":"boolean","parameters":{"operation":"union","form":"automatic"},"children":[)";
  std::string nodes = kPoint;
  for (int level = 0; level < 60; ++level)
  {
    nodes += boolean + std::to_string(level) + "," + std::to_string(level) + "]}";
  }
  expectComplaint(headed(nodes), "1048576 leaves");

  nodes = kPoint;
  for (int level = 0; level < 1500; ++level)
  {
    nodes += boolean + "0," + std::to_string(level) + "]}";
  }
  expectComplaint(headed(nodes), "1001 nodes above each other");
  expectComplaint(std::string(200000, '['), "JSON");
  expectComplaint(headed(kPoint + "," + std::string(5000, '[') + std::string(5000, ']')), "kind");
}

TEST(Serialize, IntegersServeAsReals)
{
  const NodePtr node = fromText(headed(kPoint));
  EXPECT_EQ(node->parameters().getDouble("maximumField"), 1.0);
  EXPECT_EQ(node->parameters().getVec3("center"), Vec3(0.0, 0.5, 1.0));
  std::string reals = kPoint;
  reals.replace(reals.find("\"exponent\":2"), 12, "\"exponent\":2.5");
  expectComplaint(headed(reals), "\"exponent\"");
}

TEST(Serialize, MeshesAreFoundByTheirHash)
{
  const auto mesh = std::make_shared<const TriangleMesh>(icosphere(1.0, 1));
  const auto other = std::make_shared<const TriangleMesh>(box(Vec3::Zero(), Vec3::Ones()));
  const NodePtr tree = makeBlend({ meshLeaf(mesh), meshLeaf(other),
    meshLeaf(mesh)->affine(Affine3(Eigen::Translation3d(1, 2, 3))) });
  const auto meshes = meshesOf(*tree);
  ASSERT_EQ(meshes.size(), 2u);
  EXPECT_EQ(meshes[0].second, mesh);
  EXPECT_EQ(meshes[1].second, other);
  const std::string text = toText(*tree);
  const std::map<std::string, MeshPtr> byHash(meshes.begin(), meshes.end());
  const NodePtr read = fromText(text, [&](const std::string& hash) { return byHash.at(hash); });
  EXPECT_EQ(meshesOf(*read)[0].second, mesh) << "shared, not copied";
  EXPECT_NE(complaint(text).find(meshes[0].first), std::string::npos) << complaint(text);
  EXPECT_NE(complaint(text, [](const std::string&) { return MeshPtr(); }), "accepted");
}

TEST(Serialize, EachFaultIsNamed)
{
  expectComplaint("", "JSON");
  expectComplaint("{", "JSON");
  expectComplaint("null", "HybridTree");
  expectComplaint("[]", "HybridTree");
  expectComplaint(R"({"format":"Other","version":1,"nodes":[]})", "HybridTree");
  expectComplaint(R"({"format":"HybridTree","nodes":[]})", "version");
  expectComplaint(R"({"format":"HybridTree","version":2,"nodes":[]})", "version 2");
  expectComplaint(headed(""), "nodes");
  expectComplaint(headed("1"), "kind");
  expectComplaint(headed(R"({"kind":"teapot"})"), "teapot");
  expectComplaint(headed(R"({"kind":"primitive"})"), "is missing");
  expectComplaint(headed(R"({"kind":"primitive","parameters":[]})"), "parameters");
  expectComplaint(headed(R"({"kind":"primitive","parameters":{"skeleton":null}})"), "\"skeleton\"");
  expectComplaint(headed(R"({"kind":"primitive","parameters":{"center":["a"]}})"), "\"center\"");
  expectComplaint(
    headed(kPoint + R"(,{"kind":"primitive","parameters":{},"children":[0]})"), "Node 1");
  const auto boolean = [](const std::string& parameters, const std::string& children)
  {
    return headed(kPoint + R"(,{"kind":"boolean","parameters":{)" + parameters +
      R"(},"children":)" + children + "}");
  };
  const std::string good = R"("operation":"union","form":"smooth")";
  expectComplaint(boolean(good, "[0]"), "1 children");
  expectComplaint(boolean(good, "[0,1]"), "child 1");
  expectComplaint(boolean(good, "[0,-1]"), "child -1");
  expectComplaint(boolean(good, "[0,0.5]"), "child 0.5");
  expectComplaint(boolean(good, "[0,18446744073709551615]"), "child 18446744073709551615");
  expectComplaint(boolean(good, "{}"), "children");
  expectComplaint(boolean(R"("operation":"sum","form":"smooth")", "[0,0]"), "\"sum\"");
  expectComplaint(boolean(R"("operation":"union","form":7)", "[0,0]"), "\"form\"");
  std::string huge = kPoint;
  huge.replace(huge.find("0.5"), 3, "1e999");
  expectComplaint(headed(huge), "JSON");
  std::string flat = kPoint;
  flat.replace(flat.find("\"influenceRadius\":2"), 19, "\"influenceRadius\":-2");
  expectComplaint(headed(flat), "InfluenceRadius");
}

TEST(Serialize, BrokenTextNeverDoesHarm)
{
  const auto mesh = std::make_shared<const TriangleMesh>(icosphere(0.5, 1));
  const NodePtr cut = makeBoolean(BooleanOperation::Difference, meshLeaf(mesh), ball(0.3));
  const NodePtr sheared =
    ball(0.2)->affine(Affine3(Eigen::Scaling(1.0, 2.0, 3.0) * Eigen::Translation3d(0, 1, 0)));
  const std::string text =
    toText(*makeLocalBlend(makeBlend({ cut, sheared }), ball(-0.4), ball(0.0, 1.0)));
  const MeshLookup lookup = [&](const std::string&) { return mesh; };
  ASSERT_NE(fromText(text, lookup), nullptr);
  int refused = 0;
  const auto attempt = [&](const std::string& broken)
  {
    try
    {
      const NodePtr node = fromText(broken, lookup);
      const PointList points(std::vector<Vec3>{ Vec3(0.1, 0.2, 0.3), Vec3(-5.0, 0.0, 1.0) });
      double value[2];
      node->field(points, value);
    }
    catch (const InvalidText&)
    {
      ++refused;
    }
  };
  for (std::size_t length = 0; length < text.size(); ++length)
  {
    attempt(text.substr(0, length));
  }
  EXPECT_EQ(refused, static_cast<int>(text.size()));
  Random random(2);
  const std::string alphabet = "{}[]\",:0123456789.-+eEnulltruefalse \\\x80\xff";
  for (int round = 0; round < 4000; ++round)
  {
    std::string broken = text;
    for (int change = random.integer(1, 4); change > 0; --change)
    {
      const auto at = static_cast<std::size_t>(random.integer(0, int(broken.size()) - 1));
      const char with =
        alphabet[static_cast<std::size_t>(random.integer(0, int(alphabet.size()) - 1))];
      switch (random.integer(0, 2))
      {
        case 0:
          broken[at] = with;
          break;
        case 1:
          broken.insert(at, 1, with);
          break;
        default:
          broken.erase(at, static_cast<std::size_t>(random.integer(1, 8)));
          break;
      }
    }
    attempt(broken);
  }
  EXPECT_GT(refused, static_cast<int>(text.size()) + 1000);
}

} // namespace
} // namespace hybridtree::test
