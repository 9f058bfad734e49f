// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeSkeletonData.h"

#include "core/base/Error.h"
#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkHybridTreeBlocks.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTriangleFilter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

namespace hybridtree
{
namespace
{

constexpr const char* kRadius = "Radius"; // the array's usual name
constexpr double kAutomatic = 0.03;       // radius, in longest sides of the bounds

/// Collects the points that cells use.
class GraphPoints
{
public:
  GraphPoints(
    vtkPolyData* input, const std::string& radiusArray, double radius, SkeletonGraph& graph)
    : Input(input)
    , Uniform(radius)
    , Graph(graph)
    , Numbers(static_cast<std::size_t>(input->GetNumberOfPoints()), -1)
  {
    if (radiusArray.empty() || radiusArray == "None")
    {
      return;
    }
    const bool automatic = radiusArray == "Automatic";
    this->Radii = input->GetPointData()->GetArray(automatic ? kRadius : radiusArray.c_str());
    if (this->Radii ? this->Radii->GetNumberOfComponents() != 1 ||
          this->Radii->GetNumberOfTuples() < input->GetNumberOfPoints()
                    : !automatic)
    {
      throw InvalidParameter("RadiusArray", radiusArray,
        "a point array of one component of the input, with a value for each point, "
        "\"Automatic\" or \"None\"");
    }
  }

  int Number(vtkIdType id)
  {
    int& number = this->Numbers[static_cast<std::size_t>(id)];
    if (number < 0)
    {
      double p[3];
      this->Input->GetPoint(id, p);
      if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
      {
        throw InvalidGeometry("Point " + std::to_string(id) +
          " of the input has a coordinate that is not finite; correct or remove it.");
      }
      const auto [place, isNew] = this->Places.try_emplace(
        std::make_tuple(p[0], p[1], p[2]), static_cast<int>(this->Graph.points.size()));
      number = place->second;
      if (isNew)
      {
        this->Graph.points.emplace_back(p);
        this->Graph.radii.push_back(this->Radii ? this->Radii->GetComponent(id, 0) : this->Uniform);
      }
    }
    return number;
  }

  /// A radius of 0 everywhere is a share of the skeleton's extent.
  void FitUniformRadius()
  {
    if (this->Radii || this->Uniform != 0.0)
    {
      return;
    }
    Box3 bounds;
    for (const Vec3& p : this->Graph.points)
    {
      bounds.extend(p);
    }
    const double radius = bounds.isEmpty() ? 0.0 : kAutomatic * bounds.sizes().maxCoeff();
    std::fill(this->Graph.radii.begin(), this->Graph.radii.end(), radius);
  }

private:
  vtkPolyData* Input;
  vtkDataArray* Radii = nullptr;
  double Uniform;
  SkeletonGraph& Graph;
  std::vector<int> Numbers;
  std::map<std::tuple<double, double, double>, int> Places;
};

template <std::size_t N>
void readCells(vtkCellArray* cells, GraphPoints& points, std::vector<std::array<int, N>>& elements)
{
  const auto iterator = vtk::TakeSmartPointer(cells->NewIterator());
  for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
  {
    vtkIdType size;
    const vtkIdType* ids;
    iterator->GetCurrentCell(size, ids);
    if (size == static_cast<vtkIdType>(N))
    {
      std::array<int, N> element;
      std::transform(
        ids, ids + size, element.begin(), [&](vtkIdType id) { return points.Number(id); });
      elements.push_back(element);
    }
  }
}

/// Without cells of too few points, of which VTK would make elements of points that are not there.
void dropShortCells(vtkPolyData* data)
{
  const auto kept = [](vtkCellArray* cells, vtkIdType least)
  {
    auto result = vtkSmartPointer<vtkCellArray>::New();
    const auto iterator = vtk::TakeSmartPointer(cells->NewIterator());
    for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
    {
      vtkIdType size;
      const vtkIdType* ids;
      iterator->GetCurrentCell(size, ids);
      if (size >= least)
      {
        result->InsertNextCell(size, ids);
      }
    }
    return result;
  };
  data->SetLines(kept(data->GetLines(), 2));
  data->SetPolys(kept(data->GetPolys(), 3));
  data->SetStrips(kept(data->GetStrips(), 3));
}

template <std::size_t N>
void writeCells(const std::vector<std::array<int, N>>& elements, vtkCellArray* cells)
{
  for (const std::array<int, N>& element : elements)
  {
    cells->InsertNextCell(static_cast<int>(N));
    for (const int point : element)
    {
      cells->InsertCellPoint(point);
    }
  }
}

template <typename Skeleton>
void writeSkeleton(const Skeleton& skeleton, vtkPolyData* output)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& point : skeleton.points)
  {
    points->InsertNextPoint(point.data());
  }
  vtkNew<vtkDoubleArray> radii;
  radii->SetName(kRadius);
  for (const double radius : skeleton.radii)
  {
    radii->InsertNextValue(radius);
  }
  vtkNew<vtkCellArray> lines;
  writeCells(skeleton.segments, lines);
  vtkNew<vtkCellArray> triangles;
  writeCells(skeleton.triangles, triangles);
  output->Initialize();
  output->SetPoints(points);
  output->SetLines(lines);
  output->SetPolys(triangles);
  output->GetPointData()->SetScalars(radii);
}

} // namespace

SkeletonGraph toSkeleton(vtkPolyData* input, const std::string& radiusArray, double radius)
{
  if (input->GetNumberOfLines() + input->GetNumberOfPolys() + input->GetNumberOfStrips() == 0)
  {
    requirePoints(input);
    throw InvalidGeometry("The input has " + std::to_string(input->GetNumberOfPoints()) +
      " points, but neither lines nor polygons, which make the skeleton. Take the Skeleton Editor, "
      "or any polydata with lines or triangles.");
  }
  vtkNew<vtkTriangleFilter> split; // polylines into segments, polygons and strips into triangles
  vtkNew<vtkPolyData> whole;
  whole->SetPoints(input->GetPoints());
  whole->GetPointData()->ShallowCopy(input->GetPointData());
  whole->SetLines(input->GetLines());
  whole->SetPolys(input->GetPolys());
  whole->SetStrips(input->GetStrips());
  dropShortCells(whole);
  split->SetInputData(whole);
  split->PassVertsOff();
  split->Update();
  SkeletonGraph graph;
  GraphPoints points(split->GetOutput(), radiusArray, radius, graph);
  readCells(split->GetOutput()->GetLines(), points, graph.segments);
  readCells(split->GetOutput()->GetPolys(), points, graph.triangles);
  points.FitUniformRadius();
  validate(graph);
  return graph;
}

void toPolyData(const SkeletonGraph& graph, vtkPolyData* output)
{
  writeSkeleton(graph, output);
}

void toPolyData(const RefinedSkeleton& skeleton, std::size_t coarseSegments, vtkPolyData* output)
{
  writeSkeleton(skeleton, output);
  vtkNew<vtkIntArray> parents;
  parents->SetName("CoarseElement");
  for (const int parent : skeleton.segmentParents)
  {
    parents->InsertNextValue(parent);
  }
  for (const int parent : skeleton.triangleParents)
  {
    parents->InsertNextValue(static_cast<int>(coarseSegments) + parent);
  }
  output->GetCellData()->AddArray(parents);
}

SubdivisionScheme toScheme(int scheme)
{
  if (scheme != 0 && scheme != 1)
  {
    throw InvalidParameter("Scheme", scheme, "0 (approximating) or 1 (interpolating)");
  }
  return scheme == 0 ? SubdivisionScheme::Approximating : SubdivisionScheme::Interpolating;
}

} // namespace hybridtree
