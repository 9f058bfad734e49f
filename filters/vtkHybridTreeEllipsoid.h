// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeEllipsoid
 * @brief   implicit primitive around a solid ellipsoid
 *
 * The skeleton is the volume: the field is largest everywhere inside, and falls with the Euclidean
 * distance outside, so that SurfaceRadius adds the same thickness everywhere. By default the
 * surface lies at 0.1 from the ellipsoid and the field ends at 0.5.
 */

#ifndef vtkHybridTreeEllipsoid_h
#define vtkHybridTreeEllipsoid_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeFieldAlgorithm.h"

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeEllipsoid : public vtkHybridTreeFieldAlgorithm
{
public:
  static vtkHybridTreeEllipsoid* New();
  vtkTypeMacro(vtkHybridTreeEllipsoid, vtkHybridTreeFieldAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Centre of the ellipsoid, world units. Default (0, 0, 0).
   */
  vtkSetVector3Macro(Center, double);
  vtkGetVector3Macro(Center, double);
  ///@}

  ///@{
  /**
   * Radii along the ellipsoid's own axes, world units, each > 0. Default (1, 0.6, 0.4).
   */
  vtkSetVector3Macro(Radii, double);
  vtkGetVector3Macro(Radii, double);
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
  vtkHybridTreeEllipsoid();
  ~vtkHybridTreeEllipsoid() override;

#ifndef __VTK_WRAP__
  std::shared_ptr<const hybridtree::Skeleton> MakeSkeleton() override;
#endif

  double Center[3] = { 0.0, 0.0, 0.0 };
  double Radii[3] = { 1.0, 0.6, 0.4 };
  double Rotation[3] = { 0.0, 0.0, 0.0 };

private:
  vtkHybridTreeEllipsoid(const vtkHybridTreeEllipsoid&) = delete;
  void operator=(const vtkHybridTreeEllipsoid&) = delete;
};

#endif
