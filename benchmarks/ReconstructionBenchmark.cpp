// SPDX-License-Identifier: BSD-3-Clause
// Reconstruction of whole point sets, beside what CGAL offers for them: the bare Delaunay
// tetrahedralization, which ours is built upon, and the advancing front (whose result may be open).
// One after the other in one process; compare within one run. Point sets whose files are absent are
// reported as skipped.

#include "reconstruction/Convection.h"
#include "reconstruction/DynamicReconstruction.h"
#include "reconstruction/LevelOfDetail.h"
#include "tests/reconstruction/DemoPoints.h"
#include "tests/reconstruction/Samples.h"
#include "tests/support/TestMeshes.h"

#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace
{

using namespace hybridtree;
using namespace hybridtree::test;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using PointSet = std::vector<Vec3>;

// Binary little endian PLY of nothing but float32 x, y, z.
PointSet igea()
{
  std::ifstream stream(HYBRIDTREE_BENCHMARK_DATA "/igea_points.ply", std::ios::binary);
  for (std::string line; std::getline(stream, line) && line.substr(0, 10) != "end_header";)
  {
  }
  PointSet points;
  for (float p[3]; stream.read(reinterpret_cast<char*>(p), sizeof p);)
  {
    points.emplace_back(p[0], p[1], p[2]);
  }
  return points;
}

const PointSet& pointSet(int number)
{
  static const PointSet sets[] = { demoPoints("kitten.xyz").value_or(PointSet()),
    randomTorus(1.0, 0.4, 20000, 1),
    []
    {
      const auto mesh = demoMesh("elephant.off");
      return mesh ? randomSurfacePoints(*mesh, 20000, 1) : PointSet();
    }(),
    igea() };
  return sets[number];
}

constexpr const char* kNames[] = { "kitten", "torus 20k", "elephant 20k", "igea" };

std::vector<Kernel::Point_3> forCgal(const PointSet& points)
{
  std::vector<Kernel::Point_3> copies(points.size());
  std::transform(points.begin(), points.end(), copies.begin(),
    [](const Vec3& p) { return Kernel::Point_3(p.x(), p.y(), p.z()); });
  return copies;
}

template <typename Work>
void measure(benchmark::State& state, const Work& work)
{
  const PointSet& points = pointSet(static_cast<int>(state.range(0)));
  state.SetLabel(kNames[state.range(0)]);
  if (points.empty())
  {
    state.SkipWithError("not here: needs libcgal-demo, or ../shared/data");
    return;
  }
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(work(points));
  }
  state.SetItemsProcessed(
    static_cast<std::int64_t>(state.iterations()) * static_cast<std::int64_t>(points.size()));
}

void convection(benchmark::State& state)
{
  measure(state, [](const PointSet& points) { return reconstruct(points).mesh.triangles.size(); });
}

// At the level of detail of Figure 3 of [HT]: 31,126 of 134,344 points.
void levelOfDetail(benchmark::State& state)
{
  measure(state,
    [](const PointSet& points)
    {
      const LevelOfDetail detail{ 0.0, points.size() * 31126 / 134344 };
      return reconstruct(points, detail).mesh.triangles.size();
    });
}

std::size_t verticesOf(const PointSet& points, double share)
{
  return static_cast<std::size_t>(share * static_cast<double>(points.size()));
}

constexpr double kCoarse = 31126.0 / 134344.0;
constexpr double kFine = 45000.0 / 134344.0;

// What a change of the level from one share of the points to another takes, the way back not
// counted.
void relevel(benchmark::State& state, double from, double to)
{
  const PointSet& points = pointSet(static_cast<int>(state.range(0)));
  state.SetLabel(kNames[state.range(0)]);
  if (points.empty())
  {
    state.SkipWithError("not here: needs libcgal-demo, or ../shared/data");
    return;
  }
  DynamicReconstruction kept(points);
  for (const double share : { std::min(from, to), from })
  {
    kept.update({ 0.0, verticesOf(points, share) });
  }
  for (auto _ : state)
  {
    kept.update({ 0.0, verticesOf(points, to) });
    state.PauseTiming();
    kept.update({ 0.0, verticesOf(points, from) });
    state.ResumeTiming();
  }
}

void finerLevel(benchmark::State& state)
{
  relevel(state, kCoarse, kFine);
}

void coarserLevel(benchmark::State& state)
{
  relevel(state, kFine, kCoarse);
}

// To set beside it.
void freshFineLevel(benchmark::State& state)
{
  measure(state,
    [](const PointSet& points)
    {
      const LevelOfDetail detail{ 0.0, verticesOf(points, kFine) };
      return reconstruct(points, detail).mesh.triangles.size();
    });
}

// Every point within 0.3 % of the diagonal.
void tolerance(benchmark::State& state)
{
  measure(state,
    [](const PointSet& points)
    {
      Box3 box;
      for (const Vec3& p : points)
      {
        box.extend(p);
      }
      const LevelOfDetail detail{ 0.003 * box.diagonal().norm(), 0 };
      return reconstruct(points, detail).mesh.triangles.size();
    });
}

void cgalDelaunay(benchmark::State& state)
{
  measure(state,
    [](const PointSet& points)
    {
      const auto sites = forCgal(points);
      return CGAL::Delaunay_triangulation_3<Kernel>(sites.begin(), sites.end())
        .number_of_finite_cells();
    });
}

void cgalAdvancingFront(benchmark::State& state)
{
  measure(state,
    [](const PointSet& points)
    {
      const auto sites = forCgal(points);
      std::vector<std::array<std::size_t, 3>> triangles;
      CGAL::advancing_front_surface_reconstruction(
        sites.begin(), sites.end(), std::back_inserter(triangles));
      return triangles.size();
    });
}

void allSets(benchmark::internal::Benchmark* timing)
{
  timing->DenseRange(0, 3)->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK(cgalDelaunay)->Apply(allSets);
BENCHMARK(cgalAdvancingFront)->Apply(allSets);
BENCHMARK(convection)->Apply(allSets);
BENCHMARK(levelOfDetail)->Apply(allSets);
BENCHMARK(freshFineLevel)->Apply(allSets);
BENCHMARK(finerLevel)->Apply(allSets);
BENCHMARK(coarserLevel)->Apply(allSets);
BENCHMARK(tolerance)->Apply(allSets);

} // namespace

BENCHMARK_MAIN();
