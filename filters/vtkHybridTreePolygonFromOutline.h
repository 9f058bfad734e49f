// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreePolygonFromOutline
 * @brief   implicit primitive around a flat polygon that the input draws
 *
 * The skeleton of vtkHybridTreePolygon, its corners taken from a polydata: those of the first
 * polygon, or else of the first loop of its lines, be it one closed polyline or many pieces that
 * share points, as a slice has them. Further polygons and loops do not count.
 *
 * The outline must be flat to 1e-4 of its diagonal, and must not meet itself. By default the
 * surface lies at 0.1 from it and the field ends at 0.5.
 */

#ifndef vtkHybridTreePolygonFromOutline_h
#define vtkHybridTreePolygonFromOutline_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeFieldAlgorithm.h"

class vtkPolyData;

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreePolygonFromOutline : public vtkHybridTreeFieldAlgorithm
{
public:
  static vtkHybridTreePolygonFromOutline* New();
  vtkTypeMacro(vtkHybridTreePolygonFromOutline, vtkHybridTreeFieldAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * 0 (coarse) to 4 (exact, default). Level k leaves out corners as long as the outline moves by no
   * more than 2, 1, 0.5 or 0.25 % of the diagonal of its bounds (k = 0 .. 3), so that the field is
   * cheaper to evaluate.
   */
  vtkSetMacro(LevelOfDetail, int);
  vtkGetMacro(LevelOfDetail, int);
  ///@}

protected:
  vtkHybridTreePolygonFromOutline();
  ~vtkHybridTreePolygonFromOutline() override;

#ifndef __VTK_WRAP__
  std::shared_ptr<const hybridtree::Skeleton> MakeSkeleton() override;
  bool TakesNodes(int port) override;
  bool ReadOtherInputs() override;
#endif

  int FillInputPortInformation(int port, vtkInformation* info) override;

  int LevelOfDetail = 4;

private:
  vtkPolyData* Input = nullptr; ///< only during a run
  vtkMTimeType InputTime = 0;

  vtkHybridTreePolygonFromOutline(const vtkHybridTreePolygonFromOutline&) = delete;
  void operator=(const vtkHybridTreePolygonFromOutline&) = delete;
};

#endif
