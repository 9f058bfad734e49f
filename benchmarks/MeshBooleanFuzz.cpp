// SPDX-License-Identifier: BSD-3-Clause
// Whether Booleans of meshes are right: all three operations on random rigid placements of pairs of
// real closed meshes, and on the hard cases of tests/core/boolean. Counts what is wrong, with the
// same measure for the peers.
//
//   MeshBooleanFuzz [-n placements, default 2000] [-c near ones, default 0] [-f first seed, default
//     1] [-p placements that the peers get too, default 30] [-k chains, default 0] [-r cuts in a
//     chain, default 5] mesh.off ...
//
// Near ones (NearCases.h) nearly or exactly share faces, edges or points. A chain begins with a
// near one and goes on with a result and one of its operands, or that moved a little. Sheets of
// such operands lie on each other but for rounding, and so cross themselves; what is folded there
// has no thickness. Up to a hundredth of the area is not counted as wrong, but told.
//
// With -u balls, default 0, a union of so many in one Boolean node and one after the other.
//
// Meshes that are open, no 2-manifold or (by CGAL) cross themselves are named and left out. In
// Debian, meshes come with libcgal-demo:
//   tar -xzf /usr/share/doc/libcgal-dev/data.tar.gz && MeshBooleanFuzz data/meshes/*.off
//
// Right is: a closed, oriented 2-manifold without unused points, nothing folded or covered twice
// (foldedArea() and coveredTwice(), ours only); the volumes of union, intersection and difference
// agree with each other (1e-10 of the operands'), and with the share of random points
// that the exact inside tests of the operands find (3 standard deviations; among thousands some
// pass those by chance, so once more with 25 times and then 400 times as many points). Peers get 20
// seconds for an operation in a process of its own, so that what hangs or crashes counts as wrong
// and is over.

