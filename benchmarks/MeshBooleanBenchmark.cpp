// SPDX-License-Identifier: BSD-3-Clause
// Booleans of two meshes, ours beside CGAL's corefinement and VTK's two filters, in one run.
//
//   MeshBooleanBenchmark --benchmark_repetitions=5 --benchmark_enable_random_interleaving=true
//
// Pairs: two Igeas ([HT] Fig. 3; 268,686 triangles each), Igea and a fine sphere (327,680), two
// bunnies (the holes at the base closed). Cold: hierarchies are built inside of the time, as the
// peers do; warm: they are kept, as in editing. One thread and two; the peers use one. The counters
// tell what came out: triangles, and whether it is a closed 2-manifold. At the end stand the ratios
// of the medians to CGAL's.
//
// At the end 64 spheres of 5120 triangles each are united: nested by halves, as BooleanNest
// does, and one after the other in 63 passes; then again after one of them has moved.
//
// vtkBooleanOperationPolyDataFilter takes minutes or more on the large pairs, and has only a pair
// of spheres.

#include "benchmarks/support/BenchmarkMesh.h"
#include "benchmarks/support/PeerBooleans.h"
#include "core/base/Parallel.h"
#include "core/boolean/MeshBoolean.h"
#include "core/mesh/MeshChecks.h"
#include "core/nodes/BooleanNest.h"
#include "core/nodes/MeshNode.h"
#include "tests/support/Random.h"
#include "tests/support/TestMeshes.h"

#include <benchmark/benchmark.h>

#include <cstdio>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace
{

using namespace hybridtree;
using namespace hybridtree::benchmark;

struct Pair
{
  std::string name;
  MeshPtr a;
  MeshPtr b;
};

MeshPtr placed(const TriangleMesh& mesh, const Vec3& shift, double angle)
{
  auto result = std::make_shared<TriangleMesh>(mesh);
  const Eigen::AngleAxisd rotation(angle, Vec3(1, 2, 3).normalized());
  for (Vec3& p : result->points)
  {
    p = rotation * p + shift;
  }
  return result;
}

// Without holes, for the peers cannot have them.
MeshPtr closed(const MeshPtr& mesh)
{
  return std::make_shared<const TriangleMesh>(MeshOperand(mesh).mesh());
}

void tell(::benchmark::State& state, const TriangleMesh& mesh)
{
  state.counters["triangles"] = double(mesh.triangles.size());
  state.counters["closed"] = !mesh.empty() && isClosedManifold(mesh);
}

void ours(::benchmark::State& state, const Pair& pair, bool warm, int threads)
{
  setThreadCount(threads);
  const MeshOperand a(pair.a);
  const MeshOperand b(pair.b);
  MeshBooleanResult result;
  for (auto _ : state)
  {
    result = warm ? meshBoolean(MeshOperation::Union, a, b)
                  : meshBoolean(MeshOperation::Union, MeshOperand(pair.a), MeshOperand(pair.b));
  }
  tell(state, result.mesh);
  setThreadCount(0);
}

using MakePeer =
  std::function<std::unique_ptr<PeerBoolean>(const TriangleMesh&, const TriangleMesh&)>;

void peer(::benchmark::State& state, const Pair& pair, const MakePeer& make)
{
  const std::unique_ptr<PeerBoolean> boolean = make(*pair.a, *pair.b);
  bool done = false;
  for (auto _ : state)
  {
    state.PauseTiming();
    boolean->prepare();
    state.ResumeTiming();
    done = boolean->run(MeshOperation::Union);
  }
  tell(state, done ? boolean->result() : TriangleMesh());
}

// Times of the medians; single runs where nothing is repeated.
class Ratios final : public ::benchmark::ConsoleReporter
{
public:
  void ReportRuns(const std::vector<Run>& runs) override
  {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs)
    {
      if (run.run_type == Run::RT_Iteration || run.aggregate_name == "median")
      {
        times_[run.run_name.function_name] = run.GetAdjustedRealTime();
      }
    }
  }

  void print() const
  {
    for (const auto& [name, time] : times_)
    {
      const auto cgal = times_.find(name.substr(0, name.find('/')) + "/CGAL corefinement");
      if (cgal != times_.end() && cgal->second != time)
      {
        std::printf("%-60s %6.2f times as fast as CGAL\n", name.c_str(), cgal->second / time);
      }
    }
  }

private:
  std::map<std::string, double> times_;
};

