// SPDX-License-Identifier: BSD-3-Clause
// Dragging the parameter of a map: the mesh below is there, and each edit maps and mends it.
//
//   WarpBenchmark [scan, blend, balls or limbs; default all] [threads, default 2]
//     [edits, default 11] [bend, twist, taper or stretch; default all]
//
// scan: Igea. blend: balls and limbs on it. balls: two that are blended, meshed by the lattice.
// limbs: segments blended, the same. Prints medians over the edits.
#include "benchmarks/support/BenchmarkMesh.h"
#include "core/base/Parallel.h"
#include "core/mesh/ContentHash.h"
#include "core/mesh/MeshChecks.h"
#include "core/nodes/Barr.h"
#include "core/nodes/Blend.h"
#include "core/nodes/MeshNode.h"
#include "core/nodes/Primitive.h"
#include "core/skeletons/Point.h"
#include "core/skeletons/Segment.h"
#include "tests/support/TriangleAngles.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace
{

using namespace hybridtree;

struct Time
{
  double wall;
  double processors;
};

Time timeOf(const std::function<void()>& work)
{
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t ticks = std::clock();
  work();
  return { std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
    double(std::clock() - ticks) / CLOCKS_PER_SEC };
}

double median(std::vector<double> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// In percent: below 10 and 20 degrees.
std::pair<double, double> shareOfBad(const TriangleMesh& mesh)
{
  return { 100.0 * test::shareBelow(mesh, 10.0), 100.0 * test::shareBelow(mesh, 20.0) };
}

struct Shape
{
  std::string name;
  std::function<NodePtr()> make;
  double edge;
};

NodePtr ball(const Vec3& center, double radius)
{
  return makePrimitive(
    std::make_shared<PointSkeleton>(center), Potential::bySurfaceRadius(radius, 1.5 * radius, 2));
}

NodePtr limb(const Vec3& from, const Vec3& to, double radius)
{
  return makePrimitive(std::make_shared<SegmentSkeleton>(from, to),
    Potential::bySurfaceRadius(radius, 1.5 * radius, 2));
}

MeshPtr scan()
{
  static const MeshPtr mesh = benchmark::benchmarkMesh("igea.ply", 268000);
  return mesh;
}

Vec3 farthest(const Vec3& direction)
{
  const std::vector<Vec3>& points = scan()->points;
  return *std::max_element(points.begin(), points.end(),
    [&](const Vec3& a, const Vec3& b) { return a.dot(direction) < b.dot(direction); });
}

NodePtr scanNode()
{
  return makeMeshNode(scan(), 1.0, 0.05, 2);
}

NodePtr blendOnScan()
{
  std::vector<NodePtr> parts{ scanNode() };
  for (const Vec3& side : { Vec3(1.0, 0.2, 0.3), Vec3(-1.0, -0.3, 0.2), Vec3(0.3, 0.2, 1.0) })
  {
    parts.push_back(ball(farthest(side), 0.05));
    parts.push_back(limb(farthest(side), farthest(side + Vec3(0.0, 0.3, 0.2)), 0.02));
  }
  return makeBlend(std::move(parts), {});
}

NodePtr balls()
{
  return makeBlend(
    { ball(Vec3::Zero(), 0.5), ball(Vec3(0.5, 0.3, 0.2), 0.4) }, { BlendMethod::Global, 0.5 });
}

NodePtr limbs()
{
  std::vector<NodePtr> parts;
  for (int k = 0; k < 6; ++k)
  {
    const double turn = k;
    const Vec3 end(std::cos(turn), std::sin(turn), 0.4 * std::cos(3.0 * turn));
    parts.push_back(limb(0.2 * end, end, 0.15));
  }
  return makeBlend(std::move(parts), { BlendMethod::Global, 0.5 });
}

using Map = std::function<NodePtr(NodePtr, double)>;

/// By a number from 0 to 1.
std::vector<std::pair<std::string, Map>> maps()
{
  const auto frame = [](const NodePtr& node)
  {
    const Box3 box = node->surfaceBounds();
    BarrFrame frame;
    frame.origin = box.center();
    frame.axis = Vec3::UnitY();
    frame.begin = -0.5 * box.sizes().y();
    frame.end = 0.5 * box.sizes().y();
    return frame;
  };
  return { { "bend",
             [=](NodePtr node, double s)
             {
               const BarrFrame f = frame(node);
               return makeBend(std::move(node), f, 0.5 + 0.5 * s);
             } },
    { "twist",
      [=](NodePtr node, double s)
      {
        const BarrFrame f = frame(node);
        return makeTwist(std::move(node), f, 1.0 + s);
      } },
    { "taper",
      [=](NodePtr node, double s)
      {
        const BarrFrame f = frame(node);
        return makeTaper(std::move(node), f, 0.5 + 0.2 * s);
      } },
    { "stretch",
      [](NodePtr node, double s)
      {
        Affine3 map = Affine3::Identity();
        map.linear().diagonal() = Vec3(1.0, 1.5 + s, 0.8);
        return node->affine(map);
      } } };
}

void measure(const Shape& shape, const std::string& only, int edits)
{
  const NodePtr node = shape.make();
  const Time below = timeOf([&] { node->mesh(shape.edge); });
  const MeshPtr source = node->mesh(shape.edge);
  const auto before = shareOfBad(*source);
  std::printf("%s: %zu triangles in %.1f ms (%.1f of all processors); %.2f%% below 10 degrees, "
              "%.2f%% below 20\n",
    shape.name.c_str(), source->triangles.size(), 1e3 * below.wall, 1e3 * below.processors,
    before.first, before.second);
  for (const auto& [name, map] : maps())
  {
    if (!only.empty() && only != name)
    {
      continue;
    }
    std::vector<double> wall, processors;
    MeshPtr mesh;
    for (int k = 0; k < edits; ++k)
    {
      mesh = nullptr;
      const NodePtr mapped = map(node, double(k) / edits);
      const Time time = timeOf([&] { mesh = mapped->mesh(shape.edge); });
      wall.push_back(time.wall);
      processors.push_back(time.processors);
    }
    const auto bad = shareOfBad(*mesh);
    std::printf("  %-8s %8.1f ms (%8.1f of all processors, %.2f us a triangle)  %zu triangles, "
                "%.2f%% below 10 degrees, %.2f%% below 20, %s, hash %s\n",
      name.c_str(), 1e3 * median(wall), 1e3 * median(processors),
      1e6 * median(processors) / double(mesh->triangles.size()), mesh->triangles.size(), bad.first,
      bad.second, isClosedManifold(*mesh) ? "closed manifold" : "NOT CLOSED",
      contentHashText(*mesh).c_str());
    std::fflush(stdout);
  }
}

} // namespace

int main(int argc, char** argv)
{
  const std::string only = argc > 1 ? argv[1] : "all";
  setThreadCount(argc > 2 ? std::max(1, std::atoi(argv[2])) : 2);
  const int edits = argc > 3 ? std::max(1, std::atoi(argv[3])) : 11;
  const std::vector<Shape> shapes = { { "scan", scanNode, 1.0 / 100 },
    { "blend", blendOnScan, 1.0 / 148 }, { "balls", balls, 0.02 }, { "limbs", limbs, 0.02 } };
  for (const Shape& shape : shapes)
  {
    if (only == "all" || only == shape.name)
    {
      measure(shape, argc > 4 ? argv[4] : "", edits);
    }
  }
  return 0;
}
