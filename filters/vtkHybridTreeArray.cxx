// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeArray.h"

#include "core/base/Error.h"
#include "core/tree/Serialize.h"
#include "vtkFieldData.h"
#include "vtkHybridTreeConvert.h"
#include "vtkHybridTreeLeaves.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkHybridTreeArray);

//------------------------------------------------------------------------------
vtkHybridTreeArray::vtkHybridTreeArray()
{
  this->SetName("HybridTree");
}

vtkHybridTreeArray::~vtkHybridTreeArray() = default;

//------------------------------------------------------------------------------
void vtkHybridTreeArray::PutTree(const NodePtr& tree, vtkPolyData* mesh)
{
  vtkNew<vtkHybridTreeArray> array;
  array->Tree = tree;
  array->InsertNextValue(hybridtree::toText(*tree));
  array->InsertNextValue(hybridtree::fingerprintText(mesh));
  mesh->GetFieldData()->AddArray(array);
  hybridtree::putMeshes(*tree, mesh->GetFieldData());
}

//------------------------------------------------------------------------------
void vtkHybridTreeArray::PutLeaf(const NodePtr& leaf, vtkPolyData* mesh)
{
  vtkHybridTreeArray::PutTree(leaf, mesh);
  hybridtree::ConvertedMesh itself;
  itself.repaired.mesh = leaf->leafMesh();
  itself.repaired.pointMap.resize(itself.repaired.mesh->points.size());
  std::iota(itself.repaired.pointMap.begin(), itself.repaired.pointMap.end(), 0);
  itself.cells.resize(itself.repaired.mesh->triangles.size());
  std::iota(itself.cells.begin(), itself.cells.end(), vtkIdType(0));
  std::vector<std::string> none; // arrays that are too short are told by whoever made them
  hybridtree::putArrays(
    hybridtree::arraysOf(mesh, itself, none), hybridtree::leavesOf(*leaf), mesh->GetFieldData());
}

//------------------------------------------------------------------------------
vtkHybridTreeArray::NodePtr vtkHybridTreeArray::FindTree(vtkPolyData* mesh)
{
  const hybridtree::CarriedTree carried = hybridtree::carriedTree(mesh);
  if (!carried.belongs || carried.live)
  {
    return carried.live;
  }
  return hybridtree::fromText(carried.text, hybridtree::meshesIn(mesh->GetFieldData()));
}

//------------------------------------------------------------------------------
std::string vtkHybridTreeArray::GetText(vtkPolyData* mesh)
{
  return hybridtree::carriedTree(mesh).text;
}

//------------------------------------------------------------------------------
void vtkHybridTreeArray::DeepCopy(vtkAbstractArray* source)
{
  this->Superclass::DeepCopy(source);
  auto* other = vtkHybridTreeArray::SafeDownCast(source);
  this->Tree = other ? other->Tree : nullptr;
}

//------------------------------------------------------------------------------
void vtkHybridTreeArray::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Tree: " << (this->Tree ? this->Tree->kind() : "(none)") << "\n";
}

namespace hybridtree
{

std::string fingerprintText(vtkPolyData* mesh)
{
  constexpr char digits[] = "0123456789abcdef";
  vtkTypeUInt64 rest = fingerprint(mesh);
  std::string text(16, '0');
  for (std::size_t k = text.size(); k-- > 0; rest >>= 4)
  {
    text[k] = digits[rest & 15u];
  }
  return text;
}

namespace
{

bool isFingerprint(const std::string& text)
{
  return text.size() == 16 &&
    std::all_of(text.begin(), text.end(), [](unsigned char digit) { return std::isxdigit(digit); });
}

} // namespace

CarriedTree carriedTree(vtkPolyData* mesh)
{
  CarriedTree carried;
  vtkAbstractArray* any = mesh->GetFieldData()->GetAbstractArray("HybridTree");
  auto* array = vtkStringArray::SafeDownCast(any);
  if (any && (!array || array->GetNumberOfValues() != 2 || !isFingerprint(array->GetValue(1))))
  {
    throw InvalidText("The field-data array \"HybridTree\" is damaged: it must hold the text of a "
                      "tree and a fingerprint of 16 digits. Save the file again from the filter "
                      "that made it, or remove the array to use the plain mesh.");
  }
  if (array && array->GetValue(1) == fingerprintText(mesh))
  {
    carried.belongs = true;
    carried.text = array->GetValue(0);
    auto* live = vtkHybridTreeArray::SafeDownCast(array);
    carried.live = live ? live->GetTree() : nullptr;
  }
  return carried;
}

} // namespace hybridtree
