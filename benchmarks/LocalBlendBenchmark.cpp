// SPDX-License-Identifier: BSD-3-Clause
// Blends that keep their operands' triangles ([HT] 5.2.1, Table 3): the Igea scan as a mesh leaf,
// with segment and point primitives blended onto cheek, chin and nose, one after the other as in
// Fig. 16.
//   - sample points and times of all methods, in turns, medians;
//   - the paper's opponent: a dense grid of 149^3 points filled with distances to the scan, by
//   Embree,
//     without bound and within R (a share of its layers, scaled up);
//   - 50 successive edits of one small primitive beside the first polygonization.
// As "pairs": whether the automatic method takes the faster way on random shapes, by default 1,000
// pairs of balls (Fig. 15); a table of times over overlap ratios as CSV, and a tally.
//
//   LocalBlendBenchmark [threads, default 2] [rounds, default 5]
//   LocalBlendBenchmark methods [threads] [rounds]
//     the methods alone
//   LocalBlendBenchmark pairs FILE [pairs, default 1000] [rounds, default 5] [balls, primitives,
//     meshes or warps, default balls] [seed, default 15]
//   LocalBlendBenchmark edits|global|node-based|primitive-based|automatic [threads] [rounds]
//     one of them alone, for a profiler
#include "benchmarks/support/BenchmarkMesh.h"
#include "benchmarks/support/BlendPairs.h"
#include "benchmarks/support/EmbreeDistance.h"
#include "core/base/Parallel.h"
#include "core/mesh/MeshChecks.h"
#include "core/nodes/BlendMesh.h"
#include "core/nodes/MeshNode.h"
#include "core/nodes/Primitive.h"
#include "core/skeletons/Point.h"
#include "core/skeletons/Segment.h"
#include "tests/support/Random.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace
{

using namespace hybridtree;

constexpr int kGrid = 149; // points a side of the dense grid; the scan is 1 unit in size
constexpr double kInfluence = 0.05;

const std::array<BlendMethod, 4> kMethods = { BlendMethod::Global, BlendMethod::NodeBased,
  BlendMethod::PrimitiveBased, BlendMethod::Automatic };
const std::array<std::string, 4> kNames = { "global", "node-based", "primitive-based",
  "automatic" };

double seconds(const std::function<void()>& work)
{
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Of all threads: what a busy machine cannot change.
double processorSeconds(const std::function<void()>& work)
{
  const std::clock_t start = std::clock();
  work();
  return double(std::clock() - start) / CLOCKS_PER_SEC;
}

double median(std::vector<double> times)
{
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

/// Round by round, so that a burst of other work meets both.
double medianRatio(const std::vector<double>& over, const std::vector<double>& under)
{
  std::vector<double> ratios;
  for (std::size_t k = 0; k < over.size(); ++k)
  {
    ratios.push_back(over[k] / under[k]);
  }
  return median(std::move(ratios));
}

NodePtr scanLeaf(const MeshPtr& mesh)
{
  return makeMeshNode(mesh, 1.0, kInfluence, 2);
}

/// The point of the mesh that is farthest in a direction.
Vec3 farthest(const TriangleMesh& mesh, const Vec3& direction)
{
  return *std::max_element(mesh.points.begin(), mesh.points.end(),
    [&](const Vec3& a, const Vec3& b) { return a.dot(direction) < b.dot(direction); });
}

/// What is blended onto the scan: two chains of segments along the surface, and two balls.
std::vector<NodePtr> additions(const TriangleMesh& mesh, double shift = 0.0)
{
  const Potential thin = Potential::bySurfaceRadius(0.012, 0.025, 2);
  std::vector<NodePtr> nodes;
  for (const Vec3& side : { Vec3(1.0, 0.2, 0.3), Vec3(-1.0, -0.3, 0.2) })
  {
    for (int k = 0; k < 3; ++k)
    {
      const Vec3 along(0.0, 0.12 * k, 0.08 * k);
      const Vec3 next(0.0, 0.12 * (k + 1), 0.08 * (k + 1));
      nodes.push_back(makePrimitive(std::make_shared<SegmentSkeleton>(
                                      farthest(mesh, side + along), farthest(mesh, side + next)),
        thin));
    }
  }
  for (const Vec3& tip : { Vec3(0.3, 0.2, 1.0), Vec3(0.1, -1.0, 0.4) })
  {
    nodes.push_back(makePrimitive(
      std::make_shared<PointSkeleton>(farthest(mesh, tip) + Vec3(shift, 0.3 * shift, 0.0)),
      Potential::bySurfaceRadius(0.015, 0.03, 2)));
  }
  return nodes;
}

/// ((scan + first) + second) + ...
NodePtr chain(NodePtr scan, const std::vector<NodePtr>& parts, BlendMethod method)
{
  NodePtr node = std::move(scan);
  for (const NodePtr& part : parts)
  {
    node = makeBlend({ node, part }, { method, 0.5 });
  }
  return node;
}

/// Leaves of a chain of blends, as Blend flattens them; for the reports only.
BlendMeshReport reportOf(
  const NodePtr& scan, const std::vector<NodePtr>& parts, BlendMethod method, double edge)
{
  std::vector<NodePtr> all{ scan };
  all.insert(all.end(), parts.begin(), parts.end());
  const NodePtr flat = makeBlend(all, { method, 0.5 });
  std::vector<BlendPart> leaves;
  for (const NodePtr& node : flat->children())
  {
    leaves.push_back({ node.get(), static_cast<std::int32_t>(leaves.size()) });
  }
  BlendMeshReport report;
  blendMesh(*flat, leaves, { method, 0.5 }, edge, report);
  return report;
}

double denseGrid(const TriangleMesh& mesh, int threads, double reach, int stride)
{
  benchmark::EmbreeDistance embree(mesh, threads);
  embree.build();
  const double step = 1.0 / (kGrid - 1);
  std::vector<double> distance(std::size_t(kGrid) * kGrid);
  double time = 0.0;
  int layers = 0;
  for (int z = stride / 2; z < kGrid; z += stride, ++layers)
  {
    test::PointList points;
    for (int k = 0; k < kGrid * kGrid; ++k)
    {
      points.add(Vec3(k % kGrid, k / kGrid, z) * step);
    }
    time += seconds([&] { embree.distance(points, reach, distance.data()); });
  }
  return time * kGrid / layers;
}

/// The last ball is dragged along the surface.
struct Edits
{
  std::vector<double> times;
  std::vector<double> processorTimes;
};

/// \param parts of the mesh that is edited, which has been made.
Edits timesOfEdits(
  const NodePtr& scan, const TriangleMesh& mesh, const std::vector<NodePtr>& parts, double edge)
{
  Edits edits;
  for (int k = 0; k < 50; ++k)
  {
    std::vector<NodePtr> edited = parts;
    edited.back() = additions(mesh, 0.0005 * k).back();
    edits.processorTimes.push_back(processorSeconds(
      [&]
      {
        const NodePtr node = chain(scan, edited, BlendMethod::PrimitiveBased);
        edits.times.push_back(seconds([&] { node->mesh(edge); }));
      }));
  }
  return edits;
}

void reportEdits(const NodePtr& scan, const TriangleMesh& mesh, const std::vector<NodePtr>& parts,
  double edge, double first, double firstProcessor, double global)
{
  const Edits edits = timesOfEdits(scan, mesh, parts, edge);
  const double middle = median(edits.times);
  const double slowest = *std::max_element(edits.times.begin(), edits.times.end());
  const double processor = median(edits.processorTimes);
  std::printf(
    "first polygonization, cold: %.1f ms; global, warm: %.1f ms\n", 1e3 * first, 1e3 * global);
  std::printf("50 edits: median %.1f ms, slowest %.1f ms: 1/%.0f and 1/%.0f of the first, "
              "1/%.0f and 1/%.0f of a global one\n",
    1e3 * middle, 1e3 * slowest, first / middle, first / slowest, global / middle,
    global / slowest);
  std::printf("time of all processors: first %.1f ms, edits %.1f ms: 1/%.0f\n",
    1e3 * firstProcessor, 1e3 * processor, firstProcessor / processor);
}

/// For a profiler: one thing over and over.
void alone(const std::string& what, int threads, int rounds)
{
  setThreadCount(threads);
  const MeshPtr mesh = benchmark::benchmarkMesh("igea.ply", 268000);
  const double edge = 1.0 / (kGrid - 1);
  const NodePtr scan = scanLeaf(mesh);
  const std::vector<NodePtr> parts = additions(*mesh);
  for (int round = 0; round < rounds; ++round)
  {
    if (what == "edits")
    {
      chain(scan, parts, BlendMethod::PrimitiveBased)->mesh(edge);
      const Edits edits = timesOfEdits(scan, *mesh, parts, edge);
      std::printf("median %.1f ms, of all processors %.1f ms, slowest %.1f ms\n",
        1e3 * median(edits.times), 1e3 * median(edits.processorTimes),
        1e3 * *std::max_element(edits.processorTimes.begin(), edits.processorTimes.end()));
      continue;
    }
    const auto named = std::find(kNames.begin(), kNames.end(), what);
    if (named == kNames.end())
    {
      std::printf("There is no %s.\n", what.c_str());
      return;
    }
    const BlendMethod method = kMethods[static_cast<std::size_t>(named - kNames.begin())];
    forgetBlends();
    const double time = processorSeconds([&] { chain(scan, parts, method)->mesh(edge); });
    std::printf("%s: %.1f ms of all processors\n", what.c_str(), 1e3 * time);
  }
}

/// \param all also the edits and the dense grids.
void table3(int threads, int rounds, bool all)
{
  setThreadCount(threads);
  const MeshPtr mesh = benchmark::benchmarkMesh("igea.ply", 268000);
  const double edge = 1.0 / (kGrid - 1);
  const std::vector<NodePtr> parts = additions(*mesh);

  // Cold: hierarchy, normals, checks and the leaf's mesh are made inside the time.
  NodePtr scan;
  double firstProcessor = 0.0;
  const double first = seconds(
    [&]
    {
      firstProcessor = processorSeconds(
        [&]
        {
          scan = scanLeaf(std::make_shared<const TriangleMesh>(*mesh));
          chain(scan, parts, BlendMethod::PrimitiveBased)->mesh(edge);
        });
    });
  std::array<std::vector<double>, 4> times, processorTimes;
  std::array<MeshPtr, 4> meshes;
  for (int round = 0; round < rounds; ++round)
  {
    for (std::size_t m = 0; m < kMethods.size(); ++m)
    {
      forgetBlends();      // nothing is left from before
      meshes[m] = nullptr; // what is freed takes no time of the next
      const NodePtr node = chain(scan, parts, kMethods[m]);
      processorTimes[m].push_back(processorSeconds(
        [&] { times[m].push_back(seconds([&] { meshes[m] = node->mesh(edge); })); }));
    }
  }
  const double global = median(times[0]);
  std::printf("%zu triangles and %zu primitives, edge length 1/%d, %d threads, medians of %d\n",
    mesh->triangles.size(), parts.size(), kGrid - 1, threads, rounds);
  const std::size_t allSamples = meshes[0]->points.size();
  for (std::size_t m = 0; m < kMethods.size(); ++m)
  {
    const BlendMeshReport report = reportOf(scan, parts, kMethods[m], edge);
    // Node-based: a flat blend does not repeat what its chain samples several times.
    const std::string samples = kMethods[m] == BlendMethod::NodeBased
      ? "(flat " + std::to_string(report.samplePoints) + ")"
      : std::to_string(report.samplePoints);
    std::printf("%-16s %9.1f ms (%.1f of all processors)  %6.1f times as fast (%.1f by processor "
                "time)  samples %s (1/%.0f)  %zu triangles, %zu kept, %zu cells marked, %zu at "
                "the border, %d round%s, %s\n",
      kNames[m].c_str(), 1e3 * median(times[m]), 1e3 * median(processorTimes[m]),
      medianRatio(times[0], times[m]), medianRatio(processorTimes[0], processorTimes[m]),
      samples.c_str(), double(allSamples) / double(std::max<std::size_t>(report.samplePoints, 1)),
      meshes[m]->triangles.size(), report.keptTriangles, report.markedCells, report.borderCells,
      report.rounds, report.rounds == 1 ? "" : "s",
      isClosedManifold(*meshes[m]) ? "closed manifold" : "NOT CLOSED");
  }
  const double local = median(times[2]);
  if (!all)
  {
    return;
  }

  reportEdits(scan, *mesh, parts, edge, first, firstProcessor, global);

  const double bounded = denseGrid(*mesh, threads, kInfluence, 4);
  std::printf("dense %d^3 grid by Embree within R: %.1f s, %.0f times the primitive-based mesh\n",
    kGrid, bounded, bounded / local);
  const double unbounded = denseGrid(*mesh, threads, std::numeric_limits<double>::infinity(), 16);
  std::printf("dense %d^3 grid by Embree, no bound: %.1f s, %.0f times the primitive-based mesh\n",
    kGrid, unbounded, unbounded / local);
}

} // namespace

int main(int argc, char** argv)
{
  if (argc > 2 && std::string(argv[1]) == "pairs")
  {
    const std::string kind = argc > 5 ? argv[5] : "balls";
    const auto seed = static_cast<std::uint64_t>(argc > 6 ? std::atoll(argv[6]) : 15);
    const bool isKnown = benchmark::compareOnPairs(
      argv[2], argc > 3 ? std::atoi(argv[3]) : 1000, argc > 4 ? std::atoi(argv[4]) : 5, kind, seed);
    if (!isKnown)
    {
      std::printf("There is no kind %s.\n", kind.c_str());
    }
    return isKnown ? 0 : 1;
  }
  if (argc > 1 && std::string(argv[1]) == "methods")
  {
    table3(
      argc > 2 ? std::max(1, std::atoi(argv[2])) : 2, argc > 3 ? std::atoi(argv[3]) : 5, false);
    return 0;
  }
  if (argc > 1 && std::isalpha(argv[1][0]))
  {
    alone(argv[1], argc > 2 ? std::max(1, std::atoi(argv[2])) : 2,
      argc > 3 ? std::max(1, std::atoi(argv[3])) : 1);
    return 0;
  }
  table3(argc > 1 ? std::max(1, std::atoi(argv[1])) : 2, argc > 2 ? std::atoi(argv[2]) : 5, true);
  return 0;
}
