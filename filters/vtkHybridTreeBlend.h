// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeBlend
 * @brief   global blend of any number of nodes and meshes
 *
 * The field is the sum of the fields of all inputs ([HT] 4.3); negative ones carve. The order of
 * the inputs does not change the surface.
 */

#ifndef vtkHybridTreeBlend_h
#define vtkHybridTreeBlend_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeBlendAlgorithm.h"

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeBlend : public vtkHybridTreeBlendAlgorithm
{
public:
  static vtkHybridTreeBlend* New();
  vtkTypeMacro(vtkHybridTreeBlend, vtkHybridTreeBlendAlgorithm);

protected:
  vtkHybridTreeBlend();
  ~vtkHybridTreeBlend() override;

#ifndef __VTK_WRAP__
  NodePtr MakeNode(const Operands& operands) override;
#endif

  int FillInputPortInformation(int port, vtkInformation* info) override;

private:
  vtkHybridTreeBlend(const vtkHybridTreeBlend&) = delete;
  void operator=(const vtkHybridTreeBlend&) = delete;
};

#endif
