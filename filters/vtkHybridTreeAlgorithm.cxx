// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeAlgorithm.h"

#include "core/base/Error.h"
#include "core/mesh/SharpShare.h"
#include "core/mesh/SplitSharp.h"
#include "core/mesh/TriangleMesh.h"
#include "core/nodes/MeshLimits.h"
#include "core/nodes/Node.h"
#include "vtkDataArray.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkHybridTreeArray.h"
#include "vtkHybridTreeBlocks.h"
#include "vtkHybridTreeConvert.h"
#include "vtkHybridTreeFormulation.h"
#include "vtkHybridTreeLeaves.h"
#include "vtkHybridTreeOperand.h"
#include "vtkHybridTreeProcesses.h"
#include "vtkHybridTreeProgress.h"
#include "vtkHybridTreeWarnings.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationIntegerRequestKey.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <utility>

vtkInformationKeyMacro(vtkHybridTreeAlgorithm, TAKES_TREE, Integer);

/// What a filter remembers from run to run.
struct vtkHybridTreeAlgorithm::State
{
  /// By port and connection; only during a run.
  std::vector<std::vector<std::vector<hybridtree::Block>>> Data;
  std::vector<vtkSmartPointer<vtkDataSet>> Joined;      ///< of Data; only during a run
  std::vector<std::vector<hybridtree::Operand>> Inputs; ///< read from Data
  NodePtr Node;
  vtkMTimeType NodeTime = 0; ///< modification time of the filter that Node belongs to
  Operands NodeOperands;     ///< operands that Node was made from
  hybridtree::FormulationRequest Asked;
  hybridtree::ToldWarnings Told;
  std::vector<vtkSmartPointer<vtkDataArray>> FieldArrays; ///< of the last output
};

namespace
{

/// Takes an array of the last run for one that shares the same values. VTK keeps ranges with the
/// array, and ParaView asks for those of all arrays after every update.
void reuseArrays(std::vector<vtkSmartPointer<vtkDataArray>>& last, vtkFieldData* data)
{
  std::vector<vtkSmartPointer<vtkDataArray>> arrays;
  for (int k = 0; k < data->GetNumberOfArrays(); ++k)
  {
    vtkDataArray* array = data->GetArray(k);
    if (!array || !array->GetName())
    {
      continue;
    }
    const std::string name = array->GetName();
    const auto same = std::find_if(last.begin(), last.end(),
      [&](const auto& other)
      {
        return name == other->GetName() && array->GetVoidPointer(0) == other->GetVoidPointer(0) &&
          array->GetNumberOfValues() == other->GetNumberOfValues();
      });
    arrays.emplace_back(same == last.end() ? array : same->Get());
    data->AddArray(arrays.back()); // in the place of its namesake
  }
  last.swap(arrays);
}

} // namespace

//------------------------------------------------------------------------------
vtkHybridTreeAlgorithm::vtkHybridTreeAlgorithm() : Internals(new State) {}

vtkHybridTreeAlgorithm::~vtkHybridTreeAlgorithm() = default;

//------------------------------------------------------------------------------
vtkInformationIntegerRequestKey* vtkHybridTreeAlgorithm::FORMULATION()
{
  return hybridtree::formulationKey();
}

//------------------------------------------------------------------------------
vtkHybridTreeAlgorithm::NodePtr vtkHybridTreeAlgorithm::GetTree() const
{
  return this->Internals->Node;
}

//------------------------------------------------------------------------------
void vtkHybridTreeAlgorithm::SetEdgeLength(double length)
{
  if (length == this->EdgeLength)
  {
    return;
  }
  this->EdgeLength = length;
  if (this->NodeDependsOnEdgeLength())
  {
    this->Modified();
  }
  else
  {
    this->ModifiedButTheNode();
  }
}

//------------------------------------------------------------------------------
void vtkHybridTreeAlgorithm::SetPointNormals(int when)
{
  when = std::clamp(when, int(NORMALS_AUTOMATIC), int(NORMALS_SPLIT));
  if (when != this->PointNormals)
  {
    this->PointNormals = when;
    this->ModifiedButTheNode();
  }
}

//------------------------------------------------------------------------------
// For what the node does not depend on: it stays, with all that it has computed.
void vtkHybridTreeAlgorithm::ModifiedButTheNode()
{
  const bool nodeIsCurrent = this->Internals->NodeTime == this->GetMTime();
  this->Modified();
  if (nodeIsCurrent)
  {
    this->Internals->NodeTime = this->GetMTime();
  }
}

