// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeProbe
 * @brief   asks a node for its field on the points of any data set
 *
 * Port 0, Tree, is a node or a mesh; port 1, Points, any vtkDataSet. The output is a shallow copy
 * of Points with the point arrays
 * - Field: the field, 0.5 on the surface and more inside;
 * - Gradient: its gradient, per world unit (3 components);
 * - Membership: 1 inside, 0 on the surface, -1 outside (signed char);
 * - SignedDistance: Euclidean distance to the surface in world units, negative inside; NaN where
 * the node does not know it.
 *
 * Pieces: Points is asked for as the output is, and each piece gets its own points' values; Tree is
 * asked for as a whole by every process.
 */

#ifndef vtkHybridTreeProbe_h
#define vtkHybridTreeProbe_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkDataSetAlgorithm.h"

#include <memory> // for std::unique_ptr

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeProbe : public vtkDataSetAlgorithm
{
public:
  static vtkHybridTreeProbe* New();
  vtkTypeMacro(vtkHybridTreeProbe, vtkDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkHybridTreeProbe();
  ~vtkHybridTreeProbe() override;

  int ModifyRequest(vtkInformation* request, int when) override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkHybridTreeProbe(const vtkHybridTreeProbe&) = delete;
  void operator=(const vtkHybridTreeProbe&) = delete;

  struct State;
  std::unique_ptr<State> Internals;
};

#endif
