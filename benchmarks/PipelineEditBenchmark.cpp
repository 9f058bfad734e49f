// SPDX-License-Identifier: BSD-3-Clause
// Dragging in a real pipeline: the Igea scan and balls on its surface, blended by the filter; one
// ball is moved 50 times. First run, edits, and what the edits cost beside the mesh itself.
//
//   PipelineEditBenchmark [threads, default 2] [edits, default 50]
#include "benchmarks/support/BenchmarkMesh.h"
#include "core/base/Parallel.h"
#include "core/nodes/Node.h"

#include "vtkCellArray.h"
#include "vtkHybridTreeArray.h"
#include "vtkHybridTreeBlend.h"
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
  vtkNew<vtkHybridTreeBlend> blend;
  blend->SetEdgeLength(kEdge);
  blend->AddInputConnection(producer->GetOutputPort());
  std::vector<vtkSmartPointer<vtkHybridTreePoint>> balls;
  for (std::size_t k = 0; k < 8; ++k)
  {
    const Vec3& at = mesh->points[(k + 1) * mesh->points.size() / 9];
    balls.push_back(vtkSmartPointer<vtkHybridTreePoint>::New());
    balls.back()->SetCenter(at.x(), at.y(), at.z());
    balls.back()->SetSurfaceRadius(0.015);
    balls.back()->SetInfluenceRadius(0.03);
    blend->AddInputConnection(balls.back()->GetOutputPort());
  }
  const Time first = timeOf([&] { blend->Update(); });

  const Vec3 start(balls.back()->GetCenter());
  std::vector<Time> times, meshes;
  for (int k = 1; k <= edits; ++k)
  {
    balls.back()->SetCenter(start.x() + 0.0005 * k, start.y() + 0.0002 * k, start.z());
    times.push_back(timeOf([&] { blend->Update(); }));
  }
  for (int k = 1; k <= edits; ++k) // the mesh alone, by a node that asks for it at another length
  {
    balls.back()->SetCenter(start.x() - 0.0005 * k, start.y() + 0.0002 * k, start.z());
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
