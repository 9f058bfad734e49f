// SPDX-License-Identifier: BSD-3-Clause
// The snake of [HT] 6.1: 250 segments blended along a curve, meshed to some 120,000 triangles,
// beside what VTK offers for the same field on the same lattice:
//   vtkSampleFunction + vtkFlyingEdges3D, and
//   a dense grid filled primitive by primitive inside their influence boxes + vtkFlyingEdges3D.
// All on one thread, ours on two as well; in random order, medians. VTK's vertices are left at
// linear interpolation with normals by differences on the grid, ours lie on the surface with exact
// normals.
#include "benchmarks/support/RatioReporter.h"
#include "core/base/Parallel.h"
#include "core/mesh/MeshChecks.h"
#include "core/nodes/Blend.h"
#include "core/nodes/LatticeMesh.h"
#include "core/nodes/Primitive.h"
#include "core/skeletons/Segment.h"

#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkImplicitFunction.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkSampleFunction.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <malloc.h>
#include <string>
#include <vector>

namespace
{

using namespace hybridtree;

constexpr int kSegments = 250;
constexpr double kInfluence = 0.06;
constexpr double kSurface = 0.03;
constexpr int kExponent = 2;
constexpr double kCell = 0.0117;

Vec3 curve(double t)
{
  const double a = 2.0 * 3.14159265358979323846 * t;
  const double r = 0.6 + 0.25 * std::cos(11.0 * a);
  return { r * std::cos(4.0 * a), r * std::sin(4.0 * a), 0.25 * std::sin(11.0 * a) };
}

struct Segment
{
  Vec3 a;
  Vec3 b;
};

std::vector<Segment> snake()
{
  std::vector<Segment> segments;
  for (int k = 0; k < kSegments; ++k)
  {
    segments.push_back({ curve(double(k) / kSegments), curve(double(k + 1) / kSegments) });
  }
  return segments;
}

/// One segment's field as a careful programmer writes it by hand.
class HandField
{
public:
  explicit HandField(const Segment& segment)
    : a_(segment.a)
    , edge_(segment.b - segment.a)
    , inverse_(1.0 / edge_.squaredNorm())
    , maximum_(Potential::bySurfaceRadius(kSurface, kInfluence, kExponent).maximumField())
  {
  }

  double operator()(double x, double y, double z) const
  {
    const double px = x - a_.x();
    const double py = y - a_.y();
    const double pz = z - a_.z();
    const double t =
      std::min(1.0, std::max(0.0, (px * edge_.x() + py * edge_.y() + pz * edge_.z()) * inverse_));
    const double dx = px - t * edge_.x();
    const double dy = py - t * edge_.y();
    const double dz = pz - t * edge_.z();
    const double u = std::max(0.0, 1.0 - (dx * dx + dy * dy + dz * dz) / (kInfluence * kInfluence));
    return maximum_ * u * u;
  }

private:
  Vec3 a_;
  Vec3 edge_;
  double inverse_;
  double maximum_;
};

class SnakeFunction final : public vtkImplicitFunction
{
public:
  static SnakeFunction* New();
  using vtkImplicitFunction::EvaluateFunction;
  double EvaluateFunction(double x[3]) override
  {
    double sum = 0.0;
    for (const HandField& field : this->Fields)
    {
      sum += field(x[0], x[1], x[2]);
    }
    return sum;
  }
  void EvaluateGradient(double[3], double gradient[3]) override { std::fill_n(gradient, 3, 0.0); }

  std::vector<HandField> Fields;
};

SnakeFunction* SnakeFunction::New()
{
  VTK_STANDARD_NEW_BODY(SnakeFunction);
}

/// The lattice of ours, cut to the surface bounds.
struct Grid
{
  int low[3];
  int high[3];

  explicit Grid(const Box3& box)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = static_cast<int>(std::floor(box.min()[axis] / kCell)) - 1;
      high[axis] = static_cast<int>(std::ceil(box.max()[axis] / kCell)) + 1;
    }
  }
  int size(int axis) const { return high[axis] - low[axis] + 1; }
};

vtkIdType contour(vtkImageData* image)
{
  vtkNew<vtkFlyingEdges3D> edges;
  edges->SetInputData(image);
  edges->SetValue(0, kThreshold);
  edges->ComputeNormalsOn();
  edges->Update();
  return edges->GetOutput()->GetNumberOfCells();
}

vtkIdType sampled(const std::vector<Segment>& segments, const Grid& grid)
{
  vtkNew<SnakeFunction> function;
  for (const Segment& segment : segments)
  {
    function->Fields.emplace_back(segment);
  }
  vtkNew<vtkSampleFunction> sampler;
  sampler->SetImplicitFunction(function);
  sampler->SetSampleDimensions(grid.size(0), grid.size(1), grid.size(2));
  sampler->SetModelBounds(grid.low[0] * kCell, grid.high[0] * kCell, grid.low[1] * kCell,
    grid.high[1] * kCell, grid.low[2] * kCell, grid.high[2] * kCell);
  sampler->ComputeNormalsOff();
  sampler->SetOutputScalarTypeToFloat();
  sampler->Update();
  return contour(sampler->GetOutput());
}

