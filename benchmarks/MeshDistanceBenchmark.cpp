// SPDX-License-Identifier: BSD-3-Clause
// Distance to real scans beside Embree's point queries ([HT] Fig. 7): 100^3 lattice points in the
// unit box, for several radii of influence; scattered single points; building the hierarchy. Both
// sides run one after the other in one process, each the median of a few rounds, on the same
// threads. Then on one thread, by fewer points, CGAL's AABB tree and vtkImplicitPolyDataDistance;
// and ours on two threads beside one.
//
//   MeshDistanceBenchmark [threads, default 1] [rounds, default 3]

#include "benchmarks/support/BenchmarkMesh.h"
#include "benchmarks/support/EmbreeDistance.h"
#include "benchmarks/support/PeerDistances.h"
#include "core/base/Parallel.h"
#include "core/mesh/MeshBvh.h"
#include "core/mesh/MeshDistance.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace
{

using namespace hybridtree;
using benchmark::EmbreeDistance;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
int rounds = 3;

template <typename Work>
double seconds(const Work& work)
{
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> times)
{
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

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

void report(const std::string& what, double ours, double peer, double count, double worst,
  const char* peerName = "Embree")
{
  std::printf("  %-34s ours %9.3f us  %s %9.3f us  ratio %6.2f", what.c_str(), 1e6 * ours / count,
    peerName, 1e6 * peer / count, peer / ours);
  if (worst >= 0.0)
  {
    std::printf("  largest difference %.1e", worst);
  }
  std::printf("\n");
  std::fflush(stdout);
}

void queries(const std::string& what, const MeshDistance& ours, const EmbreeDistance& peer,
  PointBatch points, double radius, bool oneByOne)
{
  std::vector<double> mine(points.size), theirs(points.size), myTimes, theirTimes;
  for (int round = 0; round < rounds; ++round)
  {
    myTimes.push_back(seconds(
      [&]
      {
        for (std::size_t k = 0; oneByOne && k < points.size; ++k)
        {
          ours.distance(points.slice(k, 1), radius, &mine[k]);
        }
        if (!oneByOne)
        {
          ours.distance(points, radius, mine.data());
        }
      }));
    theirTimes.push_back(seconds([&] { peer.distance(points, radius, theirs.data()); }));
  }
  double worst = 0.0;
  for (std::size_t k = 0; k < points.size; ++k)
  {
    const bool both = std::isfinite(mine[k]) && std::isfinite(theirs[k]);
    const double beyond = std::isfinite(mine[k]) ? mine[k] : theirs[k];
    worst = std::max(worst,
      both                     ? std::abs(mine[k] - theirs[k])
        : mine[k] == theirs[k] ? 0.0
                               : std::abs(beyond - radius)); // one of them at the rim
  }
  report(what, median(myTimes), median(theirTimes), double(points.size), worst);
}

// Every 199th lattice point for the slower peers; ours has the whole lattice, as its users do.
void slowerPeers(const MeshDistance& ours, PointBatch points)
{
  Cloud few;
  for (std::size_t k = 0; k < points.size; k += 199)
  {
    few.x.push_back(points.x[k]);
    few.y.push_back(points.y[k]);
    few.z.push_back(points.z[k]);
  }
  std::vector<double> mine(points.size), theirs(few.x.size());
  const struct
  {
    const char* name;
    hybridtree::benchmark::PeerDistance distance;
  } peers[] = { { "CGAL", hybridtree::benchmark::cgalDistance(*ours.mesh()) },
    { "VTK", hybridtree::benchmark::vtkDistance(*ours.mesh()) } };
  hybridtree::setThreadCount(1);
  for (const auto& peer : peers)
  {
    std::vector<double> myTimes, theirTimes;
    for (int round = 0; round < rounds; ++round)
    {
      myTimes.push_back(seconds([&] { ours.distance(points, kInfinity, mine.data()); }));
      theirTimes.push_back(seconds([&] { peer.distance(few.batch(), theirs.data()); }));
    }
    double worst = 0.0;
    for (std::size_t k = 0; k < theirs.size(); ++k)
    {
      worst = std::max(worst, std::abs(std::abs(theirs[k]) - mine[199 * k]));
    }
    const double perPoint = double(points.size) / double(few.x.size());
    report("unbounded, 1 thread", median(myTimes), perPoint * median(theirTimes),
      double(points.size), worst, peer.name);
  }
}

void twoThreads(const MeshDistance& ours, PointBatch points)
{
  std::vector<double> distance(points.size), times[2];
  for (int round = 0; round < rounds; ++round)
  {
    for (int threads = 1; threads <= 2; ++threads)
    {
      hybridtree::setThreadCount(threads);
      times[threads - 1].push_back(
        seconds([&] { ours.distance(points, kInfinity, distance.data()); }));
    }
  }
  report("unbounded, 2 threads", median(times[1]), median(times[0]), double(points.size), -1.0,
    "1 thread");
}

void compare(const char* name, const std::string& file, std::size_t triangles, int threads)
{
  const MeshPtr mesh = hybridtree::benchmark::benchmarkMesh(file, triangles);
  std::printf("%s: %zu triangles, %d thread%s\n", name, mesh->triangles.size(), threads,
    threads == 1 ? "" : "s");
  const MeshDistance ours(mesh);
  const Cloud grid = lattice(mesh->bounds(), 100);
  // First: an Embree device caps oneTBB's threads for the whole process as long as it lives.
  twoThreads(ours, grid.batch());
  hybridtree::setThreadCount(threads);
  EmbreeDistance peer(*mesh, threads);
  std::vector<double> myBuild, theirBuild;
  for (int round = 0; round < rounds; ++round)
  {
    myBuild.push_back(seconds([&] { const MeshBvh bvh(*mesh); }));
    theirBuild.push_back(seconds([&] { peer.build(); }));
  }
  report("build, whole", median(myBuild), median(theirBuild), 1.0, -1.0);

  queries("100^3, unbounded", ours, peer, grid.batch(), kInfinity, false);
  for (const double radius : { 0.05, 0.1, 0.25 })
  {
    char what[40];
    std::snprintf(what, sizeof what, "100^3, R = %.2f", radius);
    queries(what, ours, peer, grid.batch(), radius, false);
  }
  const Cloud cloud = scattered(mesh->bounds(), 100000);
  queries("scattered, one batch", ours, peer, cloud.batch(), kInfinity, false);
  queries("scattered, one call each", ours, peer, cloud.batch(), kInfinity, true);
  slowerPeers(ours, grid.batch());
}

} // namespace

int main(int argc, char** argv)
{
  const int threads = argc > 1 ? std::max(1, std::atoi(argv[1])) : 1;
  rounds = argc > 2 ? std::max(1, std::atoi(argv[2])) : 3;
  hybridtree::setThreadCount(threads);
  compare("Bunny", "stanford_bunny.obj", 69451, threads);
  compare("Igea", "igea.ply", 268686, threads);
  return 0;
}
