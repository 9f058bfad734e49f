// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeSkeletonEditor.h"

#include "core/base/Error.h"
#include "core/subdivision/SkeletonGraph.h"
#include "core/subdivision/Subdivide.h"
#include "vtkHybridTreeFormulation.h"
#include "vtkHybridTreeIndexedList.h"
#include "vtkHybridTreeSkeletonData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkHybridTreeSkeletonEditor);

//------------------------------------------------------------------------------
vtkHybridTreeSkeletonEditor::vtkHybridTreeSkeletonEditor()
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(2);
  this->Points = { { -1.5, 0.0, 0.0 }, { -0.6, 0.2, 0.0 }, { 0.0, 0.0, 0.0 }, { 0.8, 0.5, 0.0 },
    { 0.8, -0.5, 0.0 }, { 1.6, 0.0, 0.0 } };
  this->Radii = { { 0.15 } };
  this->Segments = { { 0, 1 }, { 1, 2 } };
  this->Triangles = { { 2, 3, 4 }, { 3, 4, 5 } };
}

vtkHybridTreeSkeletonEditor::~vtkHybridTreeSkeletonEditor() = default;

//------------------------------------------------------------------------------
template <typename List>
void vtkHybridTreeSkeletonEditor::Resize(
  List& list, int count, const typename List::value_type& filler)
{
  if (hybridtree::setCount(list, count, filler))
  {
    this->Modified();
  }
}

//------------------------------------------------------------------------------
template <typename List>
void vtkHybridTreeSkeletonEditor::Set(
  const char* name, List& list, int index, const typename List::value_type& element)
{
  if (!hybridtree::has(list, index))
  {
    vtkErrorMacro("There is no element " << index << ": " << name << " has " << list.size()
                                         << ". Call SetNumberOf" << name << " first.");
  }
  else if (hybridtree::setElement(list, index, element))
  {
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkHybridTreeSkeletonEditor::SetNumberOfPoints(int count)
{
  this->Resize(this->Points, count, {});
}

//------------------------------------------------------------------------------
int vtkHybridTreeSkeletonEditor::GetNumberOfPoints() const
{
  return static_cast<int>(this->Points.size());
}

//------------------------------------------------------------------------------
void vtkHybridTreeSkeletonEditor::SetNumberOfRadii(int count)
{
  this->Resize(this->Radii, count, { 0.1 });
}

//------------------------------------------------------------------------------
int vtkHybridTreeSkeletonEditor::GetNumberOfRadii() const
{
  return static_cast<int>(this->Radii.size());
}

//------------------------------------------------------------------------------
void vtkHybridTreeSkeletonEditor::SetNumberOfSegments(int count)
{
  this->Resize(this->Segments, count, {});
}

//------------------------------------------------------------------------------
int vtkHybridTreeSkeletonEditor::GetNumberOfSegments() const
{
  return static_cast<int>(this->Segments.size());
}

//------------------------------------------------------------------------------
void vtkHybridTreeSkeletonEditor::SetNumberOfTriangles(int count)
{
  this->Resize(this->Triangles, count, {});
}

//------------------------------------------------------------------------------
int vtkHybridTreeSkeletonEditor::GetNumberOfTriangles() const
{
  return static_cast<int>(this->Triangles.size());
}

//------------------------------------------------------------------------------
void vtkHybridTreeSkeletonEditor::SetPoint(int index, double x, double y, double z)
{
  this->Set("Points", this->Points, index, { x, y, z });
}

//------------------------------------------------------------------------------
void vtkHybridTreeSkeletonEditor::SetRadius(int index, double radius)
{
  this->Set("Radii", this->Radii, index, { radius });
}

//------------------------------------------------------------------------------
void vtkHybridTreeSkeletonEditor::SetSegment(int index, int point0, int point1)
{
  this->Set("Segments", this->Segments, index, { point0, point1 });
}

//------------------------------------------------------------------------------
void vtkHybridTreeSkeletonEditor::SetTriangle(int index, int point0, int point1, int point2)
{
  this->Set("Triangles", this->Triangles, index, { point0, point1, point2 });
}

//------------------------------------------------------------------------------
hybridtree::SkeletonGraph vtkHybridTreeSkeletonEditor::MakeGraph() const
{
  if (this->Points.size() < 2)
  {
    throw hybridtree::InvalidParameter(
      "The number of Points", std::to_string(this->Points.size()), "at least 2");
  }
  if (this->Radii.empty())
  {
    throw hybridtree::InvalidParameter("The number of Radii", "0", "at least 1");
  }
  hybridtree::SkeletonGraph graph;
  for (std::size_t k = 0; k < this->Points.size(); ++k)
  {
    graph.points.emplace_back(this->Points[k].data());
    graph.radii.push_back(this->Radii[std::min(k, this->Radii.size() - 1)][0]);
  }
  graph.segments = this->Segments;
  graph.triangles = this->Triangles;
  if (graph.segments.empty() && graph.triangles.empty())
  {
    for (int k = 0; k + 1 < this->GetNumberOfPoints(); ++k)
    {
      graph.segments.push_back({ k, k + 1 });
    }
  }
  hybridtree::validate(graph);
  return graph;
}

//------------------------------------------------------------------------------
int vtkHybridTreeSkeletonEditor::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port)
  {
    outputs->GetInformationObject(port)->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkHybridTreeSkeletonEditor::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkPolyData* coarse = vtkPolyData::GetData(outputs, 0);
  vtkPolyData* refined = vtkPolyData::GetData(outputs, 1);
  coarse->Initialize();
  refined->Initialize();
  if (!hybridtree::isFirstPiece(outputs->GetInformationObject(0)))
  {
    return 1;
  }
  try
  {
    const hybridtree::SkeletonGraph graph = this->MakeGraph();
    hybridtree::toPolyData(graph, coarse);
    hybridtree::toPolyData(
      hybridtree::subdivide(graph, hybridtree::toScheme(this->Scheme), this->Level),
      graph.segments.size(), refined);
    return 1;
  }
  catch (const std::exception& error)
  {
    coarse->Initialize();
    refined->Initialize();
    vtkErrorMacro(<< error.what());
    return 0;
  }
}

//------------------------------------------------------------------------------
void vtkHybridTreeSkeletonEditor::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Points:";
  hybridtree::print(this->Points, os);
  os << "\n" << indent << "Radii:";
  hybridtree::print(this->Radii, os);
  os << "\n" << indent << "Segments:";
  hybridtree::print(this->Segments, os);
  os << "\n" << indent << "Triangles:";
  hybridtree::print(this->Triangles, os);
  os << "\n" << indent << "Scheme: " << this->Scheme << "\n";
  os << indent << "Level: " << this->Level << "\n";
}
