// SPDX-License-Identifier: BSD-3-Clause
// Editing a skeleton: one vertex of the alien (15 triangles, 102 segments, level 2) is dragged, and
// the whole figure is made again, from the coarse graph to the triangles: refined skeleton, field,
// meshes of the pieces ([SUB] 4; what a user sees while dragging), or the closed mesh. With the
// meshes that were there before, and without; beside marching cubes over the same field.
// In random order, medians. "2 threads" is to be read by its wall time, on a machine with two free
// cores: CPU time is that of one of them.
#include "benchmarks/support/RatioReporter.h"
#include "core/base/Parallel.h"
#include "core/nodes/LatticeMesh.h"
#include "core/nodes/SkeletonElementFields.h"
#include "core/nodes/SkeletonLocalField.h"
#include "core/nodes/SubdivisionSkeleton.h"
#include "core/stitch/Stitch.h"
#include "core/subdivision/SkeletonMesh.h"
#include "tests/support/SkeletonShapes.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace
{

using namespace hybridtree;

constexpr int kLevel = 2;
constexpr double kCell = 0.09; // a hundredth of the diagonal

enum class Make
{
  Pieces,
  Joined,
  Lattice
};

/// The alien with one vertex on its way around a small circle, each from another place on: islands
/// of closed meshes are remembered by what they are made of, whoever asks, and would be found
/// again.
class Dragged
{
public:
  Dragged(std::int32_t point, BlendingKind blending)
    : graph_(test::alien()), point_(point), start_(graph_.points[std::size_t(point)])
  {
    options_.level = kLevel;
    options_.blending.kind = blending;
  }

  /// Moves the vertex on and makes all anew. \return the number of triangles.
  std::size_t update(Make make, PieceMeshCache* cache)
  {
    const double angle = 0.05 * ++step_;
    graph_.points[std::size_t(point_)] =
      start_ + 0.15 * Vec3(std::cos(angle), std::sin(angle), std::sin(2.0 * angle));
    const NodePtr node = makeSubdivisionSkeleton(graph_, options_);
    const auto& leaf = static_cast<const SubdivisionSkeleton&>(*node);
    if (make == Make::Lattice)
    {
      return latticeMesh(*node, kCell, Progress::none()).triangles.size();
    }
    const SkeletonElementFields elements(leaf,
      make == Make::Joined ? SkeletonElementFields::Sums::Largest
                           : SkeletonElementFields::Sums::Own);
    const SkeletonLocalField local(leaf);
    const SkeletonField field{ leaf.coarse(), leaf.refined(), kLevel, leaf, &elements,
      options_.blending.kind == BlendingKind::All, &local };
    if (make == Make::Joined)
    {
      SkeletonMeshOptions options;
      options.edgeLength = kCell;
      return skeletonMesh(field, options, cache)->mesh.triangles.size();
    }
    return joinPieces(pieceMeshes(field, {}, cache)).triangles.size();
  }

private:
  SkeletonGraph graph_;
  SubdivisionSkeletonOptions options_;
  std::int32_t point_;
  Vec3 start_;
  int step_ = nextStep_ += kSteps;
  static constexpr int kSteps = 1001; // no two come to the same place
  static inline int nextStep_ = 0;
};

void run(benchmark::State& state, std::int32_t point, BlendingKind blending, Make make, bool isWarm,
  int threads)
{
  setThreadCount(threads);
  Dragged alien(point, blending);
  PieceMeshCache cache;
  PieceMeshCache* used = isWarm ? &cache : nullptr;
  std::size_t triangles = isWarm ? alien.update(make, used) : 0;
  for (auto _ : state)
  {
    if (!isWarm)
    {
      forgetIslands();
    }
    triangles = alien.update(make, used);
  }
  state.counters["triangles"] = double(triangles);
  state.counters["updates/s"] =
    benchmark::Counter(1.0, benchmark::Counter::kIsIterationInvariantRate);
}

/// The point farthest along a direction among the ends of segments.
std::int32_t farthestPoint(const Vec3& direction)
{
  const SkeletonGraph graph = test::alien();
  const auto along = [&](std::int32_t k) { return graph.points[std::size_t(k)].dot(direction); };
  std::int32_t best = graph.segments[0][0];
  for (const SkeletonSegment& segment : graph.segments)
  {
    best = along(segment[1]) > along(best) ? segment[1] : best;
  }
  return best;
}

} // namespace

int main(int argc, char** argv)
{
  benchmarks::initializeInterleaved(argc, argv, 5);
  benchmarks::RatioReporter reporter;
  struct Vertex
  {
    const char* name;
    std::int32_t point;
  };
  const Vertex vertices[] = { { "a fingertip", farthestPoint(Vec3::UnitX()) },
    { "the tip of the tail", farthestPoint(-Vec3::UnitY()) }, { "the chest", 7 } };
  // Updates are of a few milliseconds: so few are enough, and the whole takes seconds.
  constexpr double kLeastSeconds = 0.05;
  const auto add = [&](const std::string& name, auto&& body)
  {
    reporter.list(name);
    benchmark::RegisterBenchmark(name.c_str(), body)
      ->Unit(benchmark::kMillisecond)
      ->MinTime(kLeastSeconds)
      ->UseRealTime();
  };
  for (const BlendingKind blending : { BlendingKind::All, BlendingKind::Neighbours })
  {
    const std::string how = blending == BlendingKind::All ? "all blending" : "neighbours blending";
    for (const auto& [name, point] : vertices)
    {
      const std::string row = std::string("drag ") + name + ", " + how + "/";
      const auto method = [&, at = point](Make make, bool isWarm, int threads)
      { return [=](benchmark::State& state) { run(state, at, blending, make, isWarm, threads); }; };
      add(row + "pieces, coherent, 2 threads", method(Make::Pieces, true, 2));
      add(row + "pieces, coherent", method(Make::Pieces, true, 1));
      add(row + "pieces, cold", method(Make::Pieces, false, 1));
      if (blending != BlendingKind::All)
      {
        continue; // the rest would take minutes
      }
      add(row + "closed mesh, coherent", method(Make::Joined, true, 1));
      add(row + "closed mesh, cold", method(Make::Joined, false, 1));
      add(row + "lattice", method(Make::Lattice, false, 1));
    }
  }
  // Rows in random order are printed when all have run.
  std::fprintf(stderr, "27 rows, five times each: half a minute, if nothing else runs.\n");
  benchmark::RunSpecifiedBenchmarks(&reporter);
  reporter.print();
  return 0;
}
