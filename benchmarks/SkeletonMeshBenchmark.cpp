// SPDX-License-Identifier: BSD-3-Clause
// Table 2 of [HT]: the direct mesh of each skeleton at some 57,000 triangles, beside what one has
// otherwise, at as many triangles:
//   our own marching cubes, which skips what the field's range excludes;
//   vtkSampleFunction + vtkMarchingCubes, the brute force that the paper compares with;
//   vtkSampleFunction + vtkFlyingEdges3D;
//   for the point, vtkSphereSource.
// The last shape is a whole tree of Curve Skeletons, whose mesh is made of its curves' and of
// patches where they blend. One thread, CPU time. The samples of point, circle and box are by a
// distance written out in the function that VTK calls, so that VTK is not charged for our layers;
// those of the others ask the skeleton, point by point. Meshes of equal size are not equally good:
// `count` is how many triangles the direct mesh needs to be as near the surface as the other one,
// as a share of that one's (the error of either goes with the square of its edges).
//
// SkeletonMeshBenchmark [--benchmark_...] [shape...]: only those shapes, by their names in the
// table.
#include "benchmarks/support/MeshQuality.h"
#include "benchmarks/support/ResultTable.h"
#include "core/base/Parallel.h"
#include "core/nodes/CurveTree.h"
#include "core/nodes/LatticeMesh.h"
#include "core/nodes/Primitive.h"
#include "core/skeletons/Box.h"
#include "core/skeletons/Circle.h"
#include "core/skeletons/Cone.h"
#include "core/skeletons/ConeSphere.h"
#include "core/skeletons/Cylinder.h"
#include "core/skeletons/Disc.h"
#include "core/skeletons/Ellipsoid.h"
#include "core/skeletons/HollowCylinder.h"
#include "core/skeletons/Point.h"
#include "core/skeletons/Polygon.h"
#include "core/skeletons/Rectangle.h"
#include "core/skeletons/Revolution.h"
#include "core/skeletons/Segment.h"
#include "core/skeletons/Spline.h"
#include "core/skeletons/Triangle.h"