#include "benchmarks/support/PeerBooleans.h"
#include "benchmarks/support/SolidPool.h"
#include "core/boolean/MeshBoolean.h"
#include "core/mesh/MeshChecks.h"
#include "core/mesh/RepairMesh.h"
#include "core/nodes/Boolean.h"
#include "core/nodes/BooleanNest.h"
#include "core/nodes/MeshNode.h"
#include "tests/core/boolean/BooleanCases.h"
#include "tests/core/boolean/NearCases.h"
#include "tests/support/Random.h"
#include "tests/support/TestMeshes.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace
{

using namespace hybridtree;
using namespace hybridtree::benchmark;
using namespace hybridtree::test;

constexpr std::array<MeshOperation, 3> kOperations = { MeshOperation::Union,
  MeshOperation::Intersection, MeshOperation::Difference };
constexpr std::array<const char*, 3> kNames = { "union", "intersection", "difference" };
constexpr std::size_t kSamples = 1000;
constexpr unsigned kPeerSeconds = 20;

// Two solids as they are put together, and what tells inside.
struct Placement
{
  std::string name;
  const TriangleMesh& a;
  const TriangleMesh& b;
  std::function<bool(const Vec3&)> isInA;
  std::function<bool(const Vec3&)> isInB;

  bool contains(MeshOperation operation, const Vec3& p) const
  {
    const bool inA = isInA(p);
    const bool inB = isInB(p);
    return operation == MeshOperation::Union     ? inA || inB
      : operation == MeshOperation::Intersection ? inA && inB
                                                 : inA && !inB;
  }
};

// Whether a volume is as many standard deviations off as chance does not explain.
bool isOff(const Placement& pair, MeshOperation operation, double volume, std::uint64_t seed)
{
  Box3 box = pair.a.bounds();
  box.extend(pair.b.bounds());
  for (const std::size_t count : { kSamples, 25 * kSamples, 400 * kSamples })
  {
    Random random(seed + count);
    std::size_t inside = 0;
    for (std::size_t k = 0; k < count; ++k)
    {
      inside += pair.contains(operation, random.inBox(box));
    }
    const double share = double(inside) / double(count);
    const double deviation =
      std::sqrt(std::max(share * (1.0 - share), 1.0 / double(count)) / double(count));
    if (std::abs(volume / box.volume() - share) <= 3.0 * deviation)
    {
      return false;
    }
  }
  return true;
}

std::string faultOf(
  const Placement& pair, std::size_t operation, const TriangleMesh& mesh, std::uint64_t seed)
{
  const MeshReport report = checkMesh(mesh);
  if (!report.closedManifold() || report.unusedPoints > 0)
  {
    return std::string(kNames[operation]) + ": " + report.describe();
  }
  const double volume = signedVolume(mesh);
  if (isOff(pair, kOperations[operation], volume, seed))
  {
    return std::string(kNames[operation]) + ": volume " + std::to_string(volume);
  }
  return {};
}

struct Tally
{
  int right = 0;
  int wrong = 0;
  double seconds = 0.0;
  double mostFolded = kFolded; // share of the area that is right
  int folded = 0;              // right, but with more than rounding explains
  double worst = 0.0;          // of those
};

BooleanResults runOurs(const Placement& pair, std::uint64_t seed, Tally& tally)
{
  const auto start = std::chrono::steady_clock::now();
  const BooleanResults results = allOperations(pair.a, pair.b);
  tally.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::string fault = faultsOf(results, pair.a, pair.b, -1.0, tally.mostFolded);
  const double folded = foldedShare(results, pair.a, pair.b);
  tally.folded += folded > kFolded;
  tally.worst = std::max(tally.worst, folded);
  const std::array<const MeshBooleanResult*, 3> each = { &results.unite, &results.intersect,
    &results.subtract };
  for (std::size_t k = 0; k < 3 && fault.empty(); ++k)
  {
    fault = faultOf(pair, k, each[k]->mesh, seed);
  }
  ++(fault.empty() ? tally.right : tally.wrong);
  if (!fault.empty())
  {
    std::printf("seed %llu, %s: %s\n", static_cast<unsigned long long>(seed), pair.name.c_str(),
      fault.c_str());
    std::fflush(stdout);
  }
  return results;
}

// With points at one place made one, for peers that leave them double.
TriangleMesh welded(const TriangleMesh& mesh)
{
  return mesh.empty() ? mesh : *repairMesh(mesh.points, mesh.triangles).mesh;
}

// In a process of its own, which may hang or crash.
bool isPeerRight(
  PeerBoolean& peer, std::size_t operation, const Placement& pair, std::uint64_t seed)
{
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0)
  {
    alarm(kPeerSeconds);
    peer.prepare();
    const bool right = peer.run(kOperations[operation]) &&
      (faultOf(pair, operation, peer.result(), seed).empty() ||
        faultOf(pair, operation, welded(peer.result()), seed).empty());
    _exit(right ? 0 : 1);
  }
  int status = 1;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

struct PeerTally
{
  std::string name;
  std::array<Tally, 3> operations;
};

void runPeers(const Placement& pair, std::uint64_t seed, std::vector<PeerTally>& tallies)
{
  const std::array<std::unique_ptr<PeerBoolean>, 3> peers = { cgalCorefinement(pair.a, pair.b),
    vtkLoopBoolean(pair.a, pair.b), vtkBooleanOperation(pair.a, pair.b) };
  tallies.resize(peers.size());
  for (std::size_t p = 0; p < peers.size(); ++p)
  {
    tallies[p].name = peers[p]->name();
    for (std::size_t k = 0; k < 3; ++k)
    {
      Tally& tally = tallies[p].operations[k];
      ++(isPeerRight(*peers[p], k, pair, seed) ? tally.right : tally.wrong);
    }
  }
}

void runHardCases(Tally& tally)
{
  for (const BooleanCase& hard : hardCases())
  {
    const std::string faults = faultsOf(allOperations(hard.a, hard.b), hard.a, hard.b, hard.common);
    ++(faults.empty() ? tally.right : tally.wrong);
    if (!faults.empty())
    {
      std::printf("%s: %s\n", hard.name.c_str(), faults.c_str());
    }
  }
}

struct Tallies
{
  Tally hard;
  Tally random;
  Tally near;
  Tally chained;
  std::vector<PeerTally> peers;
};

const Solid& anyOf(const Pool& pool, Random& random)
{
  return *pool[std::size_t(random.integer(0, int(pool.size()) - 1))];
}

void runPlacements(const Pool& pool, std::uint64_t first, std::uint64_t count,
  std::uint64_t withPeers, Tallies& tallies)
{
  for (std::uint64_t seed = first; seed < first + count && !pool.empty(); ++seed)
  {
    Random random(seed);
    const Solid& a = anyOf(pool, random);
    const Solid& b = anyOf(pool, random);
    const Affine3 map = randomPlacement(random, 0.8);
    const TriangleMesh placed = moved(b.mesh, map);
    const Placement pair{ a.name + " and " + b.name, a.mesh, placed,
      [&](const Vec3& p) { return a.contains(p); },
      [&](const Vec3& p) { return b.contains(map.inverse(Eigen::Isometry) * p); } };
    runOurs(pair, seed, tallies.random);
    if (seed < first + withPeers)
    {
      runPeers(pair, seed, tallies.peers);
    }
  }
}

BooleanResults runPair(
  const std::string& name, const NearPair& pair, std::uint64_t seed, Tally& tally)
{
  const Solid a(name, pair.a);
  const Solid b(name, pair.b);
  return runOurs({ name, a.mesh, b.mesh, [&](const Vec3& p) { return a.contains(p); },
                   [&](const Vec3& p) { return b.contains(p); } },
    seed, tally);
}

// A near placement, and as many cuts of what comes of it until there are `cuts`.
void runNear(const Pool& pool, std::uint64_t seed, std::uint64_t cuts, Tally& tally)
{
  const std::vector<NearCase> cases = nearCases();
  Random random(seed);
  const NearCase& near = cases[seed % cases.size()];
  const Solid& first = anyOf(pool, random);
  const Solid& second = anyOf(pool, random);
  NearPair pair = near.make(random, first.mesh, second.mesh);
  std::string name = near.name + ": " + first.name + " and " + second.name;
  Tally each;
  each.mostFolded = tally.mostFolded;
  for (std::uint64_t cut = 0; cut < cuts && each.wrong == 0; ++cut)
  {
    const BooleanResults results = runPair(name, pair, seed, each);
    if (cut + 1 < cuts && !results.unite.mesh.empty())
    {
      std::string link;
      pair = nextOfChain(random, pair, results, link);
      name += "; " + link;
    }
  }
  ++(each.wrong == 0 ? tally.right : tally.wrong);
  tally.seconds += each.seconds;
  tally.folded += each.folded > 0;
  tally.worst = std::max(tally.worst, each.worst);
}

void runNearPlacements(
  const Pool& pool, std::uint64_t first, std::uint64_t count, std::uint64_t cuts, Tally& tally)
{
  for (std::uint64_t seed = first; seed < first + count && !pool.empty(); ++seed)
  {
    runNear(pool, seed, cuts, tally);
  }
}

void print(const Tallies& tallies)
{
  std::printf("hard cases: %d right, %d wrong\n", tallies.hard.right, tallies.hard.wrong);
  const auto printPlacements = [](const char* name, const Tally& tally)
  {
    std::printf("%s, three operations each: %d right, %d wrong; %.1f s for all", name, tally.right,
      tally.wrong, tally.seconds);
    std::printf("; %d folded, at most %.1e of the area\n", tally.folded, tally.worst);
  };
  printPlacements("random placements", tallies.random);
  printPlacements("near placements", tallies.near);
  printPlacements("chains of near placements", tallies.chained);
  for (const PeerTally& peer : tallies.peers)
  {
    std::printf("%s:", peer.name.c_str());
    for (std::size_t k = 0; k < 3; ++k)
    {
      std::printf(
        " %s %d right, %d wrong;", kNames[k], peer.operations[k].right, peer.operations[k].wrong);
    }
    std::printf("\n");
  }
}

// More nodes one after the other keep too many meshes at a time: n of n balls each.
constexpr int kMostInTurn = 300;

// A union of balls by its node, which nests them by halves, and, of up to kMostInTurn, by one
// Boolean after the other.
bool uniteBalls(int count, std::uint64_t seed)
{
  Random random(seed);
  std::vector<NodePtr> nodes;
  std::vector<std::unique_ptr<const Solid>> solids;
  std::vector<Box3> boxes;
  const double reach = std::cbrt(double(count));
  for (int k = 0; k < count; ++k)
  {
    const Vec3 center = reach * Vec3(random.unit(), random.unit(), random.unit());
    auto mesh =
      std::make_shared<const TriangleMesh>(icosphere(random.uniform(0.3, 0.8), 3, center));
    nodes.push_back(makeMeshNode(mesh, 1.0, 0.2, 2));
    solids.push_back(std::make_unique<const Solid>("ball", *mesh));
    boxes.push_back(mesh->bounds());
  }
  const auto timed = [](auto&& make, double& seconds)
  {
    const auto start = std::chrono::steady_clock::now();
    MeshPtr mesh = make();
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return mesh;
  };
  double atOnce = 0.0;
  double inTurn = 0.0;
  const MeshPtr united =
    timed([&] { return BooleanNest().make(BooleanOperation::Union, nodes)->mesh(0.1); }, atOnce);
  MeshPtr chained;
  if (count <= kMostInTurn)
  {
    chained = timed(
      [&]
      {
        NodePtr chain = nodes.front();
        for (std::size_t k = 1; k < nodes.size(); ++k)
        {
          chain = makeBoolean(BooleanOperation::Union, chain, nodes[k]);
        }
        return chain->mesh(0.1);
      },
      inTurn);
  }
  const auto isInside = [&](const Vec3& p)
  {
    for (std::size_t k = 0; k < solids.size(); ++k)
    {
      if (boxes[k].contains(p) && solids[k]->contains(p))
      {
        return true;
      }
    }
    return false;
  };
  const Placement pair{ "balls", *united, *united, isInside, [](const Vec3&) { return false; } };
  std::string fault = faultOf(pair, 0, *united, seed);
  const double volume = signedVolume(*united);
  if (chained && !(std::abs(volume - signedVolume(*chained)) <= 1e-9 * volume))
  {
    fault += " volume differs from that of one after the other";
  }
  std::printf("union of %d balls: %s; %zu triangles, %.2f s in one node", count,
    fault.empty() ? "right" : fault.c_str(), united->triangles.size(), atOnce);
  if (chained)
  {
    std::printf(", %.2f s one after the other", inTurn);
  }
  std::printf("\n");
  return fault.empty();
}

} // namespace