//------------------------------------------------------------------------------
int vtkHybridTreeAlgorithm::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(TAKES_TREE(), 1);
  const int filled = this->Superclass::FillInputPortInformation(port, info);
  hybridtree::takeComposite(info);
  return filled;
}

//------------------------------------------------------------------------------
int vtkHybridTreeAlgorithm::ModifyRequest(vtkInformation*, int when)
{
  hybridtree::FormulationRequest& asked = this->Internals->Asked;
  when == vtkExecutive::BeforeForward ? asked.send(this) : asked.takeBack();
  return 1;
}

//------------------------------------------------------------------------------
int vtkHybridTreeAlgorithm::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkInformation* output = outputs->GetInformationObject(port);
    output->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
    hybridtree::mergeTimes(this->GetNumberOfInputPorts(), inputs, output);
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkHybridTreeAlgorithm::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
  {
    hybridtree::askWhole(port, inputs);
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkHybridTreeAlgorithm::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  ++this->NumberOfExecutions;
  const auto work = [&]
  {
    this->CollectInputs(inputs);
    this->Run(outputs);
  };
  const int done = hybridtree::runOnAll(this, work, [&] { Clear(outputs); });
  this->ForgetInputs();
  if (!done)
  {
    this->Internals->Node = nullptr;
  }
  return done;
}

//------------------------------------------------------------------------------
void vtkHybridTreeAlgorithm::Run(vtkInformationVector* outputs)
{
  vtkInformation* info = outputs->GetInformationObject(0);
  if (!hybridtree::isFirstPiece(info))
  {
    Clear(outputs);
    return;
  }
  hybridtree::requireEdgeLength(this->EdgeLength);
  const hybridtree::FilterProgress progress(this);
  this->UpdateNode(hybridtree::ProgressPart(progress, 0.0, hybridtree::kReadingShare));
  this->WriteOutput(vtkPolyData::GetData(info),
    hybridtree::requested(info) == hybridtree::Formulation::Mesh,
    hybridtree::ProgressPart(progress, hybridtree::kReadingShare, 1.0));
  this->FillOtherOutputs(outputs);
  this->Warn(this->Internals->Node->warnings());
}

//------------------------------------------------------------------------------
void vtkHybridTreeAlgorithm::CollectInputs(vtkInformationVector** inputs)
{
  auto& data = this->Internals->Data;
  data.assign(static_cast<std::size_t>(this->GetNumberOfInputPorts()), {});
  for (std::size_t port = 0; port < data.size(); ++port)
  {
    const int count = inputs[port]->GetNumberOfInformationObjects();
    for (int k = 0; k < count; ++k)
    {
      try
      {
        data[port].push_back(hybridtree::blocksOf(vtkDataObject::GetData(inputs[port], k)));
      }
      catch (const hybridtree::Error& error)
      {
        this->ComplainOfInput(port, count > 1 ? k + 1 : 0, error);
      }
    }
  }
}

//------------------------------------------------------------------------------
std::string vtkHybridTreeAlgorithm::CalledInput(std::size_t port, int number)
{
  return this->InputName(static_cast<int>(port)) +
    (number > 0 ? " " + std::to_string(number) : std::string());
}

//------------------------------------------------------------------------------
void vtkHybridTreeAlgorithm::ComplainOfInput(
  std::size_t port, int number, const hybridtree::Error& error)
{
  throw hybridtree::InvalidGeometry(this->CalledInput(port, number) + ": " + error.what());
}

//------------------------------------------------------------------------------
void vtkHybridTreeAlgorithm::ForgetInputs()
{
  this->Internals->Data.clear();
  this->Internals->Joined.clear();
}

//------------------------------------------------------------------------------
vtkPolyData* vtkHybridTreeAlgorithm::GetWholeInput(int port)
{
  State& state = *this->Internals;
  const auto& connections = state.Data[static_cast<std::size_t>(port)];
  if (connections.empty())
  {
    return nullptr;
  }
  state.Joined.push_back(hybridtree::joined(connections.front()));
  if (!state.Joined.back())
  {
    return nullptr;
  }
  vtkPolyData* whole = hybridtree::requireMesh(state.Joined.back());
  hybridtree::requireValidCells(whole);
  return whole;
}

