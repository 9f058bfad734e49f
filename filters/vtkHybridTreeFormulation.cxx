// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeFormulation.h"

#include "vtkAlgorithm.h"
#include "vtkAlgorithmOutput.h"
#include "vtkHybridTreeAlgorithm.h"
#include "vtkInformation.h"
#include "vtkInformationDoubleVectorKey.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationIntegerRequestKey.h"
#include "vtkInformationVector.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <utility>
#include <vector>

namespace hybridtree
{
namespace
{

class FormulationKey : public vtkInformationIntegerRequestKey
{
public:
  FormulationKey() : vtkInformationIntegerRequestKey("FORMULATION", "vtkHybridTreeAlgorithm")
  {
    this->DataKey = vtkInformationIntegerKey::MakeKey("FORMULATION_MADE", "vtkHybridTreeAlgorithm");
  }

  /// What is asked of a consumer says nothing about its inputs: FormulationRequest asks each of
  /// them, and all others stay at MESH. By default executives would copy it, and it would stay
  /// there.
  void CopyDefaultInformation(vtkInformation*, vtkInformation*, vtkInformation*) override {}

  bool NeedToExecute(vtkInformation* pipelineInfo, vtkInformation* dataInfo) override
  {
    const auto field = static_cast<int>(Formulation::Field);
    return pipelineInfo->Get(this) != field && dataInfo->Get(this->DataKey) == field;
  }
};

/// ParaView puts one of these behind every output; it hands its input on. Known by name, since
/// these modules do without ParaView.
bool passesThrough(vtkAlgorithm* algorithm)
{
  return algorithm->IsA("vtkPVPostFilter");
}

bool takesTree(vtkAlgorithm* consumer, int port)
{
  return consumer->GetInputPortInformation(port)->Get(vtkHybridTreeAlgorithm::TAKES_TREE()) != 0;
}

vtkInformation* informationOf(vtkAlgorithmOutput* output)
{
  return output->GetProducer()->GetOutputInformation(output->GetIndex());
}

/// Information of every output from this one up to that of a node filter, pass-through filters
/// between; empty when no node filter is there.
std::vector<vtkInformation*> pathToNode(vtkAlgorithmOutput* output)
{
  std::vector<vtkInformation*> path;
  while (output && passesThrough(output->GetProducer()))
  {
    path.push_back(informationOf(output));
    vtkAlgorithm* filter = output->GetProducer();
    output =
      filter->GetNumberOfInputConnections(0) > 0 ? filter->GetInputConnection(0, 0) : nullptr;
  }
  const bool isNode = output && output->GetIndex() == 0 &&
    vtkHybridTreeAlgorithm::SafeDownCast(output->GetProducer()) != nullptr;
  if (!isNode)
  {
    return {};
  }
  path.push_back(informationOf(output));
  return path;
}

/// Every node output upstream of an input connection whose mesh the update under way needs: there
/// is a consumer on the way that does not make do with the tree. It would find our FIELD.
void collectMeshUsers(
  vtkAlgorithm* consumer, int port, int connection, std::set<vtkInformation*>& outputs)
{
  struct Step
  {
    vtkAlgorithm* consumer;
    int port;
    int connection;
    bool foreign; // behind a consumer that is not content with the tree
  };
  std::set<std::pair<vtkAlgorithm*, bool>> seen;
  std::vector<Step> steps{ { consumer, port, connection, false } };
  while (!steps.empty())
  {
    const Step step = steps.back();
    steps.pop_back();
    vtkAlgorithmOutput* output = step.consumer->GetInputConnection(step.port, step.connection);
    if (!output)
    {
      continue;
    }
    const bool foreign =
      step.foreign || !(passesThrough(step.consumer) || takesTree(step.consumer, step.port));
    vtkAlgorithm* producer = output->GetProducer();
    if (foreign)
    {
      outputs.insert(informationOf(output));
    }
    if (!seen.insert({ producer, foreign }).second)
    {
      continue;
    }
    for (int p = 0; p < producer->GetNumberOfInputPorts(); ++p)
    {
      for (int k = 0; k < producer->GetNumberOfInputConnections(p); ++k)
      {
        steps.push_back({ producer, p, k, foreign });
      }
    }
  }
}

} // namespace

vtkInformationIntegerRequestKey* formulationKey()
{
  static FormulationKey* const key = new FormulationKey; // kept by VTK's key manager
  return key;
}

void FormulationRequest::send(vtkAlgorithm* consumer)
{
  std::set<vtkInformation*> meshUsers;
  for (int port = 0; port < consumer->GetNumberOfInputPorts(); ++port)
  {
    for (int k = 0; k < consumer->GetNumberOfInputConnections(port); ++k)
    {
      collectMeshUsers(consumer, port, k, meshUsers);
    }
  }
  for (int port = 0; port < consumer->GetNumberOfInputPorts(); ++port)
  {
    for (int k = 0; k < consumer->GetNumberOfInputConnections(port); ++k)
    {
      this->ask(consumer, port, k, meshUsers);
    }
  }
}

void FormulationRequest::ask(
  vtkAlgorithm* consumer, int port, int connection, const std::set<vtkInformation*>& meshUsers)
{
  vtkAlgorithmOutput* producer = consumer->GetInputConnection(port, connection);
  if (!producer)
  {
    return;
  }
  const std::vector<vtkInformation*> path = pathToNode(producer);
  const bool field =
    takesTree(consumer, port) && !path.empty() && meshUsers.count(path.back()) == 0;
  for (vtkInformation* output : path)
  {
    before_.emplace_back(output, output->Get(formulationKey()));
    output->Set(formulationKey(), static_cast<int>(field ? Formulation::Field : Formulation::Mesh));
  }
}

void FormulationRequest::takeBack()
{
  // The latest first: an output that was asked twice gets back what it had at first.
  for (auto asked = before_.rbegin(); asked != before_.rend(); ++asked)
  {
    asked->first->Set(formulationKey(), asked->second);
  }
  before_.clear();
}

void askWhole(int port, vtkInformationVector** inputs)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  for (int k = 0; k < inputs[port]->GetNumberOfInformationObjects(); ++k)
  {
    vtkInformation* input = inputs[port]->GetInformationObject(k);
    input->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
    input->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
    input->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  }
}

