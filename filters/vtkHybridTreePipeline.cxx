// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreePipeline.h"

#include "vtkAlgorithm.h"
#include "vtkHybridTreeFormulation.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkHybridTreePipeline);

//------------------------------------------------------------------------------
int vtkHybridTreePipeline::ForwardUpstream(vtkInformation* request)
{
  // The superclass asks all producers in one loop of its own, where nothing can be said to each.
  if (this->SharedInputInformation)
  {
    return 1;
  }
  int result = 1;
  for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
  {
    for (int k = 0; k < this->Algorithm->GetNumberOfInputConnections(port); ++k)
    {
      result &= this->ForwardUpstream(port, k, request) != 0;
    }
  }
  return result;
}

//------------------------------------------------------------------------------
int vtkHybridTreePipeline::ForwardUpstream(int port, int connection, vtkInformation* request)
{
  const hybridtree::FormulationRequest asked(this->Algorithm, port, connection);
  return this->Superclass::ForwardUpstream(port, connection, request);
}
