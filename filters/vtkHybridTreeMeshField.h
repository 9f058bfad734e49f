// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeMeshField
 * @brief   makes a triangle mesh a leaf, with field parameters of your choice
 *
 * The surface of the node is the mesh itself: the field is 0.5 on the mesh, more inside, and
 * ends at InfluenceRadius outside ([HT] 4.2). Any mesh can be the input of a node directly, with
 * default field parameters; this filter is for others. It takes the mesh of a node too, and ends
 * the tree there.
 *
 * Polygons and strips are triangulated, exactly equal points become one, degenerate and double
 * triangles go, and orientations are made consistent. An open mesh gets its inside from the
 * winding number, with a warning.
 */

#ifndef vtkHybridTreeMeshField_h
#define vtkHybridTreeMeshField_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeAlgorithm.h"

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeMeshField : public vtkHybridTreeAlgorithm
{
public:
  static vtkHybridTreeMeshField* New();
  vtkTypeMacro(vtkHybridTreeMeshField, vtkHybridTreeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum FieldModeType
  {
    AUTOMATIC = 0,
    MAXIMUM_FIELD = 1
  };

  ///@{
  /**
   * How the strength of the field is given: 0 (default) twice the threshold inside the mesh, 1
   * by MaximumField.
   */
  vtkSetClampMacro(FieldMode, int, AUTOMATIC, MAXIMUM_FIELD);
  vtkGetMacro(FieldMode, int);
  ///@}

  ///@{
  /**
   * Field deep inside the mesh, no unit, >= 0.5, default 1. Used when FieldMode is 1. A larger
   * one blends wider at the same InfluenceRadius.
   */
  vtkSetMacro(MaximumField, double);
  vtkGetMacro(MaximumField, double);
  ///@}

  ///@{
  /**
   * Distance outside the mesh at which the field ends, world units, >= 0: how far the mesh
   * blends. 0 (default) means a tenth of the diagonal of the mesh's bounds.
   */
  vtkSetMacro(InfluenceRadius, double);
  vtkGetMacro(InfluenceRadius, double);
  ///@}

  ///@{
  /**
   * Exponent n of the field, 2 to 64, default 2. A larger one makes the field fall faster at
   * the surface and blends tighter.
   */
  vtkSetMacro(Exponent, int);
  vtkGetMacro(Exponent, int);
  ///@}

  ///@{
  /**
   * Carve instead of add: the field is negative. Such a mesh has no surface of its own, and an
   * empty output. Default off.
   */
  vtkSetMacro(Negative, bool);
  vtkGetMacro(Negative, bool);
  vtkBooleanMacro(Negative, bool);
  ///@}

protected:
  vtkHybridTreeMeshField();
  ~vtkHybridTreeMeshField() override;

#ifndef __VTK_WRAP__
  NodePtr MakeNode(const Operands& operands) override;
#endif

  int FillInputPortInformation(int port, vtkInformation* info) override;

  int FieldMode = AUTOMATIC;
  double MaximumField = 1.0;
  double InfluenceRadius = 0.0;
  int Exponent = 2;
  bool Negative = false;

private:
  vtkHybridTreeMeshField(const vtkHybridTreeMeshField&) = delete;
  void operator=(const vtkHybridTreeMeshField&) = delete;
};

#endif
