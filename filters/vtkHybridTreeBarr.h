// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeBarr
 * @brief   base of twist, taper and bend: a local frame and a range along its axis
 */

#ifndef vtkHybridTreeBarr_h
#define vtkHybridTreeBarr_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeAlgorithm.h"

namespace hybridtree
{
struct BarrFrame;
}

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeBarr : public vtkHybridTreeAlgorithm
{
public:
  vtkTypeMacro(vtkHybridTreeBarr, vtkHybridTreeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * A point on the axis, world units. Default (0, 0, 0); see FitToInput.
   */
  vtkSetVector3Macro(Origin, double);
  vtkGetVector3Macro(Origin, double);
  ///@}

  ///@{
  /**
   * Direction of the axis: any length but 0, only the direction counts. Default (0, 0, 1).
   */
  vtkSetVector3Macro(Axis, double);
  vtkGetVector3Macro(Axis, double);
  ///@}

  ///@{
  /**
   * Direction across the axis towards which a bend goes. Its part along the axis does not count; it
   * must not be parallel to the axis. Twist and taper do not depend on it. Default (1, 0, 0).
   */
  vtkSetVector3Macro(Normal, double);
  vtkGetVector3Macro(Normal, double);
  ///@}

  ///@{
  /**
   * Where along the axis the deformation begins and ends, world units from Origin, begin < end. Two
   * equal numbers mean the whole extent of the input. Default (0, 0).
   */
  vtkSetVector2Macro(Range, double);
  vtkGetVector2Macro(Range, double);
  ///@}

  ///@{
  /**
   * On (default): an Origin of (0, 0, 0) stands for the centre of the input's bounds, so that an
   * input of any size and place is visibly deformed. Switch off to mean the origin of the world.
   */
  vtkSetMacro(FitToInput, bool);
  vtkGetMacro(FitToInput, bool);
  vtkBooleanMacro(FitToInput, bool);
  ///@}

protected:
  vtkHybridTreeBarr();
  ~vtkHybridTreeBarr() override;

#ifndef __VTK_WRAP__
  /**
   * The frame that the properties describe for an input.
   */
  hybridtree::BarrFrame GetFrame(const hybridtree::Node& input) const;

  /**
   * The same for a deformation that is alike all around the axis: any Normal will do.
   */
  hybridtree::BarrFrame GetFrameAroundAxis(const hybridtree::Node& input) const;
#endif

  double Origin[3] = { 0.0, 0.0, 0.0 };
  double Axis[3] = { 0.0, 0.0, 1.0 };
  double Normal[3] = { 1.0, 0.0, 0.0 };
  double Range[2] = { 0.0, 0.0 };
  bool FitToInput = true;

private:
  vtkHybridTreeBarr(const vtkHybridTreeBarr&) = delete;
  void operator=(const vtkHybridTreeBarr&) = delete;
};

#endif