Formulation requested(vtkInformation* output)
{
  return static_cast<Formulation>(output->Get(formulationKey()));
}

bool isFirstPiece(vtkInformation* output)
{
  return output->Get(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER()) <= 0;
}

void mergeTimes(int ports, vtkInformationVector** inputs, vtkInformation* output)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  std::set<double> steps;
  std::set<double> ends;
  for (int port = 0; port < ports; ++port)
  {
    for (int k = 0; k < inputs[port]->GetNumberOfInformationObjects(); ++k)
    {
      vtkInformation* input = inputs[port]->GetInformationObject(k);
      const double* step = input->Get(Pipeline::TIME_STEPS());
      steps.insert(step, step + input->Length(Pipeline::TIME_STEPS()));
      const double* end = input->Get(Pipeline::TIME_RANGE());
      ends.insert(end, end + input->Length(Pipeline::TIME_RANGE()));
    }
  }
  output->Remove(Pipeline::TIME_STEPS());
  output->Remove(Pipeline::TIME_RANGE());
  if (!steps.empty())
  {
    const std::vector<double> all(steps.begin(), steps.end());
    output->Set(Pipeline::TIME_STEPS(), all.data(), static_cast<int>(all.size()));
    ends.insert({ all.front(), all.back() });
  }
  if (!ends.empty())
  {
    const double range[2] = { *ends.begin(), *ends.rbegin() };
    output->Set(Pipeline::TIME_RANGE(), range, 2);
  }
}

} // namespace hybridtree
