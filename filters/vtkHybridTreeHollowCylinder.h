// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeHollowCylinder
 * @brief   implicit primitive around a tube with a wall
 *
 * The skeleton is the volume between two cylinders: SurfaceRadius thickens it on all sides and
 * rounds its rims; 0 keeps them sharp. From SurfaceRadius = InnerRadius on the bore is filled. By
 * default the surface lies at 0.1 from the wall and the field ends at 0.5.
 */

#ifndef vtkHybridTreeHollowCylinder_h
#define vtkHybridTreeHollowCylinder_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeFieldAlgorithm.h"

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeHollowCylinder : public vtkHybridTreeFieldAlgorithm
{
public:
  static vtkHybridTreeHollowCylinder* New();
  vtkTypeMacro(vtkHybridTreeHollowCylinder, vtkHybridTreeFieldAlgorithm);
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
   * Outer radius of the wall, world units, >= 0. Default 0.6.
   */
  vtkSetMacro(OuterRadius, double);
  vtkGetMacro(OuterRadius, double);
  ///@}

  ///@{
  /**
   * Radius of the bore, world units, 0 to OuterRadius. Default 0.4.
   */
  vtkSetMacro(InnerRadius, double);
  vtkGetMacro(InnerRadius, double);
  ///@}

protected:
  vtkHybridTreeHollowCylinder();
  ~vtkHybridTreeHollowCylinder() override;

#ifndef __VTK_WRAP__
  std::shared_ptr<const hybridtree::Skeleton> MakeSkeleton() override;
#endif

  double Point1[3] = { 0.0, 0.0, -0.5 };
  double Point2[3] = { 0.0, 0.0, 0.5 };
  double OuterRadius = 0.6;
  double InnerRadius = 0.4;

private:
  vtkHybridTreeHollowCylinder(const vtkHybridTreeHollowCylinder&) = delete;
  void operator=(const vtkHybridTreeHollowCylinder&) = delete;
};

#endif
