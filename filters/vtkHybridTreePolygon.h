// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreePolygon
 * @brief   implicit primitive around a flat polygon: a plate with a round rim
 *
 * The outline may be convex or not, without holes; it must not meet itself, and be flat to 1e-4 of
 * its diagonal.
 *
 * A surface: it has no inside, and needs a SurfaceRadius > 0 to make one. By default the surface
 * lies at 0.1 from it and the field ends at 0.5.
 */

#ifndef vtkHybridTreePolygon_h
#define vtkHybridTreePolygon_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeFieldAlgorithm.h"

#include <array>  // for Points
#include <vector> // for Points

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreePolygon : public vtkHybridTreeFieldAlgorithm
{
public:
  static vtkHybridTreePolygon* New();
  vtkTypeMacro(vtkHybridTreePolygon, vtkHybridTreeFieldAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Corners in order around the outline, either way; world units. By default six that make a letter
   * L in the plane z = 0. Points that are added are at the origin until they are set; points that
   * do not exist cannot be set and are 0.
   */
  void SetNumberOfPoints(int count);
  int GetNumberOfPoints() const;
  void SetPoint(int index, double x, double y, double z);
  void GetPoint(int index, double point[3]) const;
  ///@}

protected:
  vtkHybridTreePolygon();
  ~vtkHybridTreePolygon() override;

#ifndef __VTK_WRAP__
  std::shared_ptr<const hybridtree::Skeleton> MakeSkeleton() override;
#endif

private:
  vtkHybridTreePolygon(const vtkHybridTreePolygon&) = delete;
  void operator=(const vtkHybridTreePolygon&) = delete;

  std::vector<std::array<double, 3>> Points = { { -0.5, -0.5, 0.0 }, { 0.5, -0.5, 0.0 },
    { 0.5, 0.0, 0.0 }, { 0.0, 0.0, 0.0 }, { 0.0, 0.5, 0.0 }, { -0.5, 0.5, 0.0 } };
};

#endif
