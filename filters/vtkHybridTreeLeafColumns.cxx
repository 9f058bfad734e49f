// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeLeafColumns.h"

#include "vtkAbstractArray.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkMath.h"
#include "vtkNew.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

bool isReal(vtkAbstractArray* array)
{
  return array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE;
}

/// Values at the vertices that lie on leaves.
class VertexValues
{
public:
  VertexValues(const std::vector<VertexOrigin>& places, const std::vector<Leaf>& leaves)
    : places_(places), leaves_(leaves)
  {
    ids_->SetNumberOfIds(3);
  }

  bool fill(const LeafColumn& column, vtkAbstractArray* result) const
  {
    const bool real = isReal(result);
    bool all = true;
    for (std::size_t v = 0; v < places_.size(); ++v)
    {
      const VertexOrigin& origin = places_[v];
      vtkAbstractArray* source = origin.leaf < 0 || origin.triangle < 0
        ? nullptr
        : column.sources[static_cast<std::size_t>(origin.leaf)];
      if (source)
      {
        this->set(static_cast<vtkIdType>(v), origin, source, real, result);
      }
      all = all && source;
    }
    return all;
  }

private:
  void set(vtkIdType row, const VertexOrigin& origin, vtkAbstractArray* source, bool real,
    vtkAbstractArray* result) const
  {
    const Triangle& corners = leaves_[static_cast<std::size_t>(origin.leaf)]
                                .mesh->triangles[static_cast<std::size_t>(origin.triangle)];
    double weights[3] = { 1.0 - origin.u - origin.v, origin.u, origin.v };
    const auto nearest = std::max_element(weights, weights + 3) - weights;
    if (!real || weights[nearest] == 1.0)
    {
      result->SetTuple(row, corners[static_cast<std::size_t>(nearest)], source);
      return;
    }
    for (int k = 0; k < 3; ++k)
    {
      ids_->SetId(k, corners[static_cast<std::size_t>(k)]);
    }
    result->InterpolateTuple(row, ids_, source, weights);
  }

  const std::vector<VertexOrigin>& places_;
  const std::vector<Leaf>& leaves_;
  vtkNew<vtkIdList> ids_;
};

} // namespace

vtkSmartPointer<vtkAbstractArray> arrayLike(vtkAbstractArray* other, const std::string& name)
{
  auto array = vtk::TakeSmartPointer(vtkAbstractArray::CreateArray(other->GetDataType()));
  array->SetName(name.c_str());
  array->SetNumberOfComponents(other->GetNumberOfComponents());
  array->CopyComponentNames(other);
  return array;
}

void fillWithNothing(vtkAbstractArray* array)
{
  if (auto* numbers = vtkDataArray::SafeDownCast(array))
  {
    numbers->Fill(isReal(array) ? vtkMath::Nan() : 0.0);
  }
}

vtkSmartPointer<vtkAbstractArray> startColumn(
  const std::string& name, LeafColumn& column, std::size_t rows, std::vector<std::string>& untold)
{
  vtkSmartPointer<vtkAbstractArray> result;
  for (vtkAbstractArray*& source : column.sources)
  {
    if (!source)
    {
      continue;
    }
    if (!result)
    {
      result = arrayLike(source, name);
    }
    else if (source->GetNumberOfComponents() != result->GetNumberOfComponents() ||
      (source->GetDataType() != result->GetDataType() &&
        !(source->IsNumeric() && result->IsNumeric())))
    {
      source = nullptr;
      untold.push_back("The array \"" + name +
        "\" is not of the same kind on all input meshes; that of the first is passed.");
    }
    else if (source->GetDataType() != result->GetDataType())
    {
      column.converted.push_back(arrayLike(result, name));
      column.converted.back()->DeepCopy(source);
      source = column.converted.back();
    }
  }
  result->SetNumberOfTuples(static_cast<vtkIdType>(rows));
  fillWithNothing(result);
  return result;
}

bool fillPoints(const std::vector<VertexOrigin>& places, const std::vector<Leaf>& leaves,
  const LeafColumn& column, vtkAbstractArray* result)
{
  return VertexValues(places, leaves).fill(column, result);
}

bool fillCells(
  const std::vector<VertexOrigin>& places, const LeafColumn& column, vtkAbstractArray* result)
{
  bool all = true;
  for (std::size_t t = 0; t < places.size(); ++t)
  {
    const auto& [leaf, triangle, u, v] = places[t];
    vtkAbstractArray* source =
      leaf < 0 || triangle < 0 ? nullptr : column.sources[static_cast<std::size_t>(leaf)];
    if (source)
    {
      result->SetTuple(static_cast<vtkIdType>(t), triangle, source);
    }
    all = all && source;
  }
  return all;
}

} // namespace hybridtree
