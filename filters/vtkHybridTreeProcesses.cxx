// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeProcesses.h"

#include "core/base/Error.h"
#include "vtkAlgorithm.h"
#include "vtkCommunicator.h"
#include "vtkFieldData.h"
#include "vtkHybridTreeAbort.h"
#include "vtkHybridTreeConvert.h"
#include "vtkHybridTreeLeaves.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

/// Null where this process is alone.
vtkMultiProcessController* manyProcesses()
{
  auto* controller = vtkMultiProcessController::GetGlobalController();
  return controller && controller->GetNumberOfProcesses() > 1 ? controller : nullptr;
}

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
    vtkNew<vtkPolyData> curves; // a fingerprint is of surfaces
    curves->SetPolys(mesh->GetLines());
    curves->SetStrips(mesh->GetVerts());
    return fingerprint(mesh) + 3 * fingerprint(curves);
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

} // namespace

void joinProcesses(std::vector<Block>& blocks)
{
  vtkMultiProcessController* const controller = manyProcesses();
  if (!controller)
  {
    return;
  }
  const std::vector<int> counts = fromAll(controller, static_cast<int>(blocks.size()));
  blocks.resize(static_cast<std::size_t>(*std::max_element(counts.begin(), counts.end())));
  for (Block& block : blocks)
  {
    joinProcesses(controller, block);
  }
}

int runOnAll(
  vtkAlgorithm* filter, const std::function<void()>& work, const std::function<void()>& clear)
{
  int done = 0;
  try
  {
    work();
    done = 1;
  }
  catch (const Cancelled&) // the user's wish, not an error
  {
    clear();
    haveStopped(filter);
    done = 1;
  }
  catch (const std::exception& error)
  {
    vtkErrorWithObjectMacro(filter, << error.what());
  }
  vtkMultiProcessController* const controller = manyProcesses();
  if (controller && filter->GetTotalNumberOfInputConnections() > 0)
  {
    const int mine = done;
    controller->AllReduce(&mine, &done, 1, vtkCommunicator::MIN_OP);
  }
  if (!done)
  {
    clear();
  }
  return done;
}

} // namespace hybridtree
