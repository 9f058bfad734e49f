// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeSurfaceOfRevolution
 * @brief   implicit primitive around a profile that turns about an axis
 *
 * Of each profile point only its distance from the axis and its height along it count: a profile
 * drawn anywhere in space will do. As a solid the primitive fills what is between profile and axis
 * (or what a closed profile encloses), otherwise it is a wall of twice SurfaceRadius.
 *
 * The optional input draws the profile: what its first line goes on to draw, be it one polyline or
 * many pieces that share points, as a slice has them; or else its first polygon. Further lines do
 * not count. Without an input the points make the profile.
 *
 * LevelOfDetail leaves points of the profile out, so that the field is cheaper to evaluate.
 *
 * The points are the profile, from one end of the axis to the other; repeats are dropped. Default
 * (0.6, 0, -1), (0.9, 0, -0.4), (0.4, 0, 0.4), (0.5, 0, 1): a vase.
 */

#ifndef vtkHybridTreeSurfaceOfRevolution_h
#define vtkHybridTreeSurfaceOfRevolution_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreePointsAlgorithm.h"

class vtkPolyData;

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeSurfaceOfRevolution
  : public vtkHybridTreePointsAlgorithm
{
public:
  static vtkHybridTreeSurfaceOfRevolution* New();
  vtkTypeMacro(vtkHybridTreeSurfaceOfRevolution, vtkHybridTreePointsAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum KindType
  {
    CATMULL_ROM = 0,
    B_SPLINE = 1,
    POLYLINE = 2
  };

  ///@{
  /**
   * CATMULL_ROM (0, default): through the points, with centripetal parameters, so that there are
   * neither cusps nor loops between unevenly spaced ones. B_SPLINE (1): a smoother curve near the
   * points, which reaches the first and the last if open. POLYLINE (2): straight lines.
   */
  vtkSetMacro(Kind, int);
  vtkGetMacro(Kind, int);
  ///@}

  ///@{
  /**
   * Join the last point to the first, which needs three points. Default off. Lines of an input that
   * close make a closed profile by themselves.
   */
  vtkSetMacro(Closed, bool);
  vtkGetMacro(Closed, bool);
  vtkBooleanMacro(Closed, bool);
  ///@}

  ///@{
  /**
   * A point of the axis, world units. Default (0, 0, 0).
   */
  vtkSetVector3Macro(Origin, double);
  vtkGetVector3Macro(Origin, double);
  ///@}

  ///@{
  /**
   * Direction of the axis, of any length but 0. Default (0, 0, 1).
   */
  vtkSetVector3Macro(Axis, double);
  vtkGetVector3Macro(Axis, double);
  ///@}

  ///@{
  /**
   * Fill the volume between profile and axis, with flat ends where the profile does not reach the
   * axis. Default on; off makes a wall around the profile.
   */
  vtkSetMacro(Solid, bool);
  vtkGetMacro(Solid, bool);
  vtkBooleanMacro(Solid, bool);
  ///@}

  ///@{
  /**
   * 0 (coarse) to 4 (exact, default). Level k leaves out points as long as the profile moves by no
   * more than 2, 1, 0.5 or 0.25 % of the diagonal of its bounds (k = 0 .. 3).
   */
  vtkSetMacro(LevelOfDetail, int);
  vtkGetMacro(LevelOfDetail, int);
  ///@}

protected:
  vtkHybridTreeSurfaceOfRevolution();
  ~vtkHybridTreeSurfaceOfRevolution() override;

#ifndef __VTK_WRAP__
  std::shared_ptr<const hybridtree::Skeleton> MakeSkeleton() override;
  bool TakesNodes(int port) override;
  bool ReadOtherInputs() override;
#endif

  int FillInputPortInformation(int port, vtkInformation* info) override;

  int Kind = CATMULL_ROM;
  bool Closed = false;
  double Origin[3] = { 0.0, 0.0, 0.0 };
  double Axis[3] = { 0.0, 0.0, 1.0 };
  bool Solid = true;
  int LevelOfDetail = 4;

private:
  vtkPolyData* Input = nullptr; ///< only during a run; null without one
  vtkMTimeType InputTime = 0;

  vtkHybridTreeSurfaceOfRevolution(const vtkHybridTreeSurfaceOfRevolution&) = delete;
  void operator=(const vtkHybridTreeSurfaceOfRevolution&) = delete;
};

#endif
