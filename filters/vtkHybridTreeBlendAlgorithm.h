// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeBlendAlgorithm
 * @brief   base of the blends: how their meshes are made
 */

#ifndef vtkHybridTreeBlendAlgorithm_h
#define vtkHybridTreeBlendAlgorithm_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeAlgorithm.h"

namespace hybridtree
{
struct BlendOptions;
}

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeBlendAlgorithm : public vtkHybridTreeAlgorithm
{
public:
  vtkTypeMacro(vtkHybridTreeBlendAlgorithm, vtkHybridTreeAlgorithm);
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
  vtkSetMacro(Method, int);
  vtkGetMacro(Method, int);
  ///@}

  ///@{
  /**
   * Overlap ratio rho_0 up to which operands keep their own triangles ([HT] 5.2.1), no unit,
   * range [0, 1], default 0.5. The shape does not depend on it.
   */
  vtkSetMacro(OverlapThreshold, double);
  vtkGetMacro(OverlapThreshold, double);
  ///@}

protected:
  vtkHybridTreeBlendAlgorithm();
  ~vtkHybridTreeBlendAlgorithm() override;

#ifndef __VTK_WRAP__
  /**
   * What the properties say; the node checks them.
   */
  hybridtree::BlendOptions GetOptions() const;
#endif

  int Method = AUTOMATIC;
  double OverlapThreshold = 0.5;

private:
  vtkHybridTreeBlendAlgorithm(const vtkHybridTreeBlendAlgorithm&) = delete;
  void operator=(const vtkHybridTreeBlendAlgorithm&) = delete;
};

#endif
