// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeRectangle
 * @brief   implicit primitive around a flat rectangle: a plate with a round rim
 *
 * Given by three corners as vtkPlaneSource is, so that it may be any parallelogram. The three must
 * not be on one line.
 *
 * A surface: it has no inside, and needs a SurfaceRadius > 0 to make one. By default the surface
 * lies at 0.1 from it and the field ends at 0.5.
 */

#ifndef vtkHybridTreeRectangle_h
#define vtkHybridTreeRectangle_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeFieldAlgorithm.h"

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeRectangle : public vtkHybridTreeFieldAlgorithm
{
public:
  static vtkHybridTreeRectangle* New();
  vtkTypeMacro(vtkHybridTreeRectangle, vtkHybridTreeFieldAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * One corner, world units. Default (-0.5, -0.5, 0).
   */
  vtkSetVector3Macro(Origin, double);
  vtkGetVector3Macro(Origin, double);
  ///@}

  ///@{
  /**
   * The corner beside Origin at the end of the first side, world units. Default (0.5, -0.5, 0).
   */
  vtkSetVector3Macro(Point1, double);
  vtkGetVector3Macro(Point1, double);
  ///@}

  ///@{
  /**
   * The corner beside Origin at the end of the second side, world units. Default (-0.5, 0.5, 0).
   */
  vtkSetVector3Macro(Point2, double);
  vtkGetVector3Macro(Point2, double);
  ///@}

protected:
  vtkHybridTreeRectangle();
  ~vtkHybridTreeRectangle() override;

#ifndef __VTK_WRAP__
  std::shared_ptr<const hybridtree::Skeleton> MakeSkeleton() override;
#endif

  double Origin[3] = { -0.5, -0.5, 0.0 };
  double Point1[3] = { 0.5, -0.5, 0.0 };
  double Point2[3] = { -0.5, 0.5, 0.0 };

private:
  vtkHybridTreeRectangle(const vtkHybridTreeRectangle&) = delete;
  void operator=(const vtkHybridTreeRectangle&) = delete;
};

#endif
