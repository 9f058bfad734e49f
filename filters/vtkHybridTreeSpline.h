// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeSpline
 * @brief   implicit primitive around a cubic spline: a tube
 *
 * LevelOfDetail leaves points of the curve out, so that the field is cheaper to evaluate.
 *
 * The points make the curve; repeats of one are dropped where the curve goes through them. Default
 * (-1, 0, 0), (-0.3, 0.5, 0), (0.3, -0.5, 0), (1, 0, 0).
 */

#ifndef vtkHybridTreeSpline_h
#define vtkHybridTreeSpline_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreePointsAlgorithm.h"

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeSpline : public vtkHybridTreePointsAlgorithm
{
public:
  static vtkHybridTreeSpline* New();
  vtkTypeMacro(vtkHybridTreeSpline, vtkHybridTreePointsAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum KindType
  {
    CATMULL_ROM = 0,
    B_SPLINE = 1
  };

  ///@{
  /**
   * CATMULL_ROM (0, default): through the points, with centripetal parameters, so that there are
   * neither cusps nor loops between unevenly spaced ones. B_SPLINE (1): a smoother curve near the
   * points, which reaches the first and the last if open.
   */
  vtkSetMacro(Kind, int);
  vtkGetMacro(Kind, int);
  ///@}

  ///@{
  /**
   * Join the last point to the first, which needs three points. Default off.
   */
  vtkSetMacro(Closed, bool);
  vtkGetMacro(Closed, bool);
  vtkBooleanMacro(Closed, bool);
  ///@}

  ///@{
  /**
   * 0 (coarse) to 4 (exact, default). Level k leaves out points as long as the curve moves by no
   * more than 2, 1, 0.5 or 0.25 % of the diagonal of its bounds (k = 0 .. 3).
   */
  vtkSetMacro(LevelOfDetail, int);
  vtkGetMacro(LevelOfDetail, int);
  ///@}

protected:
  vtkHybridTreeSpline();
  ~vtkHybridTreeSpline() override;

#ifndef __VTK_WRAP__
  std::shared_ptr<const hybridtree::Skeleton> MakeSkeleton() override;
#endif

  int Kind = CATMULL_ROM;
  bool Closed = false;
  int LevelOfDetail = 4;

private:
  vtkHybridTreeSpline(const vtkHybridTreeSpline&) = delete;
  void operator=(const vtkHybridTreeSpline&) = delete;
};

#endif
