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
   * What of the mesh is made anew: NODE_BASED (1) only where the operands meet, PRIMITIVE_BASED (2)
   * only where those meet that blends among the operands are made of, GLOBAL (3) everything;
   * AUTOMATIC (0, default) is primitive-based where meshes take part or shapes hardly meet,
   * else global. Elsewhere the operands' triangles stay as they are. The shape is the same for all.
   */
  vtkSetMacro(Method, int);
  vtkGetMacro(Method, int);
  ///@}

  ///@{
  /**
   * Overlap ratio rho_0 ([HT] 5.2.1), no unit, range [0, 1], default 0.5: an operand more of whose
   * box of influence than this lies in those of the others gives up its own triangles. The shape
   * does not depend on it.
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
