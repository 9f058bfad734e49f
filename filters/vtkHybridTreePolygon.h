// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreePolygon
 * @brief   implicit primitive around a flat polygon: a plate with a round rim
 *
 * The outline may be convex or not, without holes; it must not meet itself, and be flat to 1e-4 of
 * its diagonal.
 *
 * A surface: it has no inside, and needs a SurfaceRadius > 0 to make one. By default the surface
 * lies at 0.1 from it and the field ends at 0.5.
 *
 * The points are the corners around the outline, either way. By default six that make a letter L in
 * the plane z = 0.
 */

#ifndef vtkHybridTreePolygon_h
#define vtkHybridTreePolygon_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreePointsAlgorithm.h"

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreePolygon : public vtkHybridTreePointsAlgorithm
{
public:
  static vtkHybridTreePolygon* New();
  vtkTypeMacro(vtkHybridTreePolygon, vtkHybridTreePointsAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * 0 (coarse) to 4 (exact, default). Level k leaves out corners as long as the outline moves by no
   * more than 2, 1, 0.5 or 0.25 % of the diagonal of its bounds (k = 0 .. 3), so that the field is
   * cheaper to evaluate.
   */
  vtkSetMacro(LevelOfDetail, int);
  vtkGetMacro(LevelOfDetail, int);
  ///@}

protected:
  vtkHybridTreePolygon();
  ~vtkHybridTreePolygon() override;

#ifndef __VTK_WRAP__
  std::shared_ptr<const hybridtree::Skeleton> MakeSkeleton() override;
#endif

  int LevelOfDetail = 4;

private:
  vtkHybridTreePolygon(const vtkHybridTreePolygon&) = delete;
  void operator=(const vtkHybridTreePolygon&) = delete;
};

#endif