void add(const Pair& pair, bool small)
{
  const auto enter = [&](const std::string& name, auto run)
  {
    ::benchmark::RegisterBenchmark((pair.name + "/" + name).c_str(), run)
      ->Unit(::benchmark::kMillisecond)
      ->UseRealTime();
  };
  for (const bool warm : { false, true })
  {
    for (const int threads : { 1, 2 })
    {
      enter(std::string(warm ? "warm" : "cold") + ", threads " + std::to_string(threads),
        [=](::benchmark::State& state) { ours(state, pair, warm, threads); });
    }
  }
  enter(
    "CGAL corefinement", [=](::benchmark::State& state) { peer(state, pair, cgalCorefinement); });
  enter("vtkLoopBooleanPolyDataFilter",
    [=](::benchmark::State& state) { peer(state, pair, vtkLoopBoolean); });
  if (small)
  {
    enter("vtkBooleanOperationPolyDataFilter",
      [=](::benchmark::State& state) { peer(state, pair, vtkBooleanOperation); });
  }
}

using Solids = std::vector<NodePtr>;

NodePtr ballAt(const Vec3& centre)
{
  auto mesh = std::make_shared<const TriangleMesh>(test::icosphere(0.3, 4, centre));
  return makeMeshNode(mesh, 1.0, 0.1, 2);
}

Solids scatteredBalls(std::size_t count)
{
  test::Random random(7);
  Solids balls;
  while (balls.size() < count)
  {
    balls.push_back(ballAt(random.inBox(Box3(Vec3::Constant(-1.0), Vec3::Constant(1.0)))));
  }
  return balls;
}

NodePtr chainOf(const Solids& solids)
{
  NodePtr all = solids.front();
  for (std::size_t k = 1; k < solids.size(); ++k)
  {
    all = makeBoolean(BooleanOperation::Union, all, solids[k]);
  }
  return all;
}

enum class Way
{
  Chain,
  Halves,
  AfterAMove
};

void unite(::benchmark::State& state, Way way)
{
  MeshPtr mesh;
  for (auto _ : state)
  {
    state.PauseTiming();
    Solids balls = scatteredBalls(64); // with nothing kept
    BooleanNest nest;
    if (way == Way::AfterAMove)
    {
      nest.make(BooleanOperation::Union, balls)->mesh(0.05);
      balls[20] = ballAt(Vec3(0.1, 0.2, 0.3));
    }
    state.ResumeTiming();
    const NodePtr all =
      way == Way::Chain ? chainOf(balls) : nest.make(BooleanOperation::Union, balls);
    mesh = all->mesh(0.05);
  }
  tell(state, *mesh);
}

void addUnions()
{
  const std::map<Way, const char*> names = { { Way::Chain, "one after the other" },
    { Way::Halves, "by halves" }, { Way::AfterAMove, "by halves, one has moved" } };
  for (const auto& [way, name] : names)
  {
    ::benchmark::RegisterBenchmark((std::string("64 spheres united/") + name).c_str(),
      [way = way](::benchmark::State& state) { unite(state, way); })
      ->Unit(::benchmark::kMillisecond)
      ->UseRealTime();
  }
}

} // namespace

int main(int argc, char** argv)
{
  ::benchmark::Initialize(&argc, argv);
  const MeshPtr igea = benchmarkMesh("igea.ply", 268686);
  const MeshPtr bunny = closed(benchmarkMesh("stanford_bunny.obj", 69451));
  const auto ball = [](double radius, int subdivisions)
  { return std::make_shared<const TriangleMesh>(test::icosphere(radius, subdivisions)); };
  const Vec3 middle = igea->bounds().center();
  const std::vector<Pair> pairs = {
    { "two Igeas", igea, placed(*igea, Vec3(0.1, 0.03, 0.02), 0.3) },
    { "Igea and sphere", igea, placed(*ball(0.3, 7), middle + Vec3(0.3, 0.1, 0.0), 0.0) },
    { "two bunnies", bunny, placed(*bunny, Vec3(0.1, 0.03, 0.02), 0.3) },
    { "two spheres", ball(1.0, 4), placed(*ball(1.0, 4), Vec3(0.5, 0.1, 0.05), 0.3) },
  };
  for (const Pair& pair : pairs)
  {
    add(pair, pair.a->triangles.size() < 10000);
  }
  addUnions();
  Ratios ratios;
  ::benchmark::RunSpecifiedBenchmarks(&ratios);
  ratios.print();
  return 0;
}
