// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeBox
 * @brief   implicit primitive around a solid box: a box with rounded edges
 *
 * The skeleton is the volume: the field is largest everywhere inside the box, and SurfaceRadius
 * rounds what is outside of it.
 */

#ifndef vtkHybridTreeBox_h
#define vtkHybridTreeBox_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeFieldAlgorithm.h"

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeBox : public vtkHybridTreeFieldAlgorithm
{
public:
  static vtkHybridTreeBox* New();
  vtkTypeMacro(vtkHybridTreeBox, vtkHybridTreeFieldAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Centre of the box, world units. Default (0, 0, 0).
   */
  vtkSetVector3Macro(Center, double);
  vtkGetVector3Macro(Center, double);
  ///@}

  ///@{
  /**
   * Full edge lengths of the box along its own axes, world units, each > 0. Default (1, 1, 1).
   */
  vtkSetVector3Macro(Lengths, double);
  vtkGetVector3Macro(Lengths, double);
  ///@}

  ///@{
  /**
   * Rotation about the centre, degrees about x, y and z, in ParaView's order: about z, then
   * about the x axis it has turned, then about the y axis. Default (0, 0, 0).
   */
  vtkSetVector3Macro(Rotation, double);
  vtkGetVector3Macro(Rotation, double);
  ///@}

protected:
  vtkHybridTreeBox();
  ~vtkHybridTreeBox() override;

#ifndef __VTK_WRAP__
  std::shared_ptr<const hybridtree::Skeleton> MakeSkeleton() override;
#endif

  double Center[3] = { 0.0, 0.0, 0.0 };
  double Lengths[3] = { 1.0, 1.0, 1.0 };
  double Rotation[3] = { 0.0, 0.0, 0.0 };

private:
  vtkHybridTreeBox(const vtkHybridTreeBox&) = delete;
  void operator=(const vtkHybridTreeBox&) = delete;
};

#endif
