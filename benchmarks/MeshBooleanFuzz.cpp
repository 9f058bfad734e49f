// SPDX-License-Identifier: BSD-3-Clause
// Whether Booleans of meshes are right: all three operations on random rigid placements of pairs of
// real closed meshes, and on the hard cases of tests/core/boolean. Counts what is wrong, with the
// same measure for the peers.
//
//   MeshBooleanFuzz [-n placements, default 2000] [-f first seed, default 1]
//     [-p placements that the peers get too, default 30] mesh.off ...
//
// Meshes that are open, no 2-manifold or (by CGAL) cross themselves are named and left out. In
// Debian, meshes come with libcgal-demo:
//   tar -xzf /usr/share/doc/libcgal-dev/data.tar.gz && MeshBooleanFuzz data/meshes/*.off
//
// Right is: a closed, oriented 2-manifold without unused points; the volumes of union, intersection
// and difference agree with each other (1e-9 of the operands'), and with the share of random points
// that the exact inside tests of the operands find (3 standard deviations; among thousands some
// pass those by chance, so once more with 25 times and then 400 times as many points). Peers get 20
// seconds for an operation in a process of its own, so that what hangs or crashes counts as wrong
// and is over.

#include "benchmarks/support/PeerBooleans.h"
#include "core/boolean/MeshBoolean.h"
#include "core/mesh/MeshBvh.h"
#include "core/mesh/MeshChecks.h"
#include "core/mesh/MeshSide.h"
#include "core/mesh/RepairMesh.h"
#include "tests/core/boolean/BooleanCases.h"
#include "tests/support/Random.h"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <sstream>
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

std::unique_ptr<TriangleMesh> readOff(const std::string& file)
{
  std::ifstream stream(file);
  std::string text;
  for (std::string line; std::getline(stream, line);)
  {
    text += line.substr(0, line.find('#')) + "\n";
  }
  std::istringstream words(text);
  std::string magic;
  std::size_t points = 0, faces = 0, edges = 0;
  if (!(words >> magic >> points >> faces >> edges) || magic != "OFF")
  {
    return nullptr;
  }
  auto mesh = std::make_unique<TriangleMesh>();
  mesh->points.resize(points);
  for (Vec3& p : mesh->points)
  {
    words >> p.x() >> p.y() >> p.z();
  }
  std::string line;
  for (std::size_t f = 0; f < faces && words >> std::ws && std::getline(words, line); ++f)
  {
    std::istringstream face(line); // colours may follow
    std::size_t corners = 0;
    face >> corners;
    std::vector<std::int32_t> v(corners);
    for (std::int32_t& corner : v)
    {
      face >> corner;
    }
    for (std::size_t k = 2; k < corners; ++k)
    {
      mesh->triangles.push_back({ v[0], v[k - 1], v[k] });
    }
  }
  return mesh;
}

// A mesh of the pool, of diagonal 2 about the origin, with its inside test.
struct Solid
{
  std::string name;
  TriangleMesh mesh;
  MeshBvh bvh;
  MeshSide side;

  Solid(std::string solidName, TriangleMesh solidMesh)
    : name(std::move(solidName)), mesh(std::move(solidMesh)), bvh(mesh), side(mesh, bvh)
  {
  }
  bool contains(const Vec3& p) const { return side.side(p) > 0; }
};

using Pool = std::vector<std::unique_ptr<const Solid>>;

void addToPool(const std::string& file, Pool& pool)
{
  const std::string name = file.substr(file.rfind('/') + 1);
  const std::unique_ptr<TriangleMesh> read = readOff(file);
  if (!read || read->empty())
  {
    std::printf("%s: left out, not read as triangles\n", name.c_str());
    return;
  }
  try
  {
    TriangleMesh mesh = *repairMesh(read->points, read->triangles).mesh;
    const Box3 bounds = mesh.bounds();
    for (Vec3& p : mesh.points)
    {
      p = (p - bounds.center()) * (2.0 / bounds.diagonal().norm());
    }
    const MeshReport report = checkMesh(mesh);
    if (!report.closedManifold() || !(signedVolume(mesh) > 1e-4))
    {
      std::printf("%s: left out, %s\n", name.c_str(),
        report.closedManifold() ? "encloses nothing" : report.describe().c_str());
    }
    else if (crossesItself(mesh))
    {
      std::printf("%s: left out, crosses itself\n", name.c_str());
    }
    else
    {
      pool.push_back(std::make_unique<const Solid>(name, std::move(mesh)));
    }
  }
  catch (const std::exception& error)
  {
    std::printf("%s: left out, %s\n", name.c_str(), error.what());
  }
}