//------------------------------------------------------------------------------
vtkHybridTreeAlgorithm::Operands vtkHybridTreeAlgorithm::ReadOperands(
  std::vector<std::string>& warnings, const hybridtree::Progress& progress)
{
  const std::size_t ports = this->Internals->Data.size();
  Operands operands(ports);
  this->Internals->Inputs.resize(ports);
  for (std::size_t port = 0; port < ports; ++port)
  {
    if (this->TakesNodes(static_cast<int>(port)))
    {
      const double share = 1.0 / static_cast<double>(ports);
      operands[port] = this->ReadPort(
        port, warnings, hybridtree::ProgressPart(progress, share * port, share * (port + 1)));
    }
  }
  return operands;
}

//------------------------------------------------------------------------------
std::vector<vtkHybridTreeAlgorithm::NodePtr> vtkHybridTreeAlgorithm::ReadPort(
  std::size_t port, std::vector<std::string>& warnings, const hybridtree::Progress& progress)
{
  vtkInformation* about = this->GetInputPortInformation(static_cast<int>(port));
  const bool takesTree = about->Get(TAKES_TREE()) != 0;
  const bool takesMany = about->Get(vtkAlgorithm::INPUT_IS_REPEATABLE()) != 0;
  const auto& data = this->Internals->Data[port];
  std::vector<hybridtree::Operand>& connections = this->Internals->Inputs[port];
  connections.resize(data.size());
  std::vector<NodePtr> nodes;
  for (std::size_t k = 0; k < connections.size(); ++k)
  {
    const int number = connections.size() > 1 ? static_cast<int>(k) + 1 : 0;
    const double share = 1.0 / static_cast<double>(connections.size());
    const hybridtree::ProgressPart part(progress, share * k, share * (k + 1));
    this->SetProgressText(("Reading " + this->CalledInput(port, number)).c_str());
    try
    {
      takesTree ? connections[k].read(data[k], warnings, part)
                : connections[k].readMesh(data[k], this->ClosesHoles(), warnings, part);
    }
    catch (const hybridtree::Cancelled&)
    {
      throw;
    }
    catch (const hybridtree::Error& error)
    {
      this->ComplainOfInput(port, number, error);
    }
    const std::vector<NodePtr>& shapes = connections[k].nodes();
    takesMany ? void(nodes.insert(nodes.end(), shapes.begin(), shapes.end()))
              : nodes.push_back(connections[k].node());
  }
  return nodes;
}

//------------------------------------------------------------------------------
void vtkHybridTreeAlgorithm::UpdateNode(const hybridtree::Progress& progress)
{
  State& state = *this->Internals;
  std::vector<std::string> warnings;
  Operands operands;
  const hybridtree::OwnProgressText text(this);
  try
  {
    operands = this->ReadOperands(warnings, progress);
  }
  catch (const hybridtree::Cancelled&)
  {
    state.Inputs.clear(); // or what they have to tell would be lost
    throw;
  }
  const bool othersChanged = this->ReadOtherInputs();
  if (othersChanged || !state.Node || state.NodeTime != this->GetMTime() ||
    state.NodeOperands != operands)
  {
    // Held until the next one is there, which takes over what both have, such as images under a
    // map.
    const NodePtr before = std::exchange(state.Node, nullptr);
    state.Told.startNode();
    this->Warn(warnings);
    state.Node = this->MakeNode(operands);
    state.NodeOperands = std::move(operands);
    state.NodeTime = this->GetMTime();
  }
}

