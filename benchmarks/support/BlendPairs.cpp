// SPDX-License-Identifier: BSD-3-Clause
#include "benchmarks/support/BlendPairs.h"

#include "benchmarks/support/BenchmarkMesh.h"
#include "core/base/Parallel.h"
#include "core/geometry/BoxUnion.h"
#include "core/mesh/ContentHash.h"
#include "core/nodes/Barr.h"
#include "core/nodes/BlendMesh.h"
#include "core/nodes/MeshNode.h"
#include "core/nodes/Primitive.h"
#include "core/skeletons/Point.h"
#include "core/skeletons/Segment.h"
#include "tests/support/Random.h"
#include "tests/support/TestMeshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace hybridtree::benchmark
{
namespace
{

constexpr double kLost = 1.1;
constexpr int kMoreRounds = 8;

/// Of all threads: what a busy machine changes least.
double processorSeconds(const std::function<void()>& work)
{
  const std::clock_t start = std::clock();
  work();
  return double(std::clock() - start) / CLOCKS_PER_SEC;
}

double median(std::vector<double> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// What is blended, and what may be done to the blend.
struct Shape
{
  std::vector<NodePtr> children;
  double edge = 0.02;
  double threshold = 0.5;
  std::function<NodePtr(NodePtr)> around = [](NodePtr node) { return node; };

  /// Of the last child.
  double ratio() const
  {
    std::vector<Box3> others;
    for (std::size_t k = 0; k + 1 < children.size(); ++k)
    {
      others.push_back(children[k]->influenceBounds());
    }
    return overlapRatio(children.back()->influenceBounds(), others);
  }

  /// New leaves each time: their direct meshes are part of the work. Meshes stay, as in editing.
  MeshPtr mesh(BlendMethod method) const
  {
    const Affine3 map(Eigen::Translation3d(1e-9, 0, 0));
    std::vector<NodePtr> fresh;
    for (const NodePtr& child : children)
    {
      fresh.push_back(child->isFaceted() ? child : child->affine(map));
    }
    return around(makeBlend(std::move(fresh), { method, threshold }))->mesh(edge);
  }

  BlendMeshReport report(BlendMethod method) const
  {
    std::vector<BlendPart> parts;
    std::int32_t leaves = 0;
    for (const NodePtr& child : children)
    {
      parts.push_back({ child.get(), leaves });
      leaves += child->leafCount();
    }
    BlendMeshReport report;
    const NodePtr node = makeBlend(children, { method, threshold });
    blendMesh(*node, parts, { method, threshold }, edge, report);
    return report;
  }
};

using ShapeMaker = std::function<Shape(test::Random&)>;

NodePtr ball(const Vec3& center, double radius)
{
  return makePrimitive(
    std::make_shared<PointSkeleton>(center), Potential::bySurfaceRadius(radius, 1.5 * radius, 2));
}

/// As in [HT] Fig. 15.
Shape twoBalls(test::Random& random)
{
  const double radius = random.uniform(0.25, 0.5);
  Shape shape;
  shape.children = { ball(Vec3::Zero(), 0.5),
    ball(random.uniform(0.0, 1.6) * random.direction(), radius) };
  shape.threshold = 1.0;
  return shape;
}

Shape sixPrimitives(test::Random& random)
{
  Shape shape;
  const double spread = random.uniform(0.5, 2.5);
  for (int k = 0; k < 6; ++k)
  {
    const Vec3 place = random.uniform(0.0, spread) * random.direction();
    const double radius = random.uniform(0.1, 0.4);
    const Vec3 end = place + random.uniform(0.2, 1.5) * random.direction();
    shape.children.push_back(random.chance(0.5)
        ? ball(place, radius)
        : makePrimitive(std::make_shared<SegmentSkeleton>(place, end),
            Potential::bySurfaceRadius(radius, 1.5 * radius, 2)));
  }
  return shape;
}

/// Leaves of about unit size, and the edge lengths to mesh them with: the scan is finer than the
/// first lattice and coarser than the second.
std::vector<std::pair<NodePtr, double>> meshLeaves()
{
  std::vector<std::pair<NodePtr, double>> leaves;
  const NodePtr scan = makeMeshNode(benchmarkMesh("igea.ply", 268000), 1.0, 0.05, 2);
  leaves.emplace_back(scan, 1.0 / 100);
  leaves.emplace_back(scan, 1.0 / 240);
  const auto add = [&](TriangleMesh mesh)
  {
    Box3 box;
    for (const Vec3& point : mesh.points)
    {
      box.extend(point);
    }
    const double scale = 1.0 / box.sizes().maxCoeff();
    for (Vec3& point : mesh.points)
    {
      point = (point - box.min()) * scale;
    }
    leaves.emplace_back(
      makeMeshNode(std::make_shared<const TriangleMesh>(std::move(mesh)), 1.0, 0.1, 2), 1.0 / 60);
  };
  for (const char* name : { "joint.off", "anchor.off", "cube.off" })
  {
    if (std::optional<TriangleMesh> mesh = test::demoMesh(name))
    {
      add(*mesh);
    }
  }
  add(test::icosphere(0.5, 2));
  return leaves;
}

Shape meshAndBall(test::Random& random)
{
  static const std::vector<std::pair<NodePtr, double>> leaves = meshLeaves();
  const auto& [leaf, edge] =
    leaves[static_cast<std::size_t>(random.integer(0, static_cast<int>(leaves.size()) - 1))];
  const double radius = std::exp(random.uniform(std::log(0.03), std::log(0.6)));
  const TriangleMesh& mesh = *leaf->leafMesh();
  const auto point = static_cast<std::size_t>(random.integer(0, int(mesh.points.size()) - 1));
  Shape shape;
  shape.children = { leaf, ball(mesh.points[point] + 0.8 * radius * random.direction(), radius) };
  shape.edge = edge;
  return shape;
}

Shape warped(test::Random& random)
{
  Shape shape = random.chance(0.5) ? twoBalls(random) : sixPrimitives(random);
  shape.threshold = 0.5;
  BarrFrame frame;
  frame.axis = random.direction();
  frame.normal = frame.axis.unitOrthogonal();
  frame.begin = random.uniform(-0.8, -0.1);
  frame.end = random.uniform(0.1, 0.8);
  const int kind = random.integer(0, 2);
  const double twist = random.uniform(-1.5, 1.5);
  const double factor = random.uniform(0.5, 1.6);
  const auto warp = [=](NodePtr node)
  {
    return kind == 0 ? makeTwist(std::move(node), frame, twist)
      : kind == 1    ? makeTaper(std::move(node), frame, factor)
                     : makeBend(std::move(node), frame, 0.25 * twist);
  };
  if (random.chance(0.5))
  {
    shape.around = warp;
    return shape;
  }
  for (NodePtr& child : shape.children)
  {
    child = warp(child);
  }
  return shape;
}

std::optional<ShapeMaker> makerOf(const std::string& kind)
{
  const std::vector<std::pair<std::string, ShapeMaker>> makers = { { "balls", twoBalls },
    { "primitives", sixPrimitives }, { "meshes", meshAndBall }, { "warps", warped } };
  for (const auto& [name, maker] : makers)
  {
    if (name == kind)
    {
      return maker;
    }
  }
  return std::nullopt;
}

/// Times of some methods in turns.
template <std::size_t Count>
class Turns
{
public:
  using Methods = std::array<BlendMethod, Count>;

  Turns(const Shape& shape, const Methods& methods, std::uint64_t seed)
    : shape_(shape), methods_(methods), random_(seed)
  {
  }

  void measure()
  {
    std::array<std::size_t, Count> order;
    for (std::size_t k = 0; k < Count; ++k)
    {
      order[k] = k;
      std::swap(order[k], order[static_cast<std::size_t>(random_.integer(0, int(k)))]);
    }
    for (const std::size_t m : order)
    {
      forgetBlends();
      times_[m].push_back(processorSeconds([&] { shape_.mesh(methods_[m]); }));
    }
  }

  double medianOf(std::size_t m) const { return median(times_[m]); }

  std::vector<double> ratios(std::size_t over, std::size_t under) const
  {
    std::vector<double> ratios;
    for (std::size_t k = 0; k < times_[over].size(); ++k)
    {
      ratios.push_back(times_[over][k] / times_[under][k]);
    }
    return ratios;
  }

private:
  const Shape& shape_;
  const Methods methods_;
  test::Random random_;
  std::array<std::vector<double>, Count> times_;
};

bool isSame(const Shape& shape, BlendMethod a, BlendMethod b)
{
  return contentHash(*shape.mesh(a)) == contentHash(*shape.mesh(b));
}

/// Whether the numbers on one side of a value are more than chance explains (95%, two-sided).
bool isClear(const std::vector<double>& numbers, double value)
{
  const auto count = static_cast<double>(numbers.size());
  const auto above = static_cast<double>(
    std::count_if(numbers.begin(), numbers.end(), [&](double n) { return n > value; }));
  return std::abs(above - 0.5 * count) > 0.98 * std::sqrt(count);
}

/// Of automatic to the faster way, and of that to itself.
struct Ratios
{
  double automatic = 1.0;
  double itself = 1.0;
  bool isClear = true;
};

Ratios ratiosToBest(const Shape& shape, BlendMethod best, int rounds, std::uint64_t seed)
{
  Turns<3> turns(shape, { best, BlendMethod::Automatic, best }, seed);
  Ratios ratios;
  ratios.isClear = false;
  for (int round = 1; round <= kMoreRounds * rounds && (round <= rounds || !ratios.isClear);
       ++round)
  {
    turns.measure();
    ratios.isClear = isClear(turns.ratios(1, 0), kLost);
  }
  ratios.automatic = median(turns.ratios(1, 0));
  ratios.itself = median(turns.ratios(2, 0));
  return ratios;
}

struct Tally
{
  std::vector<double> automatic, itself, whereGlobal, whereLocal;
  std::vector<double> globalIsFaster; ///< lost to global, then
  int slowerWay = 0;
  int unclear = 0;

  static void print(const char* what, std::vector<double> ratios)
  {
    if (ratios.empty())
    {
      return;
    }
    std::sort(ratios.begin(), ratios.end());
    const auto lost =
      std::count_if(ratios.begin(), ratios.end(), [](double ratio) { return ratio > kLost; });
    std::printf("%-34s %4zu: median %.3f, one of ten above %.3f, largest %.2f; above %.1f: %d\n",
      what, ratios.size(), ratios[ratios.size() / 2], ratios[ratios.size() * 9 / 10], ratios.back(),
      kLost, static_cast<int>(lost));
  }

  void print() const
  {
    Tally::print("automatic / faster way", automatic);
    Tally::print("  where it is global", whereGlobal);
    Tally::print("  where it is local", whereLocal);
    Tally::print("  where global is the faster way", globalIsFaster);
    Tally::print("faster way / the same once more", itself);
    std::printf(
      "the slower way was taken %d times; %d were too close to 1.1 to tell\n", slowerWay, unclear);
  }
};

} // namespace

bool compareOnPairs(
  const std::string& file, int count, int rounds, const std::string& kind, std::uint64_t seed)
{
  const std::optional<ShapeMaker> make = makerOf(kind);
  if (!make)
  {
    return false;
  }
  setThreadCount(1);
  std::ofstream csv(file);
  csv << "ratio,global,local,automatic,takesLocal,overFaster,fasterOverItself,cells,border,kept,"
         "cut,made,samples\n";
  test::Random random(seed);
  Tally tally;
  for (int k = 0; k < count; ++k)
  {
    const Shape shape = (*make)(random);
    const auto order = static_cast<std::uint64_t>(k);
    Turns<3> turns(
      shape, { BlendMethod::Global, BlendMethod::NodeBased, BlendMethod::Automatic }, order);
    for (int round = 0; round < rounds; ++round)
    {
      turns.measure();
    }
    const bool globalIsFaster = turns.medianOf(0) <= turns.medianOf(1);
    const Ratios ratios = ratiosToBest(
      shape, globalIsFaster ? BlendMethod::Global : BlendMethod::NodeBased, rounds, order);
    const BlendMeshReport local = shape.report(BlendMethod::NodeBased);
    // A map may choose for the blend below: what the mesh tells.
    const bool isGlobal = isSame(shape, BlendMethod::Automatic, BlendMethod::Global);
    const bool isLocal = isSame(shape, BlendMethod::Automatic, BlendMethod::NodeBased);
    tally.automatic.push_back(ratios.automatic);
    tally.itself.push_back(ratios.itself);
    (isGlobal ? tally.whereGlobal : tally.whereLocal).push_back(ratios.automatic);
    if (globalIsFaster)
    {
      tally.globalIsFaster.push_back(ratios.automatic);
    }
    tally.slowerWay += isGlobal != isLocal && isGlobal != globalIsFaster ? 1 : 0;
    tally.unclear += ratios.isClear ? 0 : 1;
    csv << shape.ratio() << ',' << turns.medianOf(0) << ',' << turns.medianOf(1) << ','
        << turns.medianOf(2) << ',' << (isGlobal ? 0 : 1) << ',' << ratios.automatic << ','
        << ratios.itself << ',' << local.markedCells << ',' << local.borderCells << ','
        << local.keptTriangles << ',' << local.cutTriangles << ',' << local.newTriangles << ','
        << shape.report(BlendMethod::Global).samplePoints << '\n';
  }
  tally.print();
  return true;
}

} // namespace hybridtree::benchmark
