// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeAlgorithm.h"

#include "core/base/Error.h"
#include "core/nodes/MeshLimits.h"
#include "core/nodes/Node.h"
#include "vtkExecutive.h"
#include "vtkHybridTreeArray.h"
#include "vtkHybridTreeConvert.h"
#include "vtkHybridTreeFormulation.h"
#include "vtkHybridTreeLeaves.h"
#include "vtkHybridTreeOperand.h"
#include "vtkHybridTreeProgress.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationIntegerRequestKey.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"

#include <algorithm>

vtkInformationKeyMacro(vtkHybridTreeAlgorithm, TAKES_TREE, Integer);

/// What a filter remembers from run to run.
struct vtkHybridTreeAlgorithm::State
{
  std::vector<std::vector<hybridtree::Operand>> Inputs; ///< by port and connection
  NodePtr Node;
  vtkMTimeType NodeTime = 0; ///< modification time of the filter that Node belongs to
  Operands NodeOperands;     ///< operands that Node was made from
  hybridtree::FormulationRequest Asked;
  std::vector<std::string> Told; ///< warnings already given about Node
};

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
  const bool nodeIsCurrent = this->Internals->NodeTime == this->GetMTime();
  this->EdgeLength = length;
  this->Modified();
  if (nodeIsCurrent && !this->NodeDependsOnEdgeLength())
  {
    this->Internals->NodeTime = this->GetMTime();
  }
}

//------------------------------------------------------------------------------
int vtkHybridTreeAlgorithm::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(TAKES_TREE(), 1);
  return this->Superclass::FillInputPortInformation(port, info);
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
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    outputs->GetInformationObject(port)->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
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
  try
  {
    this->Run(inputs, outputs);
    return 1;
  }
  catch (const hybridtree::Cancelled&) // the user's wish, not an error
  {
    Clear(outputs);
    return 1;
  }
  catch (const std::exception& error)
  {
    this->Internals->Node = nullptr;
    Clear(outputs);
    vtkErrorMacro(<< error.what());
    return 0;
  }
}

//------------------------------------------------------------------------------
void vtkHybridTreeAlgorithm::Run(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkInformation* info = outputs->GetInformationObject(0);
  if (!hybridtree::isFirstPiece(info))
  {
    Clear(outputs);
    return;
  }
  hybridtree::requireEdgeLength(this->EdgeLength);
  this->UpdateNode(inputs);
  const hybridtree::FilterProgress progress(this);
  this->WriteOutput(vtkPolyData::GetData(info),
    hybridtree::requested(info) == hybridtree::Formulation::Mesh, progress);
  this->FillOtherOutputs(outputs);
  this->Warn(this->Internals->Node->warnings());
}

//------------------------------------------------------------------------------
vtkHybridTreeAlgorithm::Operands vtkHybridTreeAlgorithm::ReadOperands(
  vtkInformationVector** inputs, std::vector<std::string>& warnings)
{
  const auto ports = static_cast<std::size_t>(this->GetNumberOfInputPorts());
  Operands operands(ports);
  this->Internals->Inputs.resize(ports);
  for (std::size_t port = 0; port < ports; ++port)
  {
    const int number = static_cast<int>(port);
    if (!this->TakesNodes(number))
    {
      continue;
    }
    const bool takesTree = this->GetInputPortInformation(number)->Get(TAKES_TREE()) != 0;
    std::vector<hybridtree::Operand>& connections = this->Internals->Inputs[port];
    connections.resize(static_cast<std::size_t>(inputs[port]->GetNumberOfInformationObjects()));
    for (std::size_t k = 0; k < connections.size(); ++k)
    {
      vtkPolyData* input = vtkPolyData::GetData(inputs[port], static_cast<int>(k));
      try
      {
        takesTree ? connections[k].read(input, warnings) : connections[k].readMesh(input, warnings);
      }
      catch (const hybridtree::Error& error)
      {
        throw hybridtree::InvalidGeometry(
          "Input " + std::to_string(k) + " of port " + std::to_string(port) + ": " + error.what());
      }
      operands[port].push_back(connections[k].node());
    }
  }
  return operands;
}

//------------------------------------------------------------------------------
void vtkHybridTreeAlgorithm::UpdateNode(vtkInformationVector** inputs)
{
  State& state = *this->Internals;
  std::vector<std::string> warnings;
  Operands operands = this->ReadOperands(inputs, warnings);
  const bool othersChanged = this->ReadOtherInputs(inputs);
  if (othersChanged || !state.Node || state.NodeTime != this->GetMTime() ||
    state.NodeOperands != operands)
  {
    state.Node = nullptr;
    state.Told.clear();
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
  const State& state = *this->Internals;
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
    hybridtree::toPolyData(mesh, output);
    this->Warn(hybridtree::passArrays(arrays, leaves, *mesh, output));
  }
  hybridtree::putNames(leaves, output->GetFieldData());
  hybridtree::putArrays(arrays, leaves, output->GetFieldData());
  vtkHybridTreeArray::PutTree(state.Node, output);
}

//------------------------------------------------------------------------------
bool vtkHybridTreeAlgorithm::TakesNodes(int)
{
  return true;
}

//------------------------------------------------------------------------------
bool vtkHybridTreeAlgorithm::ReadOtherInputs(vtkInformationVector**)
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
  std::vector<std::string>& told = this->Internals->Told;
  for (const std::string& warning : warnings)
  {
    if (std::find(told.begin(), told.end(), warning) == told.end())
    {
      told.push_back(warning);
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
  os << indent << "NumberOfExecutions: " << this->NumberOfExecutions << "\n";
  os << indent << "NumberOfMeshings: " << this->NumberOfMeshings << "\n";
}