//------------------------------------------------------------------------------
void vtkHybridTreeAlgorithm::WriteOutput(
  vtkPolyData* output, bool withMesh, const hybridtree::Progress& progress)
{
  State& state = *this->Internals;
  hybridtree::LeafArrays arrays;
  for (const auto& port : state.Inputs)
  {
    for (const hybridtree::Operand& operand : port)
    {
      this->Warn(hybridtree::mergeArrays(operand.arrays(), arrays));
    }
  }
  const std::vector<hybridtree::Leaf> leaves = hybridtree::leavesOf(*state.Node);

  // The executive has passed the first input's field data on; its tree is not ours.
  hybridtree::removeLeaves(output->GetFieldData());
  if (withMesh)
  {
    ++this->NumberOfMeshings;
    const MeshPtr mesh = this->MakeMesh(*state.Node, progress);
    this->WarnOfLostShape(*mesh);
    this->WarnOfTinyOperands();
    const bool splits = this->PointNormals == NORMALS_SPLIT;
    const MeshPtr shown = splits ? hybridtree::splitAtSharpEdges(mesh) : mesh;
    hybridtree::toPolyData(shown, splits || this->NeedsNormals(*mesh), output);
    this->Warn(hybridtree::passArrays(arrays, *state.Node, leaves, *shown, output));
  }
  hybridtree::putNames(leaves, output->GetFieldData());
  hybridtree::putArrays(arrays, leaves, output->GetFieldData());
  vtkHybridTreeArray::PutTree(state.Node, output);
  reuseArrays(state.FieldArrays, output->GetFieldData());
}

//------------------------------------------------------------------------------
bool vtkHybridTreeAlgorithm::NeedsNormals(const hybridtree::TriangleMesh& mesh) const
{
  constexpr double most = 0.25;
  return this->PointNormals == NORMALS_ALWAYS ||
    (this->PointNormals == NORMALS_AUTOMATIC && !(hybridtree::sharpShare(mesh) > most));
}

//------------------------------------------------------------------------------
void vtkHybridTreeAlgorithm::WarnOfLostShape(const hybridtree::TriangleMesh& mesh)
{
  this->Warn(hybridtree::warningsOfLost(*this->Internals->Node, mesh, this->EdgeLength));
}

//------------------------------------------------------------------------------
void vtkHybridTreeAlgorithm::WarnOfTinyOperands()
{
  const State& state = *this->Internals;
  std::size_t count = 0;
  for (const std::vector<NodePtr>& nodes : state.NodeOperands)
  {
    count += nodes.size();
  }
  if (count < 2 || state.Node->surfaceBounds().isEmpty())
  {
    return; // bounds may take longer than a preview, and one that is lost alone is told of
  }
  const double edge = this->EdgeLength > 0.0 ? this->EdgeLength : state.Node->defaultEdgeLength();
  for (std::size_t port = 0; port < state.NodeOperands.size(); ++port)
  {
    const std::vector<NodePtr>& nodes = state.NodeOperands[port];
    for (std::size_t k = 0; k < nodes.size(); ++k)
    {
      const std::string warning = hybridtree::warningOfTiny(*nodes[k], edge);
      if (!warning.empty() && nodes[k] != state.Node)
      {
        const int number = nodes.size() > 1 ? static_cast<int>(k) + 1 : 0;
        this->Warn({ this->CalledInput(port, number) + ": " + warning });
      }
    }
  }
}

//------------------------------------------------------------------------------
const char* vtkHybridTreeAlgorithm::InputName(int)
{
  return "Input";
}

//------------------------------------------------------------------------------
bool vtkHybridTreeAlgorithm::TakesNodes(int)
{
  return true;
}

//------------------------------------------------------------------------------
bool vtkHybridTreeAlgorithm::ReadOtherInputs()
{
  return false;
}

//------------------------------------------------------------------------------
vtkHybridTreeAlgorithm::MeshPtr vtkHybridTreeAlgorithm::MakeMesh(
  const hybridtree::Node& node, const hybridtree::Progress& progress)
{
  return node.mesh(this->EdgeLength, progress);
}

//------------------------------------------------------------------------------
void vtkHybridTreeAlgorithm::FillOtherOutputs(vtkInformationVector*) {}

//------------------------------------------------------------------------------
void vtkHybridTreeAlgorithm::Warn(const std::vector<std::string>& warnings)
{
  for (const std::string& warning : warnings)
  {
    if (this->Internals->Told.isNews(warning))
    {
      vtkWarningMacro(<< warning);
    }
  }
}

//------------------------------------------------------------------------------
void vtkHybridTreeAlgorithm::Clear(vtkInformationVector* outputs)
{
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkDataObject::GetData(outputs, port)->Initialize();
  }
}

//------------------------------------------------------------------------------
void vtkHybridTreeAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "EdgeLength: " << this->EdgeLength << "\n";
  os << indent << "PointNormals: " << this->PointNormals << "\n";
  os << indent << "NumberOfExecutions: " << this->NumberOfExecutions << "\n";
  os << indent << "NumberOfMeshings: " << this->NumberOfMeshings << "\n";
}
