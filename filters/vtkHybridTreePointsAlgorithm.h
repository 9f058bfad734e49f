// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreePointsAlgorithm
 * @brief   base of primitives whose skeleton is given by any number of points
 */

#ifndef vtkHybridTreePointsAlgorithm_h
#define vtkHybridTreePointsAlgorithm_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeFieldAlgorithm.h"

#include <array>  // for Points
#include <vector> // for Points

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreePointsAlgorithm : public vtkHybridTreeFieldAlgorithm
{
public:
  vtkTypeMacro(vtkHybridTreePointsAlgorithm, vtkHybridTreeFieldAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The points in order, world units. Points that are added are at the origin until they are set;
   * to set one that does not exist is an error, to get one gives the origin.
   */
  void SetNumberOfPoints(int count);
  int GetNumberOfPoints() const;
  void SetPoint(int index, double x, double y, double z);
  void GetPoint(int index, double point[3]) const;
  ///@}

protected:
  vtkHybridTreePointsAlgorithm();
  ~vtkHybridTreePointsAlgorithm() override;

#ifndef __VTK_WRAP__
  std::vector<std::array<double, 3>> Points;
#endif

private:
  vtkHybridTreePointsAlgorithm(const vtkHybridTreePointsAlgorithm&) = delete;
  void operator=(const vtkHybridTreePointsAlgorithm&) = delete;
};

#endif
