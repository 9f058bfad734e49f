// SPDX-License-Identifier: BSD-3-Clause
// Distance to real scans beside Embree's point queries ([HT] Fig. 7): 100^3 lattice points in the
// unit box, for several radii of influence; scattered single points; building the hierarchy. Then,
// by fewer points, CGAL's AABB tree and vtkImplicitPolyDataDistance; and ours on two threads.
// One thread but for that; in random order, medians; times are per point, those of a build whole.

#include "benchmarks/support/BenchmarkMesh.h"
#include "benchmarks/support/EmbreeDistance.h"
#include "benchmarks/support/PeerDistances.h"
#include "benchmarks/support/RatioReporter.h"
#include "core/base/Parallel.h"
#include "core/mesh/MeshBvh.h"
#include "core/mesh/MeshDistance.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace
{

using namespace hybridtree;
using hybridtree::benchmark::EmbreeDistance;
using Distance = std::function<void(PointBatch, double*)>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kEvery = 199; // lattice point for the slower peers

struct Cloud
{
  std::vector<double> x, y, z;
  PointBatch batch() const { return { x.data(), y.data(), z.data(), x.size() }; }
};

Cloud lattice(const Box3& box, int side)
{
  Cloud cloud;
  for (int k = 0; k < side * side * side; ++k)
  {
    cloud.x.push_back(box.min().x() + box.sizes().x() * (k % side) / (side - 1));
    cloud.y.push_back(box.min().y() + box.sizes().y() * (k / side % side) / (side - 1));
    cloud.z.push_back(box.min().z() + box.sizes().z() * (k / side / side) / (side - 1));
  }
  return cloud;
}

Cloud scattered(const Box3& box, int count)
{
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Cloud cloud;
  for (int k = 0; k < count; ++k)
  {
    cloud.x.push_back(box.min().x() + box.sizes().x() * unit(random));
    cloud.y.push_back(box.min().y() + box.sizes().y() * unit(random));
    cloud.z.push_back(box.min().z() + box.sizes().z() * unit(random));
  }
  return cloud;
}

struct Scan
{
  Scan(const char* nameOfIt, MeshPtr meshOfIt)
    : name(nameOfIt)
    , mesh(std::move(meshOfIt))
    , ours(mesh)
    , grid(lattice(mesh->bounds(), 100))
    , cloud(scattered(mesh->bounds(), 100000))
  {
    for (std::size_t k = 0; k < grid.x.size(); k += kEvery)
    {
      few.x.push_back(grid.x[k]);
      few.y.push_back(grid.y[k]);
      few.z.push_back(grid.z[k]);
    }
  }

  std::string name;
  MeshPtr mesh;
  MeshDistance ours;
  Cloud grid;
  Cloud cloud;
  Cloud few; // of the grid
};

// Once per call of the benchmark, outside of the time: what prepares, and gives what is timed.
// An Embree device caps oneTBB's threads for the whole process as long as it lives; so it lives
// within one benchmark.
using Prepare = std::function<std::function<void()>()>;

void add(benchmarks::RatioReporter& reporter, const std::string& name, double points,
  const Prepare& prepare, int threads = 1)
{
  reporter.list(name);
  ::benchmark::RegisterBenchmark(name.c_str(),
    [=](::benchmark::State& state)
    {
      setThreadCount(threads);
      const std::function<void()> work = prepare();
      for (auto _ : state)
      {
        const auto start = std::chrono::steady_clock::now();
        work();
        const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
        state.SetIterationTime(time.count() / points);
      }
    })
    ->Unit(points > 1.0 ? ::benchmark::kMicrosecond : ::benchmark::kMillisecond)
    ->UseManualTime()
    ->Iterations(1);
}

// Distances of a batch, `all` points of it or one after the other.
Prepare queries(PointBatch points, bool oneByOne, const std::function<Distance()>& make)
{
  return [=]() -> std::function<void()>
  {
    return [=, distance = make(), values = std::vector<double>(points.size)]() mutable
    {
      for (std::size_t k = 0; oneByOne && k < points.size; ++k)
      {
        distance(points.slice(k, 1), &values[k]);
      }
      if (!oneByOne)
      {
        distance(points, values.data());
      }
      ::benchmark::DoNotOptimize(values.data());
    };
  };
}

std::function<Distance()> oursWithin(const Scan& scan, double radius)
{
  return [&scan, radius]() -> Distance
  {
    return [&scan, radius](PointBatch points, double* distance)
    { scan.ours.distance(points, radius, distance); };
  };
}

std::function<Distance()> embreeWithin(const Scan& scan, double radius)
{
  return [&scan, radius]() -> Distance
  {
    auto peer = std::make_shared<EmbreeDistance>(*scan.mesh, 1);
    peer->build();
    return [peer, radius](PointBatch points, double* distance)
    { peer->distance(points, radius, distance); };
  };
}

// Largest difference of ours from a peer's; where only one is finite, of that from the radius.
double difference(const Distance& ours, const Distance& theirs, PointBatch points, double radius)
{
  std::vector<double> mine(points.size), other(points.size);
  ours(points, mine.data());
  theirs(points, other.data());
  double worst = 0.0;
  for (std::size_t k = 0; k < points.size; ++k)
  {
    const double a = std::abs(mine[k]);
    const double b = std::abs(other[k]);
    const bool both = std::isfinite(a) && std::isfinite(b);
    worst = std::max(worst,
      both       ? std::abs(a - b)
        : a == b ? 0.0
                 : std::abs((std::isfinite(a) ? a : b) - radius));
  }
  return worst;
}

void addQueries(benchmarks::RatioReporter& reporter, const Scan& scan, const std::string& what,
  const Cloud& cloud, double radius, bool oneByOne)
{
  const std::string name = scan.name + ", " + what;
  const auto points = static_cast<double>(cloud.x.size());
  const auto ours = oursWithin(scan, radius);
  const auto embree = embreeWithin(scan, radius);
  std::printf("%s: largest difference from Embree %.1e\n", name.c_str(),
    difference(ours(), embree(), cloud.batch(), radius));
  add(reporter, name + "/HybridTree", points, queries(cloud.batch(), oneByOne, ours));
  add(reporter, name + "/Embree", points, queries(cloud.batch(), false, embree));
}

// Ours has the whole lattice, as its users do.
void addSlowerPeers(benchmarks::RatioReporter& reporter, const Scan& scan)
{
  const std::string name = scan.name + ", beside the slower ones";
  const auto points = static_cast<double>(scan.grid.x.size());
  const auto ours = oursWithin(scan, kInfinity);
  add(reporter, name + "/HybridTree", points, queries(scan.grid.batch(), false, ours));
  add(
    reporter, name + "/HybridTree, 2 threads", points, queries(scan.grid.batch(), false, ours), 2);
  const struct
  {
    const char* name;
    Distance distance;
  } peers[] = { { "CGAL", hybridtree::benchmark::cgalDistance(*scan.mesh) },
    { "VTK", hybridtree::benchmark::vtkDistance(*scan.mesh) } };
  for (const auto& peer : peers)
  {
    std::printf("%s: largest difference from %s %.1e\n", name.c_str(), peer.name,
      difference(ours(), peer.distance, scan.few.batch(), kInfinity));
    add(reporter, name + "/" + peer.name, static_cast<double>(scan.few.x.size()),
      queries(scan.few.batch(), false, [distance = peer.distance] { return distance; }));
  }
}

void addAll(benchmarks::RatioReporter& reporter, const Scan& scan)
{
  std::printf("%s: %zu triangles\n", scan.name.c_str(), scan.mesh->triangles.size());
  const auto buildOurs = [&scan]() -> std::function<void()>
  { return [&scan] { const MeshBvh bvh(*scan.mesh); }; };
  const auto buildEmbree = [&scan]() -> std::function<void()>
  { return [peer = std::make_shared<EmbreeDistance>(*scan.mesh, 1)] { peer->build(); }; };
  add(reporter, scan.name + ", build/HybridTree", 1.0, buildOurs);
  add(reporter, scan.name + ", build/Embree", 1.0, buildEmbree);
  addQueries(reporter, scan, "100^3 unbounded", scan.grid, kInfinity, false);
  addQueries(reporter, scan, "100^3 R = 0.05", scan.grid, 0.05, false);
  addQueries(reporter, scan, "100^3 R = 0.1", scan.grid, 0.1, false);
  addQueries(reporter, scan, "100^3 R = 0.25", scan.grid, 0.25, false);
  addQueries(reporter, scan, "scattered in one batch", scan.cloud, kInfinity, false);
  addQueries(reporter, scan, "scattered in one call each", scan.cloud, kInfinity, true);
  addSlowerPeers(reporter, scan);
}

} // namespace

int main(int argc, char** argv)
{
  benchmarks::initializeInterleaved(argc, argv, 3);
  setThreadCount(1);
  benchmarks::RatioReporter reporter(false);
  const Scan bunny("Bunny", hybridtree::benchmark::benchmarkMesh("stanford_bunny.obj", 69451));
  const Scan igea("Igea", hybridtree::benchmark::benchmarkMesh("igea.ply", 268686));
  addAll(reporter, bunny);
  addAll(reporter, igea);
  ::benchmark::RunSpecifiedBenchmarks(&reporter);
  reporter.print();
  return 0;
}
