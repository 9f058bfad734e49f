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
 * With FieldMode 0 the field deep inside is 1; MaximumField must be 0.5 or more. InfluenceRadius is
 * measured outside of the mesh; 0 (default) means a tenth of the diagonal of the mesh's bounds.
 *
 * Polygons and strips are triangulated, exactly equal points become one, degenerate and double
 * triangles go, and orientations are made consistent. An open mesh gets its inside from the
 * winding number, with a warning.
 */

#ifndef vtkHybridTreeMeshField_h
#define vtkHybridTreeMeshField_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeLeafAlgorithm.h"

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeMeshField : public vtkHybridTreeLeafAlgorithm
{
public:
  static vtkHybridTreeMeshField* New();
  vtkTypeMacro(vtkHybridTreeMeshField, vtkHybridTreeLeafAlgorithm);

protected:
  vtkHybridTreeMeshField();
  ~vtkHybridTreeMeshField() override;

#ifndef __VTK_WRAP__
  NodePtr MakeNode(const Operands& operands) override;
#endif

  int FillInputPortInformation(int port, vtkInformation* info) override;

private:
  vtkHybridTreeMeshField(const vtkHybridTreeMeshField&) = delete;
  void operator=(const vtkHybridTreeMeshField&) = delete;
};

#endif
