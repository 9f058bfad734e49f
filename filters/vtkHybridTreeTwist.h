// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeTwist
 * @brief   twist about an axis
 *
 * Barr's twist: cross sections are turned about the axis, from nothing at the beginning of the
 * range to Angle at its end; what lies beyond is turned by Angle.
 */

#ifndef vtkHybridTreeTwist_h
#define vtkHybridTreeTwist_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeBarr.h"

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeTwist : public vtkHybridTreeBarr
{
public:
  static vtkHybridTreeTwist* New();
  vtkTypeMacro(vtkHybridTreeTwist, vtkHybridTreeBarr);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Turn over the range, degrees. Default 90.
   */
  vtkSetMacro(Angle, double);
  vtkGetMacro(Angle, double);
  ///@}

protected:
  vtkHybridTreeTwist();
  ~vtkHybridTreeTwist() override;

#ifndef __VTK_WRAP__
  NodePtr MakeNode(const Operands& operands) override;
#endif

  double Angle = 90.0;

private:
  vtkHybridTreeTwist(const vtkHybridTreeTwist&) = delete;
  void operator=(const vtkHybridTreeTwist&) = delete;
};

#endif
