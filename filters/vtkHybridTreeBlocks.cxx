// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeBlocks.h"

#include "core/base/Error.h"
#include "vtkAlgorithm.h"
#include "vtkAppendFilter.h"
#include "vtkAppendPolyData.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkHybridTreeLeaves.h"
#include "vtkHybridTreeProcesses.h"
#include "vtkInformation.h"
#include "vtkInformationStringKey.h"
#include "vtkMultiPieceDataSet.h"
#include "vtkNew.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

bool isPartitioned(vtkDataObject* data)
{
  return vtkMultiPieceDataSet::SafeDownCast(data) || vtkPartitionedDataSet::SafeDownCast(data);
}

vtkSmartPointer<vtkDataSet> withoutGhosts(vtkDataSet* data)
{
  auto* mesh = vtkPolyData::SafeDownCast(data);
  if (!mesh || !mesh->HasAnyGhostCells() || carriedTree(mesh).belongs)
  {
    return data;
  }
  vtkNew<vtkPolyData> own;
  own->ShallowCopy(mesh);
  own->RemoveGhostCells();
  return own;
}

// ---------------------------------------------------------------------------- composite data

std::string nameOf(vtkInformation* about, const std::string& otherwise)
{
  const char* name = about && about->Has(vtkCompositeDataSet::NAME())
    ? about->Get(vtkCompositeDataSet::NAME())
    : nullptr;
  return name && *name ? name : otherwise;
}

void collect(vtkDataObject* data, const std::string& name, std::vector<Block>& blocks);

void collectChildren(vtkDataObjectTree* tree, const std::string& name, std::vector<Block>& blocks)
{
  const auto children = vtk::TakeSmartPointer(tree->NewTreeIterator());
  children->VisitOnlyLeavesOff();
  children->TraverseSubTreeOff();
  children->SkipEmptyNodesOff(); // every process counts alike
  int place = 0;
  for (children->InitTraversal(); !children->IsDoneWithTraversal(); children->GoToNextItem())
  {
    const std::string child = nameOf(tree->GetMetaData(children), std::to_string(place++));
    collect(children->GetCurrentDataObject(), name.empty() ? child : name + "/" + child, blocks);
  }
}

/// Everything below `data`, the empty places too.
void collect(vtkDataObject* data, const std::string& name, std::vector<Block>& blocks)
{
  if (isPartitioned(data))
  {
    std::vector<Block> pieces;
    collectChildren(vtkDataObjectTree::SafeDownCast(data), name, pieces);
    blocks.push_back({ name, joined(pieces) });
  }
  else if (auto* tree = vtkDataObjectTree::SafeDownCast(data))
  {
    collectChildren(tree, name, blocks);
  }
  else if (auto* composite = vtkCompositeDataSet::SafeDownCast(data)) // adaptive grids
  {
    const auto leaves = vtk::TakeSmartPointer(composite->NewIterator());
    for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
    {
      collect(leaves->GetCurrentDataObject(), name, blocks);
    }
  }
  else
  {
    auto* set = vtkDataSet::SafeDownCast(data);
    blocks.push_back({ name, set ? withoutGhosts(set) : nullptr });
  }
}

bool isEmpty(const Block& block)
{
  return !block.data || block.data->GetNumberOfPoints() == 0;
}

} // namespace

void requireGeometry(vtkDataObject* data)
{
  if (data && !vtkDataSet::SafeDownCast(data) && !vtkCompositeDataSet::SafeDownCast(data))
  {
    const bool table = data->GetDataObjectType() == VTK_TABLE;
    throw InvalidGeometry(std::string("It is a ") + data->GetClassName() +
      (table ? ", whose rows are no points yet. Apply Table To Points to it first."
             : ", which has no points and cells of its own. Convert it to a data set first."));
  }
}

std::vector<Block> blocksOf(vtkDataObject* input)
{
  requireGeometry(input); // of one type on all processes, so all of them stop here
  std::vector<Block> blocks;
  if (input)
  {
    collect(input, "", blocks);
  }
  joinProcesses(blocks);
  const bool single = blocks.size() == 1 && blocks.front().name.empty();
  if (!single) // an empty data set is its reader's to complain of; so is a tree without a mesh
  {
    blocks.erase(std::remove_if(blocks.begin(), blocks.end(), isEmpty), blocks.end());
  }
  return blocks;
}

vtkSmartPointer<vtkDataSet> joined(const std::vector<Block>& blocks)
{
  std::vector<vtkDataSet*> sets;
  bool meshesOnly = true;
  for (const Block& block : blocks)
  {
    if (!isEmpty(block))
    {
      sets.push_back(block.data);
      meshesOnly = meshesOnly && vtkPolyData::SafeDownCast(block.data);
    }
  }
  if (sets.empty())
  {
    return blocks.empty() ? nullptr : blocks.front().data;
  }
  if (sets.size() == 1)
  {
    return sets.front();
  }
  if (meshesOnly)
  {
    vtkNew<vtkAppendPolyData> append;
    for (vtkDataSet* set : sets)
    {
      append->AddInputData(vtkPolyData::SafeDownCast(set));
    }
    append->Update();
    return append->GetOutput();
  }
  vtkNew<vtkAppendFilter> append;
  for (vtkDataSet* set : sets)
  {
    append->AddInputData(set);
  }
  append->Update();
  return append->GetOutput();
}

vtkPolyData* requireMesh(vtkDataSet* data)
{
  auto* mesh = vtkPolyData::SafeDownCast(data);
  if (!mesh)
  {
    throw InvalidGeometry(std::string("It is a ") + data->GetClassName() +
      ", which is no surface mesh. Apply Contour to it first, for a surface in its values, or "
      "Extract Surface, for its border.");
  }
  return mesh;
}

void requirePoints(vtkPolyData* input)
{
  if (input->GetNumberOfPoints() == 0)
  {
    throw InvalidGeometry("The input is empty: it has no points. Check the filter it comes from.");
  }
}

void takeComposite(vtkInformation* port)
{
  port->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  port->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
}

} // namespace hybridtree
