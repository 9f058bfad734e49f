// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeDisc
 * @brief   implicit primitive around a flat disc: a plate with a round rim
 *
 * The skeleton is the disc alone, a surface: it has no inside, and needs a SurfaceRadius > 0 to
 * make one. By default the surface lies at 0.1 from the disc and the field ends at 0.5.
 */

#ifndef vtkHybridTreeDisc_h
#define vtkHybridTreeDisc_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeFieldAlgorithm.h"

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeDisc : public vtkHybridTreeFieldAlgorithm
{
public:
  static vtkHybridTreeDisc* New();
  vtkTypeMacro(vtkHybridTreeDisc, vtkHybridTreeFieldAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Centre of the disc, world units. Default (0, 0, 0).
   */
  vtkSetVector3Macro(Center, double);
  vtkGetVector3Macro(Center, double);
  ///@}

  ///@{
  /**
   * Axis of the disc: any length but 0, only the direction counts. Default (0, 0, 1).
   */
  vtkSetVector3Macro(Normal, double);
  vtkGetVector3Macro(Normal, double);
  ///@}

  ///@{
  /**
   * Radius of the disc, world units, >= 0. Default 1.
   */
  vtkSetMacro(Radius, double);
  vtkGetMacro(Radius, double);
  ///@}

protected:
  vtkHybridTreeDisc();
  ~vtkHybridTreeDisc() override;

#ifndef __VTK_WRAP__
  std::shared_ptr<const hybridtree::Skeleton> MakeSkeleton() override;
#endif

  double Center[3] = { 0.0, 0.0, 0.0 };
  double Normal[3] = { 0.0, 0.0, 1.0 };
  double Radius = 1.0;

private:
  vtkHybridTreeDisc(const vtkHybridTreeDisc&) = delete;
  void operator=(const vtkHybridTreeDisc&) = delete;
};

#endif
