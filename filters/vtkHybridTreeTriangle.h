// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeTriangle
 * @brief   implicit primitive around a flat triangle: a plate with a round rim
 *
 * The three corners must not be on one line.
 *
 * A surface: it has no inside, and needs a SurfaceRadius > 0 to make one. By default the surface
 * lies at 0.1 from it and the field ends at 0.5.
 */

#ifndef vtkHybridTreeTriangle_h
#define vtkHybridTreeTriangle_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeFieldAlgorithm.h"

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeTriangle : public vtkHybridTreeFieldAlgorithm
{
public:
  static vtkHybridTreeTriangle* New();
  vtkTypeMacro(vtkHybridTreeTriangle, vtkHybridTreeFieldAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * First corner, world units. Default (-0.5, -0.5, 0).
   */
  vtkSetVector3Macro(Point1, double);
  vtkGetVector3Macro(Point1, double);
  ///@}

  ///@{
  /**
   * Second corner, world units. Default (0.5, -0.5, 0).
   */
  vtkSetVector3Macro(Point2, double);
  vtkGetVector3Macro(Point2, double);
  ///@}

  ///@{
  /**
   * Third corner, world units. Default (0, 0.5, 0).
   */
  vtkSetVector3Macro(Point3, double);
  vtkGetVector3Macro(Point3, double);
  ///@}

protected:
  vtkHybridTreeTriangle();
  ~vtkHybridTreeTriangle() override;

#ifndef __VTK_WRAP__
  std::shared_ptr<const hybridtree::Skeleton> MakeSkeleton() override;
#endif

  double Point1[3] = { -0.5, -0.5, 0.0 };
  double Point2[3] = { 0.5, -0.5, 0.0 };
  double Point3[3] = { 0.0, 0.5, 0.0 };

private:
  vtkHybridTreeTriangle(const vtkHybridTreeTriangle&) = delete;
  void operator=(const vtkHybridTreeTriangle&) = delete;
};

#endif
