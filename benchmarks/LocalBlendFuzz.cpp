// SPDX-License-Identifier: BSD-3-Clause
// How often the mesh of a blend is right: blends of random trees of every node kind, with every
// method and several overlap thresholds. For each: closed, oriented, 2-manifold; its volume that of
// the membership by random points (within 4 sigma and what the chords of the mesh cost); how often
// cells had to be added, and how often everything was polygonized in the end. Prints each case that
// is wrong, and the tally.
//
//   LocalBlendFuzz [number of trees, default 500] [first seed, default 0]
#include "core/base/Error.h"
#include "core/mesh/MeshChecks.h"
#include "core/nodes/BlendMesh.h"
#include "tests/support/Random.h"
#include "tests/support/RandomTree.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace
{

using namespace hybridtree;

struct Volume
{
  double value = 0.0;
  double sigma = 0.0;
};

Volume volumeByPoints(const Node& node, std::uint64_t seed)
{
  constexpr std::size_t kPoints = 20000;
  const Box3 box = node.surfaceBounds();
  if (box.isEmpty() || !(box.volume() > 0.0))
  {
    return {};
  }
  test::Random random(seed);
  const test::PointList points = test::randomPoints(random, box, kPoints);
  std::vector<std::int8_t> side(kPoints);
  node.membership(points, side.data());
  std::size_t inside = 0;
  for (const std::int8_t s : side)
  {
    inside += s > 0 ? 1 : 0;
  }
  const double share = double(inside) / kPoints;
  return { share * box.volume(), box.volume() * std::sqrt(share * (1.0 - share) / kPoints) };
}

struct Tally
{
  int meshes = 0;
  int notClosed = 0;
  int volumeOff = 0;
  int repaired = 0; ///< by cells that were added
  int global = 0;   ///< after all
  std::size_t kept = 0;
  std::size_t made = 0;
};

} // namespace

int main(int argc, char** argv)
{
  const int count = argc > 1 ? std::atoi(argv[1]) : 500;
  const int first = argc > 2 ? std::atoi(argv[2]) : 0;
  const std::array<const char*, 4> names = { "automatic", "node-based", "primitive-based",
    "global" };
  std::array<Tally, 4> tallies;
  for (int seed = first; seed < first + count; ++seed)
  {
    test::Random random(static_cast<std::uint64_t>(seed));
    std::vector<NodePtr> children;
    const int parts = random.integer(2, 4);
    for (int k = 0; k < parts; ++k)
    {
      children.push_back(test::randomTree(random.bits(), random.integer(1, 3)));
    }
    const double threshold = std::array<double, 3>{ 0.0, 0.5, 1.0 }[random.integer(0, 2)];
    const double edge = random.uniform(0.05, 0.12);
    Volume volume;
    for (std::size_t method = 0; method < names.size(); ++method)
    {
      Tally& tally = tallies[method];
      ++tally.meshes;
      const BlendOptions options{ static_cast<BlendMethod>(method), threshold };
      try
      {
        const NodePtr blend = makeBlend(children, options);
        const MeshPtr mesh = blend->mesh(edge);
        if (method == 0)
        {
          volume = volumeByPoints(*blend, 1);
        }
        const MeshReport report = checkMesh(*mesh);
        // Chords and notched creases: an eighth of an edge length over the area, at most.
        double area = 0.0;
        for (std::size_t t = 0; t < mesh->triangles.size(); ++t)
        {
          area += 0.5 * areaNormal(*mesh, t).norm();
        }
        const double off = std::abs(signedVolume(*mesh) - volume.value);
        const bool volumeOff = off > 4.0 * volume.sigma + 0.125 * edge * area;
        tally.notClosed += report.closedManifold() ? 0 : 1;
        tally.volumeOff += volumeOff ? 1 : 0;
        if (!report.closedManifold() || volumeOff)
        {
          std::printf("seed %d, %s: %s; volume off by %g, sigma %g, area %g\n", seed, names[method],
            report.describe().c_str(), off, volume.sigma, area);
        }
        BlendMeshReport how;
        std::vector<BlendPart> leaves;
        int leaf = 0;
        for (const NodePtr& child : blend->children())
        {
          leaves.push_back({ child.get(), leaf });
          leaf += child->leafCount();
        }
        blendMesh(*blend, leaves, options, edge, how);
        tally.repaired += how.rounds > 1 && how.warning.empty() ? 1 : 0;
        tally.global += how.warning.empty() ? 0 : 1;
        tally.kept += how.keptTriangles;
        tally.made += how.newTriangles;
      }
      catch (const Error& error)
      {
        std::printf("seed %d, %s: %s\n", seed, names[method], error.what());
      }
    }
  }
  for (std::size_t method = 0; method < names.size(); ++method)
  {
    const Tally& tally = tallies[method];
    std::printf(
      "%-16s %d meshes: %d not closed 2-manifolds, %d off in volume; %d repaired, %d made "
      "on the lattice after all; %zu triangles kept, %zu made\n",
      names[method], tally.meshes, tally.notClosed, tally.volumeOff, tally.repaired, tally.global,
      tally.kept, tally.made);
  }
  return 0;
}
