// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeTaper
 * @brief   taper along an axis
 *
 * Barr's taper: cross sections are scaled, from 1 at the beginning of the range to Factor at its
 * end; what lies beyond is scaled by Factor.
 */

#ifndef vtkHybridTreeTaper_h
#define vtkHybridTreeTaper_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeBarr.h"

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeTaper : public vtkHybridTreeBarr
{
public:
  static vtkHybridTreeTaper* New();
  vtkTypeMacro(vtkHybridTreeTaper, vtkHybridTreeBarr);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Scale at the end of the range, no unit, > 0. Default 0.5.
   */
  vtkSetMacro(Factor, double);
  vtkGetMacro(Factor, double);
  ///@}

protected:
  vtkHybridTreeTaper();
  ~vtkHybridTreeTaper() override;

#ifndef __VTK_WRAP__
  NodePtr MakeNode(const Operands& operands) override;
#endif

  double Factor = 0.5;

private:
  vtkHybridTreeTaper(const vtkHybridTreeTaper&) = delete;
  void operator=(const vtkHybridTreeTaper&) = delete;
};

#endif
