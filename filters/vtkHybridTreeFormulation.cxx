// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeFormulation.h"

#include "vtkAlgorithm.h"
#include "vtkAlgorithmOutput.h"
#include "vtkExecutive.h"
#include "vtkHybridTreeAlgorithm.h"
#include "vtkInformation.h"
#include "vtkInformationExecutivePortVectorKey.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationIntegerRequestKey.h"
#include "vtkInformationVector.h"
#include "vtkStreamingDemandDrivenPipeline.h"

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

bool takesTree(vtkAlgorithm* algorithm, int port)
{
  return algorithm->GetInputPortInformation(port)->Get(vtkHybridTreeAlgorithm::TAKES_TREE()) != 0;
}

/// The end of a pipeline with one input only. An update that starts here reaches no consumer
/// beside.
bool isLoneSink(vtkAlgorithm* algorithm)
{
  return (algorithm->GetNumberOfOutputPorts() == 0 || algorithm->IsA("vtkDataRepresentation")) &&
    algorithm->GetTotalNumberOfInputConnections() == 1;
}

/// No consumer of this output can need its mesh in an update that also serves a taker of trees.
bool onlyTreesAreTaken(vtkInformation* output)
{
  vtkExecutive** executives = vtkExecutive::CONSUMERS()->GetExecutives(output);
  int* ports = vtkExecutive::CONSUMERS()->GetPorts(output);
  const int count = vtkExecutive::CONSUMERS()->Length(output);
  for (int k = 0; k < count; ++k)
  {
    vtkAlgorithm* consumer = executives[k]->GetAlgorithm();
    const bool fine = passesThrough(consumer)
      ? onlyTreesAreTaken(executives[k]->GetOutputInformation(0))
      : takesTree(consumer, ports[k]) || isLoneSink(consumer);
    if (!fine)
    {
      return false;
    }
  }
  return true;
}

/// Output information of the node filter that an input connection comes from, as seen through
/// pass-through filters; null when anything else is there.
vtkInformation* nodeOutput(vtkAlgorithm* consumer, int port, int connection)
{
  vtkAlgorithmOutput* source = consumer->GetInputConnection(port, connection);
  while (source && passesThrough(source->GetProducer()))
  {
    source = source->GetProducer()->GetNumberOfInputConnections(0) > 0
      ? source->GetProducer()->GetInputConnection(0, 0)
      : nullptr;
  }
  if (!source || source->GetIndex() != 0 ||
    !vtkHybridTreeAlgorithm::SafeDownCast(source->GetProducer()))
  {
    return nullptr;
  }
  return source->GetProducer()->GetOutputInformation(0);
}

} // namespace

vtkInformationIntegerRequestKey* formulationKey()
{
  static FormulationKey* const key = new FormulationKey; // kept by VTK's key manager
  return key;
}

void askProducers(vtkAlgorithm* consumer, int port, vtkInformationVector** inputs)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  for (int k = 0; k < consumer->GetNumberOfInputConnections(port); ++k)
  {
    vtkInformation* input = inputs[port]->GetInformationObject(k);
    vtkInformation* origin = takesTree(consumer, port) ? nodeOutput(consumer, port, k) : nullptr;
    const bool field = origin && onlyTreesAreTaken(origin);
    input->Set(formulationKey(), static_cast<int>(field ? Formulation::Field : Formulation::Mesh));
    input->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
    input->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
    input->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  }
}

void askMesh(vtkInformation* input)
{
  input->Set(formulationKey(), static_cast<int>(Formulation::Mesh));
}

void forgetRequest(vtkInformation* output)
{
  output->Set(formulationKey(), static_cast<int>(Formulation::Mesh));
  vtkExecutive** executives = vtkExecutive::CONSUMERS()->GetExecutives(output);
  const int count = vtkExecutive::CONSUMERS()->Length(output);
  for (int k = 0; k < count; ++k)
  {
    if (passesThrough(executives[k]->GetAlgorithm()))
    {
      forgetRequest(executives[k]->GetOutputInformation(0));
    }
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
