// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeCone
 * @brief   implicit primitive around a solid truncated cone
 *
 * The skeleton is the volume: the field is largest everywhere inside the cone, and SurfaceRadius
 * rounds its rims; 0 keeps them sharp. By default the surface lies at 0.1 from the cone and the
 * field ends at 0.5.
 */

#ifndef vtkHybridTreeCone_h
#define vtkHybridTreeCone_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeFieldAlgorithm.h"

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeCone : public vtkHybridTreeFieldAlgorithm
{
public:
  static vtkHybridTreeCone* New();
  vtkTypeMacro(vtkHybridTreeCone, vtkHybridTreeFieldAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * First end of the axis, world units. Default (0, 0, -0.5).
   */
  vtkSetVector3Macro(Point1, double);
  vtkGetVector3Macro(Point1, double);
  ///@}

  ///@{
  /**
   * Second end of the axis, world units. Must differ from Point1. Default (0, 0, 0.5).
   */
  vtkSetVector3Macro(Point2, double);
  vtkGetVector3Macro(Point2, double);
  ///@}

  ///@{
  /**
   * Radius at Point1, world units, >= 0; 0 makes an apex. Default 0.5.
   */
  vtkSetMacro(Radius1, double);
  vtkGetMacro(Radius1, double);
  ///@}

  ///@{
  /**
   * Radius at Point2, world units, >= 0; 0 makes an apex. Default 0.2.
   */
  vtkSetMacro(Radius2, double);
  vtkGetMacro(Radius2, double);
  ///@}

protected:
  vtkHybridTreeCone();
  ~vtkHybridTreeCone() override;

#ifndef __VTK_WRAP__
  std::shared_ptr<const hybridtree::Skeleton> MakeSkeleton() override;
#endif

  double Point1[3] = { 0.0, 0.0, -0.5 };
  double Point2[3] = { 0.0, 0.0, 0.5 };
  double Radius1 = 0.5;
  double Radius2 = 0.2;

private:
  vtkHybridTreeCone(const vtkHybridTreeCone&) = delete;
  void operator=(const vtkHybridTreeCone&) = delete;
};

#endif
