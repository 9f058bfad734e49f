// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeAffineTransform
 * @brief   move, turn and scale a node
 *
 * The map is passed down to the leaves of the tree ([HT] 4.5.3), so that nothing is resampled
 * and the result stays a tree.
 */

#ifndef vtkHybridTreeAffineTransform_h
#define vtkHybridTreeAffineTransform_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeAlgorithm.h"

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeAffineTransform : public vtkHybridTreeAlgorithm
{
public:
  static vtkHybridTreeAffineTransform* New();
  vtkTypeMacro(vtkHybridTreeAffineTransform, vtkHybridTreeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Movement, world units, applied last. Default (0, 0, 0).
   */
  vtkSetVector3Macro(Translate, double);
  vtkGetVector3Macro(Translate, double);
  ///@}

  ///@{
  /**
   * Rotation about Center, degrees about x, y and z, in ParaView's order: about z, then about
   * the x axis it has turned, then about the y axis. Default (0, 0, 0).
   */
  vtkSetVector3Macro(Rotate, double);
  vtkGetVector3Macro(Rotate, double);
  ///@}

  ///@{
  /**
   * Scale along x, y and z about Center, applied first, no unit, each other than 0; negative
   * mirrors. Default (1, 1, 1).
   */
  vtkSetVector3Macro(Scale, double);
  vtkGetVector3Macro(Scale, double);
  ///@}

  ///@{
  /**
   * Fixed point of rotation and scale, world units. Default (0, 0, 0).
   */
  vtkSetVector3Macro(Center, double);
  vtkGetVector3Macro(Center, double);
  ///@}

protected:
  vtkHybridTreeAffineTransform();
  ~vtkHybridTreeAffineTransform() override;

#ifndef __VTK_WRAP__
  NodePtr MakeNode(const Operands& operands) override;
#endif

  double Translate[3] = { 0.0, 0.0, 0.0 };
  double Rotate[3] = { 0.0, 0.0, 0.0 };
  double Scale[3] = { 1.0, 1.0, 1.0 };
  double Center[3] = { 0.0, 0.0, 0.0 };

private:
  vtkHybridTreeAffineTransform(const vtkHybridTreeAffineTransform&) = delete;
  void operator=(const vtkHybridTreeAffineTransform&) = delete;
};

#endif