#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkImplicitFunction.h>
#include <vtkMarchingCubes.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkSampleFunction.h>
#include <vtkSphereSource.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace
{

using namespace hybridtree;

constexpr double kTriangles = 57000.0;
constexpr double kSurface = 0.3;
constexpr double kInfluence = 0.6;

using Function = std::function<double(const double*)>;
using DirectMesh = std::function<std::optional<TriangleMesh>(double edgeLength)>;

struct Shape
{
  std::string name;
  Function distance; // to the skeleton, written out, or that of the skeleton
  Function field;    // null: by the distance
  Function error;    // distance to the surface
  DirectMesh direct;
  NodePtr node;
  double edgeLength = 0.0; // for as many triangles as wanted, of the direct mesh
  double latticeCell = 0.0;
  double gridCell = 0.0;
};

class FieldFunction final : public vtkImplicitFunction
{
public:
  static FieldFunction* New();
  using vtkImplicitFunction::EvaluateFunction;
  double EvaluateFunction(double x[3]) override
  {
    if (field)
    {
      return field(x);
    }
    const double d = distance(x);
    const double u = std::max(0.0, 1.0 - d * d / (kInfluence * kInfluence));
    return amplitude * u * u;
  }
  void EvaluateGradient(double[3], double gradient[3]) override { std::fill_n(gradient, 3, 0.0); }

  Function distance;
  Function field;
  double amplitude =
    kThreshold / std::pow(1.0 - kSurface * kSurface / (kInfluence * kInfluence), 2);
};

FieldFunction* FieldFunction::New()
{
  VTK_STANDARD_NEW_BODY(FieldFunction);
}

// The lengths at which a mesher makes the wanted number: triangles go with 1 / length^2.
double lengthFor(const std::function<double(double)>& countAt, double length)
{
  for (int round = 0; round < 4; ++round)
  {
    length *= std::sqrt(countAt(length) / kTriangles);
  }
  return length;
}

template <class Contour>
vtkNew<Contour> contourOf(const Shape& shape, double cell)
{
  vtkNew<FieldFunction> function;
  function->distance = shape.distance;
  function->field = shape.field;
  const Box3 box = shape.node->surfaceBounds();
  int size[3];
  double bounds[6];
  for (int axis = 0; axis < 3; ++axis)
  {
    size[axis] = static_cast<int>(std::ceil(box.sizes()[axis] / cell)) + 3;
    bounds[2 * axis] = box.center()[axis] - 0.5 * cell * (size[axis] - 1);
    bounds[2 * axis + 1] = box.center()[axis] + 0.5 * cell * (size[axis] - 1);
  }
  vtkNew<vtkSampleFunction> sampler;
  sampler->SetImplicitFunction(function);
  sampler->SetSampleDimensions(size);
  sampler->SetModelBounds(bounds);
  sampler->ComputeNormalsOff();
  sampler->SetOutputScalarTypeToFloat();
  vtkNew<Contour> contour;
  contour->SetInputConnection(sampler->GetOutputPort());
  contour->SetValue(0, kThreshold);
  contour->ComputeNormalsOn();
  contour->Update();
  return contour;
}

Function distanceOf(const SkeletonPtr& skeleton)
{
  return [skeleton](const double* x)
  {
    double distance;
    skeleton->distance({ x, x + 1, x + 2, 1 }, &distance);
    return distance;
  };
}

Shape shapeOf(const std::string& name, SkeletonPtr skeleton, Function distance = nullptr)
{
  Shape shape;
  shape.name = name;
  shape.distance = distance ? std::move(distance) : distanceOf(skeleton);
  shape.error = [skeleton](const double* x)
  {
    double distance;
    skeleton->signedDistance({ x, x + 1, x + 2, 1 }, &distance);
    return distance - kSurface;
  };
  shape.direct = [skeleton](double edgeLength)
  { return skeleton->offsetMesh(kSurface, edgeLength); };
  shape.node =
    makePrimitive(std::move(skeleton), Potential::bySurfaceRadius(kSurface, kInfluence, 2));
  return shape;
}

// Five tapering fingers on a palm, blended.
std::vector<SplineCurve> hand()
{
  std::vector<SplineCurve> curves;
  for (int finger = 0; finger < 5; ++finger)
  {
    const double angle = 0.35 * (finger - 2);
    const double length = finger == 4 ? 1.3 : 2.0 - 0.15 * std::abs(finger - 1);
    const Vec3 out(std::sin(angle), std::cos(angle), 0.0);
    const Vec3 foot(0.35 * (finger - 2), 0.0, 0.0);
    curves.push_back(
      { { foot, foot + 0.35 * length * out, foot + Vec3(0.7 * length * out + 0.1 * Vec3::UnitZ()),
          foot + length * out },
        { 0.16, 0.15, 0.13, 0.09 } });
  }
  curves.push_back(
    { { Vec3(-0.9, -0.1, 0.0), Vec3(-0.3, 0.0, -0.1), Vec3(0.3, 0.0, -0.1), Vec3(0.9, -0.1, 0.0) },
      { 0.12, 0.2, 0.2, 0.12 } });
  return curves;
}

// The distance is that to first order: no blend has an exact one.
Shape treeShape(const std::string& name, const std::vector<SplineCurve>& curves)
{
  const CurveTreeOptions options{ Potential::bySurfaceRadius(0.1, 0.2, 2) };
  Shape shape;
  shape.name = name;
  // Made anew each time: a node keeps its meshes.
  shape.direct = [=](double edgeLength)
  { return std::optional<TriangleMesh>(*makeCurveTree(curves, options)->mesh(edgeLength)); };
  const NodePtr tree = makeCurveTree(curves, options);
  shape.node = tree;
  shape.field = [tree](const double* x)
  {
    double value;
    tree->field({ x, x + 1, x + 2, 1 }, &value);
    return value;
  };
  shape.error = [tree](const double* x)
  {
    double value;
    Vec3 gradient;
    tree->fieldAndGradient(
      { x, x + 1, x + 2, 1 }, &value, { &gradient.x(), &gradient.y(), &gradient.z() });
    return (kThreshold - value) / gradient.norm();
  };
  return shape;
}

std::vector<Shape> shapes()
{
  const Vec3 zero = Vec3::Zero();
  const Vec3 up = Vec3::UnitZ();
  std::vector<Vec3> letterL = { Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(2, 1, 0), Vec3(1, 1, 0),
    Vec3(1, 2, 0), Vec3(0, 2, 0) };
  std::vector<Shape> all;
  all.push_back(shapeOf("point", std::make_shared<PointSkeleton>(zero),
    [](const double* x) { return std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]); }));
  all.push_back(shapeOf("circle", std::make_shared<CircleSkeleton>(zero, up, 1.0),
    [](const double* x)
    {
      const double across = std::sqrt(x[0] * x[0] + x[1] * x[1]) - 1.0;
      return std::sqrt(across * across + x[2] * x[2]);
    }));
  all.push_back(shapeOf("box", std::make_shared<BoxSkeleton>(zero, Vec3(1.0, 1.4, 0.8)),
    [](const double* x)
    {
      const double u = std::max(0.0, std::abs(x[0]) - 0.5);
      const double v = std::max(0.0, std::abs(x[1]) - 0.7);
      const double w = std::max(0.0, std::abs(x[2]) - 0.4);
      return std::sqrt(u * u + v * v + w * w);
    }));
  all.push_back(shapeOf("segment", std::make_shared<SegmentSkeleton>(zero, Vec3(2, 0, 0))));
  all.push_back(shapeOf("disc", std::make_shared<DiscSkeleton>(zero, up, 1.0)));
  all.push_back(shapeOf("cylinder", std::make_shared<CylinderSkeleton>(zero, up, 0.6)));
  all.push_back(
    shapeOf("hollow cylinder", std::make_shared<HollowCylinderSkeleton>(zero, up, 1.0, 0.6)));
  all.push_back(shapeOf("cone", std::make_shared<ConeSkeleton>(zero, up, 0.8, 0.2)));
  all.push_back(
    shapeOf("cone sphere", std::make_shared<ConeSphereSkeleton>(zero, Vec3(0, 0, 1.5), 0.6, 0.2)));
  all.push_back(shapeOf(
    "rectangle", std::make_shared<RectangleSkeleton>(zero, Vec3(1.5, 0, 0), Vec3(0, 1, 0))));
  all.push_back(
    shapeOf("triangle", std::make_shared<TriangleSkeleton>(zero, Vec3(2, 0, 0), Vec3(0.4, 1, 0))));
  all.push_back(shapeOf("polygon", std::make_shared<PolygonSkeleton>(letterL)));
  all.push_back(shapeOf("ellipsoid", std::make_shared<EllipsoidSkeleton>(zero, Vec3(1, 0.6, 0.4))));
  SplineCurve wave;
  wave.points = { Vec3(0, 0, 0), Vec3(2, 1, 0), Vec3(4, 0, 1), Vec3(6, 1, 0) };
  all.push_back(shapeOf("spline", makeSpline(wave)));
  // As each line of Curve Skeletons is one.
  wave.radii = { 0.2, 0.0, 0.1, 0.0 };
  all.push_back(shapeOf("spline with radii", makeSpline(wave)));
  RevolutionShape vase; // nowhere more curved than the wall is thick
  vase.profile.points = { Vec3(0.6, -1, 0), Vec3(0.8, -0.4, 0), Vec3(0.5, 0.4, 0),
    Vec3(0.6, 1, 0) };
  all.push_back(shapeOf("surface of revolution", std::make_shared<RevolutionSkeleton>(vase)));
  vase.solid = true;
  all.push_back(shapeOf("solid of revolution", std::make_shared<RevolutionSkeleton>(vase)));
  all.push_back(treeShape("curve skeletons", hand()));
  return all;
}

