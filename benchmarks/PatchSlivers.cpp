// SPDX-License-Identifier: BSD-3-Clause
// How well shaped the new triangles of local blends are where the mesh is coarse: a point
// primitive, a sixth of the mesh wide, is blended on or carved out at the middle of a random
// triangle, with edges of 1/60 of the mesh, four times per mesh. Prints per mesh how many of the
// new triangles have an angle below 10 degrees, how many of those have a side in common with a
// triangle that is kept and so cannot be split, and what is wrong (not closed, polygonized
// globally).
//
//   PatchSlivers [mesh of libcgal-demo, such as joint.off]... (default: those named below)
//   PatchSlivers edits [mesh]... (default: anchor, rotor, pinion)
//     what an edit takes, on one thread: eight points are blended on, and one is moved 20 times;
//     medians of the processor time
#include "core/base/Parallel.h"
#include "core/mesh/MeshChecks.h"
#include "core/nodes/Blend.h"
#include "core/nodes/BlendMesh.h"
#include "core/nodes/MeshNode.h"
#include "core/nodes/Primitive.h"
#include "core/skeletons/Point.h"
#include "tests/support/Random.h"
#include "tests/support/TestMeshes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace
{

using namespace hybridtree;

constexpr int kTrials = 4;
constexpr double kEdges = 60.0; // along the largest side of the mesh
constexpr double kSliver = 10.0;

struct Tally
{
  std::size_t made = 0;
  std::size_t slivers = 0;
  std::size_t sliversAtKept = 0;
  int wrong = 0;

  void add(const Tally& other)
  {
    made += other.made;
    slivers += other.slivers;
    sliversAtKept += other.sliversAtKept;
    wrong += other.wrong;
  }

  void print(const char* name) const
  {
    const auto share = [](std::size_t part, std::size_t whole)
    {
      return 100.0 * static_cast<double>(part) /
        static_cast<double>(std::max<std::size_t>(whole, 1));
    };
    std::printf(
      "%-26s %8zu new triangles, %6zu below 10 degrees (%5.2f%%), %3.0f%% of them at kept "
      "sides; %d wrong\n",
      name, made, slivers, share(slivers, made), share(sliversAtKept, slivers), wrong);
    std::fflush(stdout);
  }
};

double leastAngle(const TriangleMesh& mesh, const Triangle& c)
{
  double least = EIGEN_PI;
  for (int k = 0; k < 3; ++k)
  {
    const Vec3 a = mesh.points[c[(k + 1) % 3]] - mesh.points[c[k]];
    const Vec3 b = mesh.points[c[(k + 2) % 3]] - mesh.points[c[k]];
    least = std::min(least, std::atan2(a.cross(b).norm(), a.dot(b)));
  }
  return least * 180.0 / EIGEN_PI;
}

Tally tallyOf(const TriangleMesh& mesh, const BlendMeshReport& report)
{
  std::set<std::pair<std::int32_t, std::int32_t>> keptSides;
  for (std::size_t t = 0; t < report.keptTriangles; ++t)
  {
    const Triangle& c = mesh.triangles[t];
    for (int k = 0; k < 3; ++k)
    {
      keptSides.insert({ c[(k + 1) % 3], c[k] });
    }
  }
  Tally tally;
  tally.wrong = checkMesh(mesh).closedManifold() && report.warning.empty() ? 0 : 1;
  for (std::size_t t = report.keptTriangles; t < mesh.triangles.size(); ++t)
  {
    const Triangle& c = mesh.triangles[t];
    ++tally.made;
    if (leastAngle(mesh, c) < kSliver)
    {
      ++tally.slivers;
      tally.sliversAtKept += keptSides.count({ c[0], c[1] }) > 0 ||
        keptSides.count({ c[1], c[2] }) > 0 || keptSides.count({ c[2], c[0] }) > 0;
    }
  }
  return tally;
}

/// \param index of the trial.
Tally blendAt(const MeshPtr& mesh, const Triangle& c, int index)
{
  const double size = mesh->bounds().sizes().maxCoeff();
  const Vec3 at = (mesh->points[c[0]] + mesh->points[c[1]] + mesh->points[c[2]]) / 3.0;
  const NodePtr leaf = makeMeshNode(mesh, 1.0, size / 20.0, 2);
  const NodePtr point = makePrimitive(std::make_shared<PointSkeleton>(at),
    Potential::bySurfaceRadius(size / 12.0, size / 6.0, 2, index % 2 == 1));
  const BlendOptions options{ BlendMethod::PrimitiveBased, 1.0 };
  const NodePtr blend = makeBlend({ leaf, point }, options);
  const std::vector<BlendPart> parts{ { blend->children()[0].get(), 0 },
    { blend->children()[1].get(), 1 } };
  BlendMeshReport report;
  const TriangleMesh made = blendMesh(*blend, parts, options, size / kEdges, report);
  return tallyOf(made, report);
}

/// Outward; null and a word on it where it is not to be had.
MeshPtr closedMesh(const std::string& name)
{
  std::optional<TriangleMesh> found = test::demoMesh(name);
  if (!found || !checkMesh(*found).closedManifold())
  {
    std::printf("%-26s left out: %s\n", name.c_str(), found ? "not closed" : "not found");
    return nullptr;
  }
  if (signedVolume(*found) < 0.0) // some of them are inside out
  {
    for (Triangle& c : found->triangles)
    {
      std::swap(c[1], c[2]);
    }
  }
  return std::make_shared<const TriangleMesh>(std::move(*found));
}

bool measure(const std::string& name, Tally& all)
{
  const MeshPtr mesh = closedMesh(name);
  if (!mesh)
  {
    return false;
  }
  test::Random random(7);
  Tally tally;
  for (int trial = 0; trial < kTrials; ++trial)
  {
    const int t = random.integer(0, static_cast<int>(mesh->triangles.size()) - 1);
    tally.add(blendAt(mesh, mesh->triangles[static_cast<std::size_t>(t)], trial));
  }
  tally.print(name.c_str());
  all.add(tally);
  return true;
}

double millisecondsOf(const Node& node, double edgeLength)
{
  const std::clock_t start = std::clock();
  node.mesh(edgeLength);
  return 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

bool measureEdits(const std::string& name)
{
  constexpr int kBalls = 8;
  constexpr int kEdits = 20;
  const MeshPtr mesh = closedMesh(name);
  if (!mesh)
  {
    return false;
  }
  const double size = mesh->bounds().sizes().maxCoeff();
  test::Random random(11);
  std::vector<Vec3> places;
  for (int k = 0; k < kBalls; ++k)
  {
    const int t = random.integer(0, static_cast<int>(mesh->triangles.size()) - 1);
    const Triangle& c = mesh->triangles[static_cast<std::size_t>(t)];
    places.push_back((mesh->points[c[0]] + mesh->points[c[1]] + mesh->points[c[2]]) / 3.0);
  }
  std::vector<NodePtr> nodes{ makeMeshNode(mesh, 1.0, size / 20.0, 2) };
  const auto ballAt = [&](const Vec3& at)
  {
    return makePrimitive(
      std::make_shared<PointSkeleton>(at), Potential::bySurfaceRadius(size / 30.0, size / 15.0, 2));
  };
  for (const Vec3& place : places)
  {
    nodes.push_back(ballAt(place));
  }
  std::vector<double> times;
  for (int edit = 0; edit <= kEdits; ++edit)
  {
    nodes.back() = ballAt(places.back() + edit * size * Vec3(0.002, 0.001, -0.0015));
    times.push_back(
      millisecondsOf(*makeBlend(nodes, { BlendMethod::PrimitiveBased, 1.0 }), size / kEdges));
  }
  std::sort(times.begin() + 1, times.end());
  std::printf(
    "%-26s first %6.1f ms, edits %6.1f ms\n", name.c_str(), times.front(), times[1 + kEdits / 2]);
  return true;
}

int editsOf(std::vector<std::string> names)
{
  setThreadCount(1);
  if (names.empty())
  {
    names = { "anchor.off", "rotor.off", "pinion.off" };
  }
  bool any = false;
  for (const std::string& name : names)
  {
    any = measureEdits(name) || any;
  }
  return any ? 0 : 1;
}

} // namespace

int main(int argc, char** argv)
{
  std::vector<std::string> names(argv + 1, argv + argc);
  if (!names.empty() && names.front() == "edits")
  {
    return editsOf({ names.begin() + 1, names.end() });
  }
  if (names.empty())
  {
    names = { "joint.off", "anchor.off", "rotor.off", "cross.off", "cube.off", "couplingdown.off",
      "fandisk.off", "pinion.off", "part.off", "pipe.off", "rotor_small.off", "pinion_small.off",
      "spool.off", "star.off", "tripod.off", "turbine.off", "beam.off", "itemb.off", "P.off",
      "dragknob.off", "helmet.off", "tetrahedron.off", "octahedron.off", "handle.off", "homer.off",
      "bear.off", "elephant.off" };
  }
  Tally all;
  bool any = false;
  for (const std::string& name : names)
  {
    any = measure(name, all) || any;
  }
  all.print("all");
  return any ? 0 : 1;
}