// Two solids, the second one moved.
struct Placement
{
  const Solid& a;
  const Solid& b;
  Affine3 map;
  TriangleMesh moved;

  bool contains(MeshOperation operation, const Vec3& p) const
  {
    const bool inA = a.contains(p);
    const bool inB = b.contains(map.inverse(Eigen::Isometry) * p);
    return operation == MeshOperation::Union     ? inA || inB
      : operation == MeshOperation::Intersection ? inA && inB
                                                 : inA && !inB;
  }
};

// Whether a volume is as many standard deviations off as chance does not explain.
bool isOff(const Placement& pair, MeshOperation operation, double volume, std::uint64_t seed)
{
  Box3 box = pair.a.mesh.bounds();
  box.extend(pair.moved.bounds());
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
};

void runOurs(const Placement& pair, std::uint64_t seed, Tally& tally)
{
  const auto start = std::chrono::steady_clock::now();
  const BooleanResults results = allOperations(pair.a.mesh, pair.moved);
  tally.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::string fault = faultsOf(results, pair.a.mesh, pair.moved);
  const std::array<const MeshBooleanResult*, 3> each = { &results.unite, &results.intersect,
    &results.subtract };
  for (std::size_t k = 0; k < 3 && fault.empty(); ++k)
  {
    fault = faultOf(pair, k, each[k]->mesh, seed);
  }
  ++(fault.empty() ? tally.right : tally.wrong);
  if (!fault.empty())
  {
    std::printf("seed %llu, %s and %s: %s\n", static_cast<unsigned long long>(seed),
      pair.a.name.c_str(), pair.b.name.c_str(), fault.c_str());
  }
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
  const std::array<std::unique_ptr<PeerBoolean>, 3> peers = { cgalCorefinement(
                                                                pair.a.mesh, pair.moved),
    vtkLoopBoolean(pair.a.mesh, pair.moved), vtkBooleanOperation(pair.a.mesh, pair.moved) };
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

} // namespace

int main(int argc, char** argv)
{
  std::uint64_t placements = 2000, first = 1, withPeers = 30;
  Pool pool;
  for (int k = 1; k < argc; ++k)
  {
    if (argv[k][0] == '-' && k + 1 < argc)
    {
      const std::uint64_t value = std::strtoull(argv[k + 1], nullptr, 10);
      (argv[k][1] == 'n' ? placements : argv[k][1] == 'p' ? withPeers : first) = value;
      ++k;
      continue;
    }
    addToPool(argv[k], pool);
  }
  Tally hard, ours;
  runHardCases(hard);
  std::vector<PeerTally> peers;
  for (std::uint64_t seed = first; seed < first + placements && !pool.empty(); ++seed)
  {
    Random random(seed);
    const Solid& a = *pool[std::size_t(random.integer(0, int(pool.size()) - 1))];
    const Solid& b = *pool[std::size_t(random.integer(0, int(pool.size()) - 1))];
    const Affine3 map = randomPlacement(random, 0.8);
    const Placement pair{ a, b, map, moved(b.mesh, map) };
    runOurs(pair, seed, ours);
    if (seed < first + withPeers)
    {
      runPeers(pair, seed, peers);
    }
  }
  std::printf("%zu meshes in the pool\n", pool.size());
  std::printf("hard cases: %d right, %d wrong\n", hard.right, hard.wrong);
  std::printf("random placements, three operations each: %d right, %d wrong; %.1f s for all\n",
    ours.right, ours.wrong, ours.seconds);
  for (const PeerTally& peer : peers)
  {
    std::printf("%s:", peer.name.c_str());
    for (std::size_t k = 0; k < 3; ++k)
    {
      std::printf(
        " %s %d right, %d wrong;", kNames[k], peer.operations[k].right, peer.operations[k].wrong);
    }
    std::printf("\n");
  }
  return hard.wrong + ours.wrong == 0 ? 0 : 1;
}
