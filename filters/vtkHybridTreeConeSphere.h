// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeConeSphere
 * @brief   implicit primitive around the convex hull of two balls
 *
 * The skeleton is the volume; where one ball holds the other, that is the skeleton. SurfaceRadius
 * adds to both radii. By default the surface lies at 0.1 from the balls and the field ends at 0.5.
 */

#ifndef vtkHybridTreeConeSphere_h
#define vtkHybridTreeConeSphere_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeFieldAlgorithm.h"

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeConeSphere : public vtkHybridTreeFieldAlgorithm
{
public:
  static vtkHybridTreeConeSphere* New();
  vtkTypeMacro(vtkHybridTreeConeSphere, vtkHybridTreeFieldAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Centre of the first ball, world units. Default (-0.5, 0, 0).
   */
  vtkSetVector3Macro(Point1, double);
  vtkGetVector3Macro(Point1, double);
  ///@}

  ///@{
  /**
   * Centre of the second ball, world units. May equal Point1. Default (0.5, 0, 0).
   */
  vtkSetVector3Macro(Point2, double);
  vtkGetVector3Macro(Point2, double);
  ///@}

  ///@{
  /**
   * Radius of the first ball, world units, >= 0. Default 0.4.
   */
  vtkSetMacro(Radius1, double);
  vtkGetMacro(Radius1, double);
  ///@}

  ///@{
  /**
   * Radius of the second ball, world units, >= 0. Default 0.2.
   */
  vtkSetMacro(Radius2, double);
  vtkGetMacro(Radius2, double);
  ///@}

protected:
  vtkHybridTreeConeSphere();
  ~vtkHybridTreeConeSphere() override;

#ifndef __VTK_WRAP__
  std::shared_ptr<const hybridtree::Skeleton> MakeSkeleton() override;
#endif

  double Point1[3] = { -0.5, 0.0, 0.0 };
  double Point2[3] = { 0.5, 0.0, 0.0 };
  double Radius1 = 0.4;
  double Radius2 = 0.2;

private:
  vtkHybridTreeConeSphere(const vtkHybridTreeConeSphere&) = delete;
  void operator=(const vtkHybridTreeConeSphere&) = delete;
};

#endif