void chooseSizes(Shape& shape)
{
  shape.edgeLength = lengthFor(
    [&](double length)
    {
      const auto mesh = shape.direct(length);
      return mesh ? double(mesh->triangles.size()) : kTriangles;
    },
    0.03);
  shape.latticeCell = lengthFor(
    [&](double cell) { return double(latticeMesh(*shape.node, cell).triangles.size()); }, 0.02);
  shape.gridCell = lengthFor([&](double cell)
    { return double(contourOf<vtkFlyingEdges3D>(shape, cell)->GetOutput()->GetNumberOfCells()); },
    0.02);
}

// Runs `make` as the benchmark "<shape>/<method>", and measures one of its meshes.
template <class Make>
void add(benchmarks::ResultTable& table, const Shape& shape, const char* method, const Make& make)
{
  const std::string name = shape.name + "/" + method;
  table.add(
    shape.name, method, name, benchmarks::qualityOf(benchmarks::trianglesOf(make()), shape.error));
  benchmark::RegisterBenchmark(name.c_str(),
    [make](benchmark::State& state)
    {
      for (auto _ : state)
      {
        benchmark::DoNotOptimize(make());
      }
    })
    ->Unit(benchmark::kMillisecond);
}

void addAll(benchmarks::ResultTable& table, const Shape& shape)
{
  if (shape.direct(shape.edgeLength))
  {
    add(table, shape, "direct", [shape] { return *shape.direct(shape.edgeLength); });
  }
  add(table, shape, "our marching cubes",
    [shape] { return latticeMesh(*shape.node, shape.latticeCell); });
  add(table, shape, "vtkMarchingCubes",
    [shape] { return contourOf<vtkMarchingCubes>(shape, shape.gridCell); });
  add(table, shape, "vtkFlyingEdges3D",
    [shape] { return contourOf<vtkFlyingEdges3D>(shape, shape.gridCell); });
  if (shape.name == "point")
  {
    add(table, shape, "vtkSphereSource",
      []
      {
        const int steps = static_cast<int>(std::lround(1.0 + std::sqrt(1.0 + 0.5 * kTriangles)));
        vtkNew<vtkSphereSource> sphere;
        sphere->SetRadius(kSurface);
        sphere->SetThetaResolution(steps);
        sphere->SetPhiResolution(steps);
        sphere->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
        sphere->Update();
        return sphere;
      });
  }
}

} // namespace

int main(int argc, char** argv)
{
  benchmark::Initialize(&argc, argv);
  vtkSMPTools::Initialize(1);
  setThreadCount(1);
  benchmarks::ResultTable table;
  const std::vector<std::string> wanted(argv + 1, argv + argc);
  for (Shape& shape : shapes())
  {
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), shape.name) == wanted.end())
    {
      continue;
    }
    chooseSizes(shape);
    addAll(table, shape);
  }
  benchmarks::TableReporter reporter(table);
  benchmark::RunSpecifiedBenchmarks(&reporter);
  table.print();
  return 0;
}
