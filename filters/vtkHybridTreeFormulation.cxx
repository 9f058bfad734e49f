// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeFormulation.h"

#include "vtkAlgorithm.h"
#include "vtkAlgorithmOutput.h"
#include "vtkHybridTreeAlgorithm.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationIntegerRequestKey.h"
#include "vtkInformationVector.h"
#include "vtkStreamingDemandDrivenPipeline.h"

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

void ask(vtkInformation* output, Formulation formulation)
{
  output->Set(formulationKey(), static_cast<int>(formulation));
}

} // namespace

vtkInformationIntegerRequestKey* formulationKey()
{
  static FormulationKey* const key = new FormulationKey; // kept by VTK's key manager
  return key;
}

void askProducers(vtkAlgorithm* consumer, bool travels)
{
  // MESH comes last, so that it wins where one producer feeds both kinds of port.
  for (const bool trees : { true, false })
  {
    for (int port = 0; port < consumer->GetNumberOfInputPorts(); ++port)
    {
      for (int k = 0; k < consumer->GetNumberOfInputConnections(port); ++k)
      {
        vtkAlgorithmOutput* producer = consumer->GetInputConnection(port, k);
        const std::vector<vtkInformation*> path = producer && takesTree(consumer, port)
          ? pathToNode(producer)
          : std::vector<vtkInformation*>();
        for (vtkInformation* output : trees ? path : std::vector<vtkInformation*>())
        {
          ask(output, travels ? Formulation::Field : Formulation::Mesh);
        }
        if (!trees && producer && path.empty())
        {
          ask(informationOf(producer), Formulation::Mesh);
        }
      }
    }
  }
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

} // namespace hybridtree