void addSegment(const Segment& segment, const Grid& grid, float* values)
{
  const HandField field(segment);
  int begin[3];
  int end[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = std::min(segment.a[axis], segment.b[axis]) - kInfluence;
    const double high = std::max(segment.a[axis], segment.b[axis]) + kInfluence;
    begin[axis] = std::max(grid.low[axis], static_cast<int>(std::ceil(low / kCell)));
    end[axis] = std::min(grid.high[axis], static_cast<int>(std::floor(high / kCell)));
  }
  for (int z = begin[2]; z <= end[2]; ++z)
  {
    for (int y = begin[1]; y <= end[1]; ++y)
    {
      float* row = values +
        (std::size_t(z - grid.low[2]) * grid.size(1) + (y - grid.low[1])) * grid.size(0) -
        grid.low[0];
      for (int x = begin[0]; x <= end[0]; ++x)
      {
        row[x] += static_cast<float>(field(x * kCell, y * kCell, z * kCell));
      }
    }
  }
}

vtkIdType filled(const std::vector<Segment>& segments, const Grid& grid)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(grid.size(0), grid.size(1), grid.size(2));
  image->SetOrigin(grid.low[0] * kCell, grid.low[1] * kCell, grid.low[2] * kCell);
  image->SetSpacing(kCell, kCell, kCell);
  image->AllocateScalars(VTK_FLOAT, 1);
  auto* values = static_cast<float*>(image->GetScalarPointer());
  std::fill_n(values, image->GetNumberOfPoints(), 0.0f);
  for (const Segment& segment : segments)
  {
    addSegment(segment, grid, values);
  }
  return contour(image);
}

NodePtr makeSnake(const std::vector<Segment>& segments)
{
  std::vector<NodePtr> children;
  const Potential potential = Potential::bySurfaceRadius(kSurface, kInfluence, kExponent);
  for (const Segment& segment : segments)
  {
    children.push_back(
      makePrimitive(std::make_shared<SegmentSkeleton>(segment.a, segment.b), potential));
  }
  return makeBlend(std::move(children));
}

/// Peak resident memory above that at the call, MiB (Linux).
double peakMemory(const std::function<void()>& body)
{
  const auto read = [](const std::string& name)
  {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
    {
      if (line.rfind(name, 0) == 0)
      {
        return std::stod(line.substr(name.size() + 1)) / 1024.0;
      }
    }
    return 0.0;
  };
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
  const double before = read("VmRSS");
  body();
  return read("VmHWM") - before;
}

void add(benchmarks::RatioReporter& reporter, const char* name, const std::function<void()>& body)
{
  reporter.list(name);
  benchmark::RegisterBenchmark(name,
    [body](benchmark::State& state)
    {
      for (auto _ : state)
      {
        body();
      }
    })
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
}

} // namespace

int main(int argc, char** argv)
{
  benchmarks::initializeInterleaved(argc, argv, 9);
  vtkSMPTools::Initialize(1);
  const std::vector<Segment> segments = snake();
  const std::size_t before = mallinfo2().uordblks;
  const NodePtr node = makeSnake(segments);
  const std::size_t treeBytes = mallinfo2().uordblks - before;
  const Grid grid(node->surfaceBounds());

  TriangleMesh mesh;
  const auto ours = [&](int threads)
  {
    setThreadCount(threads);
    mesh = latticeMesh(*node, kCell);
  };
  vtkIdType vtkTriangles = 0;
  const double ourMemory = peakMemory([&] { ours(1); });
  const double gridMemory = peakMemory([&] { vtkTriangles = filled(segments, grid); });
  std::printf("%d segments, lattice %d x %d x %d, tree of %.1f KiB\n", kSegments, grid.size(0),
    grid.size(1), grid.size(2), treeBytes / 1024.0);
  std::printf("HybridTree: %zu triangles, %s, peak %.1f MiB\n", mesh.triangles.size(),
    isClosedManifold(mesh) ? "closed manifold" : "NOT a closed manifold", ourMemory);
  std::printf("dense fill: %lld triangles, peak %.1f MiB\n", static_cast<long long>(vtkTriangles),
    gridMemory);

  benchmarks::RatioReporter reporter;
  add(reporter, "snake/HybridTree", [&] { ours(1); });
  // The ratio of CPU times tells what a busy machine hides: 1 is no work lost to threads.
  add(reporter, "snake/HybridTree, 2 threads", [&] { ours(2); });
  add(reporter, "snake/dense fill + vtkFlyingEdges3D", [&] { filled(segments, grid); });
  add(reporter, "snake/vtkSampleFunction + vtkFlyingEdges3D", [&] { sampled(segments, grid); });
  benchmark::RunSpecifiedBenchmarks(&reporter);
  reporter.print();
  return 0;
}
