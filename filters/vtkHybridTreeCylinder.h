// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeCylinder
 * @brief   implicit primitive around a solid cylinder
 *
 * The skeleton is the volume: the field is largest everywhere inside the cylinder, and
 * SurfaceRadius rounds its rims; 0 keeps them sharp. By default the surface lies at 0.1 from the
 * cylinder and the field ends at 0.5.
 */

#ifndef vtkHybridTreeCylinder_h
#define vtkHybridTreeCylinder_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeFieldAlgorithm.h"

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeCylinder : public vtkHybridTreeFieldAlgorithm
{
public:
  static vtkHybridTreeCylinder* New();
  vtkTypeMacro(vtkHybridTreeCylinder, vtkHybridTreeFieldAlgorithm);
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
   * Radius of the cylinder, world units, >= 0. Default 0.5.
   */
  vtkSetMacro(Radius, double);
  vtkGetMacro(Radius, double);
  ///@}

protected:
  vtkHybridTreeCylinder();
  ~vtkHybridTreeCylinder() override;

#ifndef __VTK_WRAP__
  std::shared_ptr<const hybridtree::Skeleton> MakeSkeleton() override;
#endif

  double Point1[3] = { 0.0, 0.0, -0.5 };
  double Point2[3] = { 0.0, 0.0, 0.5 };
  double Radius = 0.5;

private:
  vtkHybridTreeCylinder(const vtkHybridTreeCylinder&) = delete;
  void operator=(const vtkHybridTreeCylinder&) = delete;
};

#endif
