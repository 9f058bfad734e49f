// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreePipeline.h"

#include "vtkHybridTreeFormulation.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkHybridTreePipeline);

//------------------------------------------------------------------------------
int vtkHybridTreePipeline::ForwardUpstream(vtkInformation* request)
{
  return this->Superclass::ForwardUpstream(request);
}

//------------------------------------------------------------------------------
int vtkHybridTreePipeline::ForwardUpstream(int port, int connection, vtkInformation* request)
{
  const hybridtree::FormulationRequest asked(this->Algorithm, port, connection);
  return this->Superclass::ForwardUpstream(port, connection, request);
}
