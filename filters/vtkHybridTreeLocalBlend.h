// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeLocalBlend
 * @brief   blend of two nodes where a third one is
 *
 * A (port 0) and B (port 1) are blended where the field of Region (port 2) is 1 or more, united
 * where it is 0, and something between in between ([HT] 4.3). Several inputs of Region are
 * united. A negative region changes nothing.
 */

#ifndef vtkHybridTreeLocalBlend_h
#define vtkHybridTreeLocalBlend_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeBlendAlgorithm.h"

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeLocalBlend : public vtkHybridTreeBlendAlgorithm
{
public:
  static vtkHybridTreeLocalBlend* New();
  vtkTypeMacro(vtkHybridTreeLocalBlend, vtkHybridTreeBlendAlgorithm);

protected:
  vtkHybridTreeLocalBlend();
  ~vtkHybridTreeLocalBlend() override;

#ifndef __VTK_WRAP__
  NodePtr MakeNode(const Operands& operands) override;
  const char* InputName(int port) override;
#endif

  int FillInputPortInformation(int port, vtkInformation* info) override;

private:
  vtkHybridTreeLocalBlend(const vtkHybridTreeLocalBlend&) = delete;
  void operator=(const vtkHybridTreeLocalBlend&) = delete;
};

#endif
