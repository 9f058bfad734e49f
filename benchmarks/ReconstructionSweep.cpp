// SPDX-License-Identifier: BSD-3-Clause
// How often reconstruction finds the topology of a surface again: points are drawn at random from
// every closed mesh given, several times, and components and handles counted.
//
//   ReconstructionSweep [-n points, default 20000] [-s seeds, default 3] [-f first seed, default 1]
//     [-p 1] mesh.off ...
//
// With -p 1 CGAL's advancing front, scale space and Poisson go over the same points, each in a
// process of its own that has ten minutes.
//
// Meshes that are open, or no 2-manifold, are named and left out of the count. In Debian, meshes
// come with libcgal-demo:
//   tar -xzf /usr/share/doc/libcgal-dev/data.tar.gz && ReconstructionSweep data/meshes/*.off
//
// Beside each mesh stands how fine it is against the sampling: the share of the points behind which
// (thin) or before which (gap) the opposite side of the surface is nearer than two mean distances
// between points. Such places may be beyond what the points tell.

#include "benchmarks/support/OffFile.h"
#include "benchmarks/support/PeerReconstructions.h"
#include "core/mesh/MeshChecks.h"
#include "core/mesh/RepairMesh.h"
#include "reconstruction/Convection.h"
#include "tests/reconstruction/Samples.h"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <string>

namespace
{

using namespace hybridtree;
using namespace hybridtree::benchmark;
using namespace hybridtree::test;

// Distance along a ray to the next triangle that faces against its origin's normal.
double oppositeSide(
  const TriangleMesh& mesh, const Vec3& origin, const Vec3& direction, double most)
{
  double nearest = most;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const Vec3& a = mesh.points[mesh.triangles[t][0]];
    const Vec3 u = mesh.points[mesh.triangles[t][1]] - a;
    const Vec3 v = mesh.points[mesh.triangles[t][2]] - a;
    const Vec3 p = direction.cross(v);
    const double det = u.dot(p);
    if (std::abs(det) < 0.7 * u.cross(v).norm()) // not opposite: the far side of an edge
    {
      continue;
    }
    const Vec3 s = origin - a;
    const double x = s.dot(p) / det;
    const Vec3 q = s.cross(u);
    const double y = direction.dot(q) / det;
    const double distance = v.dot(q) / det;
    if (x >= 0.0 && y >= 0.0 && x + y <= 1.0 && distance > 1e-6 * most)
    {
      nearest = std::min(nearest, distance);
    }
  }
  return nearest;
}

struct Fineness
{
  double thin = 0.0;
  double gap = 0.0;
};

Fineness finenessOf(const TriangleMesh& mesh, std::size_t samples)
{
  double area = 0.0;
  std::vector<double> sums;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    sums.push_back(area += 0.5 * areaNormal(mesh, t).norm());
  }
  const double reach = 2.0 * std::sqrt(area / double(samples));
  Random random(1);
  Fineness fineness;
  constexpr int kRays = 400;
  for (int k = 0; k < kRays; ++k)
  {
    const auto at = std::upper_bound(sums.begin(), sums.end() - 1, random.uniform(0.0, area));
    const auto t = std::size_t(at - sums.begin());
    const Triangle& v = mesh.triangles[t];
    const Vec3 normal = areaNormal(mesh, t).normalized();
    const Vec3 from = (mesh.points[v[0]] + mesh.points[v[1]] + mesh.points[v[2]]) / 3.0;
    fineness.thin += (oppositeSide(mesh, from, -normal, reach) < reach) / double(kRays);
    fineness.gap += (oppositeSide(mesh, from, normal, reach) < reach) / double(kRays);
  }
  return fineness;
}

struct Method
{
  const char* name;
  TriangleMesh (*reconstruct)(const std::vector<Vec3>&);
};

TriangleMesh ours(const std::vector<Vec3>& points)
{
  return reconstruct(points).mesh;
}

constexpr std::array<Method, 4> kMethods{ { { "ours", ours }, { "advancing front", advancingFront },
  { "scale space", scaleSpace }, { "Poisson", poisson } } };

struct Trial
{
  bool done = false;
  bool closed = false; // and a manifold
  std::int64_t genus = 0;
  std::size_t components = 0;
  double seconds = 0.0;
};

Trial tryMethod(const Method& method, const std::vector<Vec3>& points)
{
  const auto start = std::chrono::steady_clock::now();
  const TriangleMesh mesh = method.reconstruct(points);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  const MeshReport report = checkMesh(mesh);
  const bool closed = report.closedManifold() && report.components > 0;
  return { true, closed, closed ? report.genus() : 0, report.components, time.count() };
}

