// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreePoint
 * @brief   implicit primitive around a point: a ball
 */

#ifndef vtkHybridTreePoint_h
#define vtkHybridTreePoint_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeFieldAlgorithm.h"

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreePoint : public vtkHybridTreeFieldAlgorithm
{
public:
  static vtkHybridTreePoint* New();
  vtkTypeMacro(vtkHybridTreePoint, vtkHybridTreeFieldAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The point, world units. Default (0, 0, 0).
   */
  vtkSetVector3Macro(Center, double);
  vtkGetVector3Macro(Center, double);
  ///@}

protected:
  vtkHybridTreePoint();
  ~vtkHybridTreePoint() override;

#ifndef __VTK_WRAP__
  std::shared_ptr<const hybridtree::Skeleton> MakeSkeleton() override;
#endif

  double Center[3] = { 0.0, 0.0, 0.0 };

private:
  vtkHybridTreePoint(const vtkHybridTreePoint&) = delete;
  void operator=(const vtkHybridTreePoint&) = delete;
};

#endif
