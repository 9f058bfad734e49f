// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeBlocks.h"

#include "vtkAlgorithm.h"
#include "vtkAppendFilter.h"
#include "vtkAppendPolyData.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkFieldData.h"
#include "vtkHybridTreeConvert.h"
#include "vtkHybridTreeLeaves.h"
#include "vtkInformation.h"
#include "vtkInformationStringKey.h"
#include "vtkMultiPieceDataSet.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
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

// ---------------------------------------------------------------------------- several processes

bool carriesTree(vtkDataSet* data)
{
  auto* mesh = vtkPolyData::SafeDownCast(data);
  return mesh && carriedTree(mesh).belongs;
}

/// Tells, as far as is needed here, whether two processes hold the same.
vtkTypeUInt64 signatureOf(vtkDataSet* data)
{
  if (auto* mesh = vtkPolyData::SafeDownCast(data))
  {
    return fingerprint(mesh);
  }
  vtkNew<vtkPolyData> stand;
  if (auto* set = vtkPointSet::SafeDownCast(data))
  {
    stand->SetPoints(set->GetPoints());
  }
  else if (data)
  {
    double bounds[6];
    data->GetBounds(bounds);
    vtkNew<vtkPoints> corners;
    corners->InsertNextPoint(bounds[0], bounds[2], bounds[4]);
    corners->InsertNextPoint(bounds[1], bounds[3], bounds[5]);
    corners->InsertNextPoint(static_cast<double>(data->GetNumberOfPoints()), 0.0, 0.0);
    stand->SetPoints(corners);
  }
  return fingerprint(stand);
}

template <class Value>
std::vector<Value> fromAll(vtkMultiProcessController* controller, Value mine)
{
  std::vector<Value> all(static_cast<std::size_t>(controller->GetNumberOfProcesses()));
  controller->AllGather(&mine, all.data(), 1);
  return all;
}

template <class Value>
bool sameForAll(vtkMultiProcessController* controller, Value mine)
{
  const std::vector<Value> all = fromAll(controller, mine);
  return std::all_of(all.begin(), all.end(), [&](Value other) { return other == all.front(); });
}

void joinProcesses(vtkMultiProcessController* controller, Block& block)
{
  const bool carried = carriesTree(block.data);
  const vtkTypeUInt64 mine = carried ? 0 : signatureOf(block.data);
  if (sameForAll(controller, static_cast<unsigned long long>(mine)))
  {
    return;
  }
  vtkNew<vtkPolyData> nothing;
  vtkSmartPointer<vtkDataSet> part = nothing.Get();
  if (block.data)
  {
    part = vtk::TakeSmartPointer(block.data->NewInstance());
    part->ShallowCopy(block.data);
    part->GetFieldData()->Initialize();
  }
  std::vector<vtkSmartPointer<vtkDataObject>> received;
  controller->AllGather(part.Get(), received);
  std::vector<Block> parts;
  for (const auto& one : received)
  {
    parts.push_back({ block.name, vtkDataSet::SafeDownCast(one) });
  }
  block.data = joined(parts);
}

void joinProcesses(vtkMultiProcessController* controller, std::vector<Block>& blocks)
{
  const std::vector<int> counts = fromAll(controller, static_cast<int>(blocks.size()));
  blocks.resize(static_cast<std::size_t>(*std::max_element(counts.begin(), counts.end())));
  for (Block& block : blocks)
  {
    joinProcesses(controller, block);
  }
}

bool isEmpty(const Block& block)
{
  return !block.data || block.data->GetNumberOfPoints() == 0;
}

} // namespace

std::vector<Block> blocksOf(vtkDataObject* input)
{
  std::vector<Block> blocks;
  if (input)
  {
    collect(input, "", blocks);
  }
  auto* controller = vtkMultiProcessController::GetGlobalController();
  if (controller && controller->GetNumberOfProcesses() > 1)
  {
    joinProcesses(controller, blocks);
  }
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

void takeComposite(vtkInformation* port)
{
  port->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
}

} // namespace hybridtree
