// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeCircle
 * @brief   implicit primitive around a circle: a torus
 */

#ifndef vtkHybridTreeCircle_h
#define vtkHybridTreeCircle_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeFieldAlgorithm.h"

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeCircle : public vtkHybridTreeFieldAlgorithm
{
public:
  static vtkHybridTreeCircle* New();
  vtkTypeMacro(vtkHybridTreeCircle, vtkHybridTreeFieldAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Centre of the circle, world units. Default (0, 0, 0).
   */
  vtkSetVector3Macro(Center, double);
  vtkGetVector3Macro(Center, double);
  ///@}

  ///@{
  /**
   * Axis of the circle: any length but 0, only the direction counts. Default (0, 0, 1).
   */
  vtkSetVector3Macro(Normal, double);
  vtkGetVector3Macro(Normal, double);
  ///@}

  ///@{
  /**
   * Radius of the circle, world units, > 0. Default 1.
   */
  vtkSetMacro(Radius, double);
  vtkGetMacro(Radius, double);
  ///@}

protected:
  vtkHybridTreeCircle();
  ~vtkHybridTreeCircle() override;

#ifndef __VTK_WRAP__
  std::shared_ptr<const hybridtree::Skeleton> MakeSkeleton() override;
#endif

  double Center[3] = { 0.0, 0.0, 0.0 };
  double Normal[3] = { 0.0, 0.0, 1.0 };
  double Radius = 1.0;

private:
  vtkHybridTreeCircle(const vtkHybridTreeCircle&) = delete;
  void operator=(const vtkHybridTreeCircle&) = delete;
};

#endif
