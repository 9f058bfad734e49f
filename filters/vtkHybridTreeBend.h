// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeBend
 * @brief   bend along an axis
 *
 * Barr's bend: over the range the axis turns towards Normal at a constant rate; what lies beyond
 * goes on straight.
 */

#ifndef vtkHybridTreeBend_h
#define vtkHybridTreeBend_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeBarr.h"

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeBend : public vtkHybridTreeBarr
{
public:
  static vtkHybridTreeBend* New();
  vtkTypeMacro(vtkHybridTreeBend, vtkHybridTreeBarr);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Turn of the axis over the range, degrees, at most about 257 either way; negative bends
   * away from Normal. Default 45.
   */
  vtkSetMacro(Angle, double);
  vtkGetMacro(Angle, double);
  ///@}

protected:
  vtkHybridTreeBend();
  ~vtkHybridTreeBend() override;

#ifndef __VTK_WRAP__
  NodePtr MakeNode(const Operands& operands) override;
#endif

  double Angle = 45.0;

private:
  vtkHybridTreeBend(const vtkHybridTreeBend&) = delete;
  void operator=(const vtkHybridTreeBend&) = delete;
};

#endif
