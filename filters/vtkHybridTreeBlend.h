// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeBlend
 * @brief   global blend of any number of nodes and meshes
 *
 * The field is the sum of the fields of all inputs ([HT] 4.3); negative ones carve. The order of
 * the inputs does not change the surface.
 */

#ifndef vtkHybridTreeBlend_h
#define vtkHybridTreeBlend_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeAlgorithm.h"

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeBlend : public vtkHybridTreeAlgorithm
{
public:
  static vtkHybridTreeBlend* New();
  vtkTypeMacro(vtkHybridTreeBlend, vtkHybridTreeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum MethodType
  {
    AUTOMATIC = 0,
    NODE_BASED = 1,
    PRIMITIVE_BASED = 2,
    GLOBAL = 3
  };

  ///@{
  /**
   * How the mesh is made: AUTOMATIC (0, default) chooses, NODE_BASED (1) meshes the overlap of
   * the operands anew, PRIMITIVE_BASED (2) the overlap of the leaves, GLOBAL (3) everything.
   * The shape is the same for all. At present every method meshes everything.
   */
  vtkSetClampMacro(Method, int, AUTOMATIC, GLOBAL);
  vtkGetMacro(Method, int);
  ///@}

  ///@{
  /**
   * Overlap ratio rho_0 up to which operands keep their own triangles ([HT] 5.2.1), no unit,
   * range [0, 1], default 0.5. The shape does not depend on it.
   */
  vtkSetClampMacro(OverlapThreshold, double, 0.0, 1.0);
  vtkGetMacro(OverlapThreshold, double);
  ///@}

protected:
  vtkHybridTreeBlend();
  ~vtkHybridTreeBlend() override;

#ifndef __VTK_WRAP__
  NodePtr MakeNode(const Operands& operands) override;
#endif

  int FillInputPortInformation(int port, vtkInformation* info) override;

  int Method = AUTOMATIC;
  double OverlapThreshold = 0.5;

private:
  vtkHybridTreeBlend(const vtkHybridTreeBlend&) = delete;
  void operator=(const vtkHybridTreeBlend&) = delete;
};

#endif
