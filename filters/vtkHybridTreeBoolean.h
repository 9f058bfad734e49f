// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeBoolean
 * @brief   union, intersection or difference of nodes
 *
 * A is port 0, B is port 1 ([HT] 4.4), which takes any number of connections: all are united with
 * A, intersected with it, or cut from it. Disjoint, touching and equal operands are answered, with
 * an empty output where nothing is left. Meshes are cut ([HT] 5.3): triangles away from the cut
 * stay as they are, and the edges of the cut are sharp.
 *
 * Output port 1 has the curves in which the surfaces of the operands cross, as polylines; those of
 * operands that are Booleans too, as far as they are still there.
 */

#ifndef vtkHybridTreeBoolean_h
#define vtkHybridTreeBoolean_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeAlgorithm.h"

namespace hybridtree
{
class BooleanNest;
}

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
   * UNION (0, default): what is in A or any B. INTERSECTION (1): what is in all. DIFFERENCE (2):
   * what is in A and in no B.
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

  enum MergeCoplanarType
  {
    MERGE_NOTHING = 0,
    MERGE_PARTS = 1
  };

  ///@{
  /**
   * Which triangles at a cut are triangulated afresh as one, from their border alone. MERGE_PARTS
   * (1, default): what this and Booleans before it have left of one triangle, so that holes drilled
   * in turn leave no needles; arrays stay right, as they are linear there, and triangles away from
   * the cut stay as they are. MERGE_NOTHING (0): every cut keeps the edges of those before.
   */
  vtkSetMacro(MergeCoplanar, int);
  vtkGetMacro(MergeCoplanar, int);
  ///@}

  /**
   * Takes all connections from B: ParaView does so before it sets them anew.
   */
  void RemoveAllB();

protected:
  vtkHybridTreeBoolean();
  ~vtkHybridTreeBoolean() override;

#ifndef __VTK_WRAP__
  NodePtr MakeNode(const Operands& operands) override;
  const char* InputName(int port) override;
  void FillOtherOutputs(vtkInformationVector* outputs) override;
#endif

  int FillInputPortInformation(int port, vtkInformation* info) override;

  int Operation = UNION;
  int Form = AUTOMATIC;
  int MergeCoplanar = MERGE_PARTS;

private:
  vtkHybridTreeBoolean(const vtkHybridTreeBoolean&) = delete;
  void operator=(const vtkHybridTreeBoolean&) = delete;

#ifndef __VTK_WRAP__
  std::unique_ptr<hybridtree::BooleanNest> Nest; // what changed operands leave as it is
#endif
};

#endif
