// SPDX-License-Identifier: BSD-3-Clause
// Table of docs/reconstruction.md: surfaces of real and sampled point sets, ours beside CGAL's
// advancing front, scale space and Poisson.
//
//   ReconstructionTable > table.md
//
// Each method runs on each set in a process of its own, so that its peak of memory is its own; all
// of them one after the other. Distances are in 1/1000 of the diagonal: the greatest, both ways
// between the surface and the mesh that the points were drawn from, and the mean from the mesh to
// the surface; where only points are known, from these. Sets whose files are absent are left out.

#include "benchmarks/support/PeerReconstructions.h"
#include "core/mesh/MeshChecks.h"
#include "core/mesh/MeshDistance.h"
#include "reconstruction/Convection.h"
#include "tests/reconstruction/DemoPoints.h"
#include "tests/reconstruction/Samples.h"
#include "tests/support/TestMeshes.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <functional>
#include <limits>
#include <memory>

namespace
{

using namespace hybridtree;
using namespace hybridtree::benchmark;
using namespace hybridtree::test;

TriangleMesh ours(const std::vector<Vec3>& points)
{
  return reconstruct(points).mesh;
}

struct Distances
{
  double most = 0.0;
  double mean = 0.0;
};

Distances distancesTo(const TriangleMesh& mesh, const std::vector<Vec3>& points)
{
  const MeshDistance distance(std::make_shared<TriangleMesh>(mesh));
  const std::size_t count = points.size();
  std::vector<double> coordinates(3 * count);
  std::vector<double> found(count);
  std::vector<std::int32_t> nearest(count);
  std::vector<double> foot(3 * count);
  for (std::size_t k = 0; k < count; ++k)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      coordinates[axis * count + k] = points[k][static_cast<Eigen::Index>(axis)];
    }
  }
  const double* at = coordinates.data();
  distance.nearest({ at, at + count, at + 2 * count, count },
    std::numeric_limits<double>::infinity(), found.data(), nearest.data(),
    { foot.data(), foot.data() + count, foot.data() + 2 * count });
  Distances result;
  for (const double d : found)
  {
    result.most = std::max(result.most, d);
    result.mean += d / double(count);
  }
  return result;
}

struct PointSet
{
  std::string name;
  std::vector<Vec3> points;
  std::optional<TriangleMesh> source;
};

Distances compare(const TriangleMesh& mesh, const PointSet& set)
{
  Box3 box;
  for (const Vec3& p : set.points)
  {
    box.extend(p);
  }
  Distances result =
    distancesTo(mesh, set.source ? randomSurfacePoints(*set.source, 50000, 99) : set.points);
  if (set.source)
  {
    const double back = distancesTo(*set.source, randomSurfacePoints(mesh, 50000, 98)).most;
    result.most = std::max(result.most, back);
  }
  const double diagonal = box.diagonal().norm();
  return { result.most / diagonal, result.mean / diagonal };
}

using Method = TriangleMesh (*)(const std::vector<Vec3>&);

void writeRow(const PointSet& set, const char* name, Method method)
{
  const auto start = std::chrono::steady_clock::now();
  const TriangleMesh mesh = method(set.points);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const MeshReport report = checkMesh(mesh);
  const Distances distances = compare(mesh, set);
  std::printf("| %s | %zu | %s | %.2f | %.0f | %zu | %s | %s | %.2f | %.3f |\n", set.name.c_str(),
    set.points.size(), name, time.count(), double(usage.ru_maxrss) / 1024.0, report.points,
    report.closedManifold() ? "yes" : "no",
    report.closedManifold()
      ? (std::to_string(report.genus()) + " in " + std::to_string(report.components)).c_str()
      : "-",
    1000.0 * distances.most, 1000.0 * distances.mean);
  std::fflush(stdout);
}

void run(const PointSet& set, const char* name, Method method)
{
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0)
  {
    writeRow(set, name, method);
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
  {
    std::printf(
      "| %s | %zu | %s | failed | | | | | | |\n", set.name.c_str(), set.points.size(), name);
  }
}

std::vector<PointSet> pointSets()
{
  std::vector<PointSet> sets;
  for (const char* name : { "elephant.off", "armadillo.off", "bunny00.off", "bear.off", "eight.off",
         "anchor.off", "hand.off", "cow.off" })
  {
    if (const auto mesh = demoMesh(name))
    {
      sets.push_back({ name, randomSurfacePoints(*mesh, 20000, 1), mesh });
    }
  }
  for (const char* name : { "kitten.xyz", "oni.pwn", "sphere_20k.xyz", "blobby.xyz" })
  {
    if (const auto points = demoPoints(name))
    {
      sets.push_back({ name, *points, std::nullopt });
    }
  }
  return sets;
}

} // namespace

int main()
{
  std::printf("| set | points | method | s | MiB | vertices | closed | genus | greatest | mean |\n"
              "|---|---|---|---|---|---|---|---|---|---|\n");
  for (const PointSet& set : pointSets())
  {
    run(set, "ours", ours);
    run(set, "advancing front", advancingFront);
    run(set, "scale space", scaleSpace);
    run(set, "Poisson", poisson);
  }
  return 0;
}
