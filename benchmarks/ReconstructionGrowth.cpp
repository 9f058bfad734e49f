// SPDX-License-Identifier: BSD-3-Clause
// How time and memory of reconstruction grow with the number of points: a sphere with smooth bumps
// and noise, from 10^4 to 2*10^6 points. One row of a table for each size and way: at a level of
// detail (50,000 vertices, or a quarter of the points), with all points (to 10^6), and CGAL's bare
// Delaunay tetrahedralization of all points beside them. Every run is a process of its own, so that
// its peak of memory is its own.
//
//   ReconstructionGrowth FILE.csv [most points, default 2000000]
//   plots/growth.py FILE.csv ../docs/images/reconstruction-growth.svg

#include "core/mesh/MeshChecks.h"
#include "reconstruction/LevelOfDetail.h"
#include "tests/support/Random.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace
{

using namespace hybridtree;

constexpr std::size_t kMostForAll = 1000000;
constexpr double kNoise = 2e-4;

std::vector<Vec3> bumpySphere(std::size_t count)
{
  test::Random random(1);
  std::vector<Vec3> points(count);
  for (Vec3& p : points)
  {
    const Vec3 u = random.direction();
    const double bumps = std::sin(7.0 * u.x()) * std::sin(6.0 * u.y()) * std::sin(5.0 * u.z());
    p = (1.0 + 0.15 * bumps + kNoise * random.uniform(-1.0, 1.0)) * u;
  }
  return points;
}

struct Outcome
{
  std::size_t vertices = 0;
  bool closed = false;
  std::int64_t genus = -1;
};

Outcome outcomeOf(const ReconstructedSurface& surface)
{
  const MeshReport report = checkMesh(surface.mesh);
  return { surface.mesh.points.size(), report.closedManifold(), report.genus() };
}

std::size_t cgalVertices(const std::vector<Vec3>& points)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_3> sites;
  std::transform(points.begin(), points.end(), std::back_inserter(sites),
    [](const Vec3& p) { return Kernel::Point_3(p.x(), p.y(), p.z()); });
  return CGAL::Delaunay_triangulation_3<Kernel>(sites.begin(), sites.end()).number_of_vertices();
}

double cpuSeconds()
{
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// In the process that runs it: one row, all but the memory.
void runHere(const std::string& way, std::size_t count, std::FILE* table)
{
  using Clock = std::chrono::steady_clock;
  const std::vector<Vec3> points = bumpySphere(count);
  const double cpu = cpuSeconds();
  const auto begin = Clock::now();
  ReconstructedSurface surface;
  Outcome outcome;
  if (way == "level")
  {
    LevelOfDetail detail;
    detail.vertices = std::min<std::size_t>(50000, count / 4);
    surface = reconstruct(points, detail);
  }
  else if (way == "all")
  {
    surface = reconstruct(points);
  }
  else
  {
    outcome.vertices = cgalVertices(points);
  }
  const double wall = std::chrono::duration<double>(Clock::now() - begin).count();
  const double used = cpuSeconds() - cpu;
  if (way != "cgal")
  {
    outcome = outcomeOf(surface);
  }
  std::fprintf(table, "%s,%zu,%.3f,%.3f,%zu,%d,%d,", way.c_str(), count, wall, used,
    outcome.vertices, int(outcome.closed), int(outcome.genus));
}

void run(const std::string& way, std::size_t count, std::FILE* table)
{
  std::fflush(table);
  const pid_t child = fork();
  if (child == 0)
  {
    runHere(way, count, table);
    std::fflush(table);
    _exit(0);
  }
  rusage usage;
  int status = 0;
  wait4(child, &status, 0, &usage);
  std::fprintf(table, "%.0f\n", double(usage.ru_maxrss) / 1024.0);
  std::printf("%s of %zu points: exit %d\n", way.c_str(), count, status);
  std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv)
{
  std::FILE* table = argc > 1 ? std::fopen(argv[1], "w") : nullptr;
  if (!table)
  {
    std::fprintf(stderr, "ReconstructionGrowth FILE.csv [most points]\n");
    return 1;
  }
  const std::size_t most = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 2000000;
  std::fprintf(table, "way,points,seconds,cpu,vertices,closed,genus,peakMiB\n");
  for (const std::size_t count : { 10000u, 30000u, 100000u, 300000u, 1000000u, 2000000u })
  {
    for (const char* way : { "level", "cgal", "all" })
    {
      if (count <= most && (count <= kMostForAll || std::string(way) == "level"))
      {
        run(way, count, table);
      }
    }
  }
  std::fclose(table);
  return 0;
}
