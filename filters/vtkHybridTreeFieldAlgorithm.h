// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeFieldAlgorithm
 * @brief   base of the implicit primitives: a skeleton's field parameters
 *
 * The field of a primitive is f = I (1 - d^2/R^2)^n within the distance d <= R of its skeleton, 0
 * beyond; its surface is where f = 0.5. The maximum I follows from the radius at which the surface
 * shall lie, or is given itself.
 */

#ifndef vtkHybridTreeFieldAlgorithm_h
#define vtkHybridTreeFieldAlgorithm_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeLeafAlgorithm.h"

namespace hybridtree
{
class Potential;
class Skeleton;
}

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeFieldAlgorithm : public vtkHybridTreeLeafAlgorithm
{
public:
  vtkTypeMacro(vtkHybridTreeFieldAlgorithm, vtkHybridTreeLeafAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * FieldMode 0 is by SurfaceRadius here.
   */
  enum SurfaceModeType
  {
    SURFACE_RADIUS = AUTOMATIC
  };

  ///@{
  /**
   * Distance of the surface from the skeleton, world units; 0 <= SurfaceRadius < InfluenceRadius.
   * Used when FieldMode is 0.
   */
  vtkSetMacro(SurfaceRadius, double);
  vtkGetMacro(SurfaceRadius, double);
  ///@}

protected:
  vtkHybridTreeFieldAlgorithm();
  ~vtkHybridTreeFieldAlgorithm() override;

#ifndef __VTK_WRAP__
  /**
   * The potential that the properties describe. \throws hybridtree::InvalidParameter
   */
  hybridtree::Potential GetPotential() const;

  /**
   * The same with other radii, world units.
   */
  hybridtree::Potential GetPotential(double surfaceRadius, double influenceRadius) const;

  NodePtr MakeNode(const Operands& operands) override;

  /**
   * The skeleton that the subclass's own properties describe.
   */
  virtual std::shared_ptr<const hybridtree::Skeleton> MakeSkeleton() = 0;
#endif

  double SurfaceRadius = 0.5;

private:
  vtkHybridTreeFieldAlgorithm(const vtkHybridTreeFieldAlgorithm&) = delete;
  void operator=(const vtkHybridTreeFieldAlgorithm&) = delete;
};

#endif
