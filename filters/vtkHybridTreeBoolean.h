// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeBoolean
 * @brief   union, intersection or difference of two nodes
 *
 * A is port 0, B is port 1 ([HT] 4.4). Disjoint, touching and equal operands are answered, with
 * an empty output where nothing is left. The meshes of both are cut ([HT] 5.3): triangles away from
 * the cut stay as they are, and the edges of the cut are sharp.
 *
 * Output port 1 has the curves in which the surfaces of A and B cross, as polylines.
 */

#ifndef vtkHybridTreeBoolean_h
#define vtkHybridTreeBoolean_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeAlgorithm.h"

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeBoolean : public vtkHybridTreeAlgorithm
{
public:
  static vtkHybridTreeBoolean* New();
  vtkTypeMacro(vtkHybridTreeBoolean, vtkHybridTreeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum OperationType
  {
    UNION = 0,
    INTERSECTION = 1,
    DIFFERENCE = 2
  };

  enum FormType
  {
    AUTOMATIC = 0,
    MIN_MAX = 1,
    SMOOTH = 2,
    PAPER = 3
  };

  ///@{
  /**
   * UNION (0, default): what is in A or B. INTERSECTION (1): what is in both. DIFFERENCE (2):
   * what is in A and not in B.
   */
  vtkSetMacro(Operation, int);
  vtkGetMacro(Operation, int);
  ///@}

  ///@{
  /**
   * How the field is made away from the surface: MIN_MAX (1) has creases that show when a
   * blend stands above, SMOOTH (2) has none, PAPER (3) is what [HT] prints, for comparison.
   * AUTOMATIC (0, default) is smooth below a blend and min/max elsewhere.
   */
  vtkSetMacro(Form, int);
  vtkGetMacro(Form, int);
  ///@}

protected:
  vtkHybridTreeBoolean();
  ~vtkHybridTreeBoolean() override;

#ifndef __VTK_WRAP__
  NodePtr MakeNode(const Operands& operands) override;
  void FillOtherOutputs(vtkInformationVector* outputs) override;
#endif

  int Operation = UNION;
  int Form = AUTOMATIC;

private:
  vtkHybridTreeBoolean(const vtkHybridTreeBoolean&) = delete;
  void operator=(const vtkHybridTreeBoolean&) = delete;
};

#endif
