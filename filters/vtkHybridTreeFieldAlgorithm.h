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
#include "vtkHybridTreeAlgorithm.h"

namespace hybridtree
{
class Potential;
class Skeleton;
}

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeFieldAlgorithm : public vtkHybridTreeAlgorithm
{
public:
  vtkTypeMacro(vtkHybridTreeFieldAlgorithm, vtkHybridTreeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum FieldModeType
  {
    SURFACE_RADIUS = 0,
    MAXIMUM_FIELD = 1
  };

  ///@{
  /**
   * How the strength of the field is given: 0 (default) by SurfaceRadius, 1 by MaximumField.
   */
  vtkSetClampMacro(FieldMode, int, SURFACE_RADIUS, MAXIMUM_FIELD);
  vtkGetMacro(FieldMode, int);
  ///@}

  ///@{
  /**
   * Distance of the surface from the skeleton, world units; 0 <= SurfaceRadius < InfluenceRadius.
   * Used when FieldMode is 0.
   */
  vtkSetMacro(SurfaceRadius, double);
  vtkGetMacro(SurfaceRadius, double);
  ///@}

  ///@{
  /**
   * Field value on the skeleton, no unit, > 0; there is a surface from 0.5 on. Used when FieldMode
   * is 1. Default 1.
   */
  vtkSetMacro(MaximumField, double);
  vtkGetMacro(MaximumField, double);
  ///@}

  ///@{
  /**
   * Distance from the skeleton at which the field ends, world units, > 0: how far the primitive
   * blends.
   */
  vtkSetMacro(InfluenceRadius, double);
  vtkGetMacro(InfluenceRadius, double);
  ///@}

  ///@{
  /**
   * Exponent n of the field, 2 to 64, default 2. A larger one makes the field fall faster near the
   * skeleton and blends tighter.
   */
  vtkSetMacro(Exponent, int);
  vtkGetMacro(Exponent, int);
  ///@}

  ///@{
  /**
   * Carve instead of add: the field is negative. Such a primitive has no surface of its own, and an
   * empty output; it shows where something blends with it. Default off.
   */
  vtkSetMacro(Negative, bool);
  vtkGetMacro(Negative, bool);
  vtkBooleanMacro(Negative, bool);
  ///@}

protected:
  vtkHybridTreeFieldAlgorithm();
  ~vtkHybridTreeFieldAlgorithm() override;

#ifndef __VTK_WRAP__
  /**
   * The potential that the properties describe. \throws hybridtree::InvalidParameter
   */
  hybridtree::Potential GetPotential() const;

  NodePtr MakeNode(const Operands& operands) override;

  /**
   * The skeleton that the subclass's own properties describe.
   */
  virtual std::shared_ptr<const hybridtree::Skeleton> MakeSkeleton() = 0;
#endif

  int FieldMode = SURFACE_RADIUS;
  double SurfaceRadius = 0.5;
  double MaximumField = 1.0;
  double InfluenceRadius = 1.0;
  int Exponent = 2;
  bool Negative = false;

private:
  vtkHybridTreeFieldAlgorithm(const vtkHybridTreeFieldAlgorithm&) = delete;
  void operator=(const vtkHybridTreeFieldAlgorithm&) = delete;
};

#endif
