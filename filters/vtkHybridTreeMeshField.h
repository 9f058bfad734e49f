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
 * winding number, with a warning, unless CloseHoles closes it.
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
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Close every loop of open edges by triangles of the smallest area between its points, so that
   * blends keep the triangles of a scan and its inside is exact. The new triangles have no values
   * of cell arrays (NaN or 0). A border is a loop, too: an open sheet becomes a shell without
   * thickness. Default off: holes stay as they are.
   */
  vtkSetMacro(CloseHoles, bool);
  vtkGetMacro(CloseHoles, bool);
  vtkBooleanMacro(CloseHoles, bool);
  ///@}

protected:
  vtkHybridTreeMeshField();
  ~vtkHybridTreeMeshField() override;

#ifndef __VTK_WRAP__
  NodePtr MakeNode(const Operands& operands) override;
#endif

  bool ClosesHoles() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;

  bool CloseHoles = false;

private:
  vtkHybridTreeMeshField(const vtkHybridTreeMeshField&) = delete;
  void operator=(const vtkHybridTreeMeshField&) = delete;
};

#endif
