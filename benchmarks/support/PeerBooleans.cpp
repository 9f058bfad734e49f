// SPDX-License-Identifier: BSD-3-Clause
#include "benchmarks/support/PeerBooleans.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <vtkBooleanOperationPolyDataFilter.h>
#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkLoopBooleanPolyDataFilter.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <exception>

namespace hybridtree::benchmark
{
namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace PMP = CGAL::Polygon_mesh_processing;

CgalMesh toCgal(const TriangleMesh& mesh)
{
  CgalMesh result;
  std::vector<CgalMesh::Vertex_index> vertex;
  for (const Vec3& p : mesh.points)
  {
    vertex.push_back(result.add_vertex({ p.x(), p.y(), p.z() }));
  }
  for (const Triangle& c : mesh.triangles)
  {
    result.add_face(
      vertex[std::size_t(c[0])], vertex[std::size_t(c[1])], vertex[std::size_t(c[2])]);
  }
  return result;
}

class CgalCorefinement final : public PeerBoolean
{
public:
  CgalCorefinement(const TriangleMesh& a, const TriangleMesh& b) : a_(toCgal(a)), b_(toCgal(b)) {}

  const char* name() const override { return "CGAL corefinement"; }
  void prepare() override
  {
    workA_ = a_;
    workB_ = b_;
    result_ = {};
  }
  bool run(MeshOperation operation) override
  {
    try
    {
      switch (operation)
      {
        case MeshOperation::Union:
          return PMP::corefine_and_compute_union(workA_, workB_, result_);
        case MeshOperation::Intersection:
          return PMP::corefine_and_compute_intersection(workA_, workB_, result_);
        case MeshOperation::Difference:
          break;
      }
      return PMP::corefine_and_compute_difference(workA_, workB_, result_);
    }
    catch (const std::exception&)
    {
      return false;
    }
  }
  TriangleMesh result() const override
  {
    CgalMesh packed = result_;
    packed.collect_garbage();
    TriangleMesh mesh;
    for (const auto v : packed.vertices())
    {
      const auto& p = packed.point(v);
      mesh.points.emplace_back(p.x(), p.y(), p.z());
    }
    for (const auto f : packed.faces())
    {
      Triangle corner{};
      std::size_t k = 0;
      for (const auto v : CGAL::vertices_around_face(packed.halfedge(f), packed))
      {
        corner[k++] = std::int32_t(v);
      }
      mesh.triangles.push_back(corner);
    }
    return mesh;
  }

private:
  CgalMesh a_, b_, workA_, workB_, result_;
};

vtkSmartPointer<vtkPolyData> toVtk(const TriangleMesh& mesh)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& p : mesh.points)
  {
    points->InsertNextPoint(p.data());
  }
  vtkNew<vtkCellArray> polygons;
  for (const Triangle& c : mesh.triangles)
  {
    polygons->InsertNextCell({ c[0], c[1], c[2] });
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(points);
  result->SetPolys(polygons);
  return result;
}

// Both filters of VTK, which share names.
template <class Filter>
class VtkBoolean final : public PeerBoolean
{
public:
  VtkBoolean(const char* name, const TriangleMesh& a, const TriangleMesh& b)
    : name_(name), a_(toVtk(a)), b_(toVtk(b))
  {
    vtkObject::GlobalWarningDisplayOff();
  }

  const char* name() const override { return name_; }
  void prepare() override
  {
    filter_ = vtkSmartPointer<Filter>::New();
    filter_->SetInputData(0, a_);
    filter_->SetInputData(1, b_);
  }
  bool run(MeshOperation operation) override
  {
    switch (operation)
    {
      case MeshOperation::Union:
        filter_->SetOperationToUnion();
        break;
      case MeshOperation::Intersection:
        filter_->SetOperationToIntersection();
        break;
      case MeshOperation::Difference:
        filter_->SetOperationToDifference();
        break;
    }
    filter_->Update();
    return true;
  }
  TriangleMesh result() const override
  {
    vtkPolyData* output = filter_->GetOutput();
    TriangleMesh mesh;
    for (vtkIdType k = 0; k < output->GetNumberOfPoints(); ++k)
    {
      Vec3 p;
      output->GetPoint(k, p.data());
      mesh.points.push_back(p);
    }
    vtkNew<vtkIdList> corners;
    for (vtkIdType t = 0; t < output->GetNumberOfCells(); ++t)
    {
      output->GetCellPoints(t, corners);
      for (vtkIdType k = 2; k < corners->GetNumberOfIds(); ++k)
      {
        mesh.triangles.push_back({ std::int32_t(corners->GetId(0)),
          std::int32_t(corners->GetId(k - 1)), std::int32_t(corners->GetId(k)) });
      }
    }
    return mesh;
  }

private:
  const char* name_;
  vtkSmartPointer<vtkPolyData> a_, b_;
  vtkSmartPointer<Filter> filter_;
};

} // namespace

std::unique_ptr<PeerBoolean> cgalCorefinement(const TriangleMesh& a, const TriangleMesh& b)
{
  return std::make_unique<CgalCorefinement>(a, b);
}

std::unique_ptr<PeerBoolean> vtkLoopBoolean(const TriangleMesh& a, const TriangleMesh& b)
{
  return std::make_unique<VtkBoolean<vtkLoopBooleanPolyDataFilter>>(
    "vtkLoopBooleanPolyDataFilter", a, b);
}

std::unique_ptr<PeerBoolean> vtkBooleanOperation(const TriangleMesh& a, const TriangleMesh& b)
{
  return std::make_unique<VtkBoolean<vtkBooleanOperationPolyDataFilter>>(
    "vtkBooleanOperationPolyDataFilter", a, b);
}

bool crossesItself(const TriangleMesh& mesh)
{
  return PMP::does_self_intersect(toCgal(mesh));
}

} // namespace hybridtree::benchmark