// In a process of its own, that may fail, and is stopped after ten minutes.
Trial tryApart(const Method& method, const std::vector<Vec3>& points)
{
  constexpr unsigned kMost = 600;
  int ends[2];
  if (pipe(ends) != 0)
  {
    return {};
  }
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0)
  {
    alarm(kMost);
    const Trial trial = tryMethod(method, points);
    _exit(write(ends[1], &trial, sizeof trial) == sizeof trial ? 0 : 1);
  }
  close(ends[1]);
  Trial trial;
  trial = read(ends[0], &trial, sizeof trial) == sizeof trial ? trial : Trial();
  close(ends[0]);
  waitpid(child, nullptr, 0);
  return trial;
}

struct Tally
{
  int meshes = 0;
  int faithfulMeshes = 0;
  int runs = 0;
  int closed = 0;
  int faithful = 0;
  double longest = 0.0;
  double seconds = 0.0;

  bool add(const Trial& trial, const MeshReport& wanted)
  {
    const bool right =
      trial.closed && trial.genus == wanted.genus() && trial.components == wanted.components;
    ++runs;
    closed += trial.closed;
    faithful += right;
    longest = std::max(longest, trial.seconds);
    seconds += trial.seconds;
    if (right)
    {
      std::printf(" ok");
    }
    else if (!trial.done)
    {
      std::printf(" failed");
    }
    else
    {
      std::printf(" %lld in %zu%s", static_cast<long long>(trial.genus), trial.components,
        trial.closed ? "" : " NOT CLOSED");
    }
    return right;
  }
};

using Tallies = std::array<Tally, kMethods.size()>;

void sweep(const std::string& file, const TriangleMesh& mesh, std::size_t count, int firstSeed,
  int seeds, bool peers, Tallies& tallies)
{
  const MeshReport wanted = checkMesh(mesh);
  const Fineness fineness = finenessOf(mesh, count);
  std::printf("%-28s genus %2lld in %zu; thin %3.0f%%, gap %3.0f%%",
    file.substr(file.rfind('/') + 1).c_str(), static_cast<long long>(wanted.genus()),
    wanted.components, 100.0 * fineness.thin, 100.0 * fineness.gap);
  for (std::size_t k = 0; k < (peers ? kMethods.size() : 1); ++k)
  {
    std::printf(" |");
    bool all = true;
    for (int seed = firstSeed; seed < firstSeed + seeds; ++seed)
    {
      const std::vector<Vec3> points = randomSurfacePoints(mesh, count, std::uint64_t(seed));
      const Trial trial = peers ? tryApart(kMethods[k], points) : tryMethod(kMethods[k], points);
      all = tallies[k].add(trial, wanted) && all;
      std::fflush(stdout);
    }
    ++tallies[k].meshes;
    tallies[k].faithfulMeshes += all;
  }
  std::printf("\n");
}

void printTallies(const Tallies& tallies)
{
  for (std::size_t k = 0; k < tallies.size() && tallies[k].runs > 0; ++k)
  {
    const Tally& tally = tallies[k];
    std::printf(
      "%s: %d of %d runs have components and genus of the mesh, %d are closed "
      "2-manifolds; all seeds right on %d of %d meshes; slowest %.2f s, together %.1f s\n",
      kMethods[k].name, tally.faithful, tally.runs, tally.closed, tally.faithfulMeshes,
      tally.meshes, tally.longest, tally.seconds);
  }
}

} // namespace

int main(int argc, char** argv)
{
  std::size_t count = 20000;
  int seeds = 3;
  int firstSeed = 1;
  bool peers = false;
  Tallies tallies;
  for (int k = 1; k < argc; ++k)
  {
    if (argv[k][0] == '-' && k + 1 < argc)
    {
      const int value = std::atoi(argv[k + 1]);
      switch (argv[k++][1])
      {
        case 'n':
          count = std::size_t(value);
          break;
        case 's':
          seeds = value;
          break;
        case 'p':
          peers = value != 0;
          break;
        default:
          firstSeed = value;
      }
      continue;
    }
    const std::unique_ptr<TriangleMesh> read = readOff(argv[k]);
    if (!read || read->empty())
    {
      std::printf("%s: not read\n", argv[k]);
      continue;
    }
    const RepairedMesh repaired = repairMesh(read->points, read->triangles);
    const MeshReport report = checkMesh(*repaired.mesh);
    if (!report.closedManifold())
    {
      std::printf("%s: left out, %s\n", argv[k], report.describe().c_str());
      continue;
    }
    sweep(argv[k], *repaired.mesh, count, firstSeed, seeds, peers, tallies);
  }
  printTallies(tallies);
  return 0;
}
