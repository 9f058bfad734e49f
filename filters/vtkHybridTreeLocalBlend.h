// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeLocalBlend
 * @brief   blend of two nodes where a third one is
 *
 * A (port 0) and B (port 1) are blended where the field of Region (port 2) is 1 or more, united
 * where it is 0, and something between in between ([HT] 4.3). Several inputs of Region are
 * united. A negative region changes nothing.
 */

#ifndef vtkHybridTreeLocalBlend_h
#define vtkHybridTreeLocalBlend_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeAlgorithm.h"

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeLocalBlend : public vtkHybridTreeAlgorithm
{
public:
  static vtkHybridTreeLocalBlend* New();
  vtkTypeMacro(vtkHybridTreeLocalBlend, vtkHybridTreeAlgorithm);
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
  vtkHybridTreeLocalBlend();
  ~vtkHybridTreeLocalBlend() override;

#ifndef __VTK_WRAP__
  NodePtr MakeNode(const Operands& operands) override;
#endif

  int FillInputPortInformation(int port, vtkInformation* info) override;

  int Method = AUTOMATIC;
  double OverlapThreshold = 0.5;

private:
  vtkHybridTreeLocalBlend(const vtkHybridTreeLocalBlend&) = delete;
  void operator=(const vtkHybridTreeLocalBlend&) = delete;
};

#endif
