// SPDX-License-Identifier: BSD-3-Clause
// Dragging in a real pipeline: the Igea scan and balls on its surface, blended by the filter; one
// of them is moved 50 times. First run, edits, and what the edits cost beside the mesh itself.
//   - "blend": everywhere; a ball moves;
//   - "region", "operand": scan and balls by one local blend, in eight regions around the balls;
//   one
//     of the regions, or one of the balls, moves;
//   - "chain": ball after ball by a local blend of its own; the first region moves.
//
//   PipelineEditBenchmark [threads, default 2] [edits, default 50]
//     [blend, region, operand or chain, default blend]
#include "benchmarks/support/BenchmarkMesh.h"
#include "core/base/Parallel.h"
#include "core/nodes/Node.h"

#include "vtkCellArray.h"
#include "vtkHybridTreeArray.h"
#include "vtkHybridTreeBlend.h"
#include "vtkHybridTreeLocalBlend.h"
#include "vtkHybridTreePoint.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTrivialProducer.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

namespace
{

using namespace hybridtree;

constexpr double kEdge = 1.0 / 148.0;

void fill(const TriangleMesh& mesh, vtkPolyData* data)
{
  vtkNew<vtkPoints> points;
  for (const Vec3& p : mesh.points)
  {
    points->InsertNextPoint(p.x(), p.y(), p.z());
  }
  vtkNew<vtkCellArray> cells;
  for (const Triangle& c : mesh.triangles)
  {
    const vtkIdType corners[3] = { c[0], c[1], c[2] };
    cells->InsertNextCell(3, corners);
  }
  data->SetPoints(points);
  data->SetPolys(cells);
}

struct Time
{
  double wall = 0.0;
  double processors = 0.0;
};

template <typename Work>
Time timeOf(Work&& work)
{
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t ticks = std::clock();
  work();
  return { std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
    double(std::clock() - ticks) / CLOCKS_PER_SEC };
}

double median(const std::vector<Time>& times, double Time::*which)
{
  std::vector<double> values;
  for (const Time& time : times)
  {
    values.push_back(time.*which);
  }
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

constexpr std::size_t kBalls = 8;

using Ball = vtkSmartPointer<vtkHybridTreePoint>;

std::vector<Ball> ballsOn(const TriangleMesh& mesh, double radius, const Vec3& shift)
{
  std::vector<Ball> balls;
  for (std::size_t k = 0; k < kBalls; ++k)
  {
    const Vec3 at = mesh.points[(k + 1) * mesh.points.size() / (kBalls + 1)] + shift;
    balls.push_back(Ball::New());
    balls.back()->SetCenter(at.x(), at.y(), at.z());
    balls.back()->SetSurfaceRadius(radius);
    balls.back()->SetInfluenceRadius(2.0 * radius);
  }
  return balls;
}

/// A pipeline, and what is dragged in it.
struct Scene
{
  vtkSmartPointer<vtkHybridTreeBlendAlgorithm> root;
  Ball moved;
};

vtkSmartPointer<vtkHybridTreeBlend> blendOf(const std::vector<Ball>& balls)
{
  auto blend = vtkSmartPointer<vtkHybridTreeBlend>::New();
  for (const Ball& ball : balls)
  {
    blend->AddInputConnection(ball->GetOutputPort());
  }
  blend->SetEdgeLength(kEdge);
  return blend;
}

Scene blended(vtkAlgorithm* scan, const std::vector<Ball>& balls)
{
  auto blend = vtkSmartPointer<vtkHybridTreeBlend>::New();
  blend->AddInputConnection(scan->GetOutputPort());
  for (const Ball& ball : balls)
  {
    blend->AddInputConnection(ball->GetOutputPort());
  }
  return { blend, balls.back() };
}

Scene blendedInRegions(vtkAlgorithm* scan, const std::vector<Ball>& balls,
  const std::vector<Ball>& regions, bool moveRegion)
{
  auto local = vtkSmartPointer<vtkHybridTreeLocalBlend>::New();
  local->AddInputConnection(0, scan->GetOutputPort());
  local->AddInputConnection(1, blendOf(balls)->GetOutputPort());
  for (const Ball& region : regions)
  {
    local->AddInputConnection(2, region->GetOutputPort());
  }
  return { local, (moveRegion ? regions : balls).back() };
}

Scene blendedInTurn(
  vtkAlgorithm* scan, const std::vector<Ball>& balls, const std::vector<Ball>& regions)
{
  vtkSmartPointer<vtkAlgorithm> last = scan;
  vtkSmartPointer<vtkHybridTreeBlendAlgorithm> root;
  for (std::size_t k = 0; k < balls.size(); ++k)
  {
    root = vtkSmartPointer<vtkHybridTreeLocalBlend>::New();
    root->AddInputConnection(0, last->GetOutputPort());
    root->AddInputConnection(1, balls[k]->GetOutputPort());
    root->AddInputConnection(2, regions[k]->GetOutputPort());
    root->SetEdgeLength(kEdge);
    last = root;
  }
  return { root, regions.front() };
}

Scene sceneOf(const std::string& kind, vtkAlgorithm* scan, const TriangleMesh& mesh)
{
  const std::vector<Ball> balls = ballsOn(mesh, 0.015, Vec3::Zero());
  const std::vector<Ball> regions = ballsOn(mesh, 0.02, Vec3(0.01, 0.0, 0.0));
  return kind == "chain" ? blendedInTurn(scan, balls, regions)
    : kind == "region"   ? blendedInRegions(scan, balls, regions, true)
    : kind == "operand"  ? blendedInRegions(scan, balls, regions, false)
                         : blended(scan, balls);
}

} // namespace

int main(int argc, char** argv)
{
  setThreadCount(argc > 1 ? std::max(1, std::atoi(argv[1])) : 2);
  const int edits = argc > 2 ? std::max(1, std::atoi(argv[2])) : 50;
  const MeshPtr mesh = benchmark::benchmarkMesh("igea.ply", 268000);
  vtkNew<vtkPolyData> scan;
  fill(*mesh, scan);
  vtkNew<vtkTrivialProducer> producer;
  producer->SetOutput(scan);
  const Scene scene = sceneOf(argc > 3 ? argv[3] : "blend", producer, *mesh);
  vtkHybridTreeBlendAlgorithm* const blend = scene.root;
  blend->SetEdgeLength(kEdge);
  const Time first = timeOf([&] { blend->Update(); });

  const Vec3 start(scene.moved->GetCenter());
  std::vector<Time> times, meshes;
  for (int k = 1; k <= edits; ++k)
  {
    scene.moved->SetCenter(start.x() + 0.0005 * k, start.y() + 0.0002 * k, start.z());
    times.push_back(timeOf([&] { blend->Update(); }));
  }
  for (int k = 1; k <= edits; ++k) // the mesh alone, by a node that asks for it at another length
  {
    scene.moved->SetCenter(start.x() - 0.0005 * k, start.y() + 0.0002 * k, start.z());
    blend->SetEdgeLength(0.05);
    blend->Update();
    const auto tree = blend->GetTree();
    meshes.push_back(timeOf([&] { tree->mesh(kEdge); }));
  }
  std::printf("%lld triangles, %d threads\n",
    static_cast<long long>(blend->GetOutput()->GetNumberOfPolys()), threadCount());
  std::printf(
    "first update: %.1f ms, of all processors %.1f ms\n", 1e3 * first.wall, 1e3 * first.processors);
  const double wall = median(times, &Time::wall);
  const double processors = median(times, &Time::processors);
  std::printf(
    "%d edits, medians: %.1f ms, 1/%.0f of the first; of all processors %.1f ms, 1/%.0f\n", edits,
    1e3 * wall, first.wall / wall, 1e3 * processors, first.processors / processors);
  std::printf("of which the mesh: %.1f ms; of all processors %.1f ms\n",
    1e3 * median(meshes, &Time::wall), 1e3 * median(meshes, &Time::processors));
  return 0;
}