int main(int argc, char** argv)
{
  std::map<char, std::uint64_t> option = { { 'n', 2000 }, { 'c', 0 }, { 'f', 1 }, { 'p', 30 },
    { 'k', 0 }, { 'r', 5 }, { 'u', 0 } };
  Pool pool;
  for (int k = 1; k < argc; ++k)
  {
    if (argv[k][0] == '-' && k + 1 < argc)
    {
      option[argv[k][1]] = std::strtoull(argv[k + 1], nullptr, 10);
      ++k;
      continue;
    }
    addToPool(argv[k], pool);
  }
  std::printf("%zu meshes in the pool\n", pool.size());
  Tallies tallies;
  tallies.chained.mostFolded = 1e-2;
  runHardCases(tallies.hard);
  runPlacements(pool, option['f'], option['n'], option['p'], tallies);
  runNearPlacements(pool, option['f'], option['c'], 1, tallies.near);
  runNearPlacements(pool, option['f'], option['k'], option['r'], tallies.chained);
  print(tallies);
  const bool united = option['u'] == 0 || uniteBalls(int(option['u']), option['f']);
  const int wrong =
    tallies.hard.wrong + tallies.random.wrong + tallies.near.wrong + tallies.chained.wrong;
  return wrong == 0 && united ? 0 : 1;
}
