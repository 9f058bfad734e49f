// SPDX-License-Identifier: BSD-3-Clause
// Private: the executive of every filter with a port that takes trees. It asks each producer for
// FIELD or MESH, see vtkHybridTreeFormulation.h.
#ifndef vtkHybridTreePipeline_h
#define vtkHybridTreePipeline_h

#include "vtkCompositeDataPipeline.h"

class vtkHybridTreePipeline : public vtkCompositeDataPipeline
{
public:
  static vtkHybridTreePipeline* New();
  vtkTypeMacro(vtkHybridTreePipeline, vtkCompositeDataPipeline);

protected:
  vtkHybridTreePipeline() = default;
  ~vtkHybridTreePipeline() override = default;

  int ForwardUpstream(vtkInformation* request) override;
  int ForwardUpstream(int port, int connection, vtkInformation* request) override;

private:
  vtkHybridTreePipeline(const vtkHybridTreePipeline&) = delete;
  void operator=(const vtkHybridTreePipeline&) = delete;
};

#endif
