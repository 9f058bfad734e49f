// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeSegment
 * @brief   implicit primitive around a line segment: a rod with round ends
 */

#ifndef vtkHybridTreeSegment_h
#define vtkHybridTreeSegment_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeFieldAlgorithm.h"

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeSegment : public vtkHybridTreeFieldAlgorithm
{
public:
  static vtkHybridTreeSegment* New();
  vtkTypeMacro(vtkHybridTreeSegment, vtkHybridTreeFieldAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * First end, world units. Default (-0.5, 0, 0).
   */
  vtkSetVector3Macro(Point1, double);
  vtkGetVector3Macro(Point1, double);
  ///@}

  ///@{
  /**
   * Second end, world units. May equal the first. Default (0.5, 0, 0).
   */
  vtkSetVector3Macro(Point2, double);
  vtkGetVector3Macro(Point2, double);
  ///@}

protected:
  vtkHybridTreeSegment();
  ~vtkHybridTreeSegment() override;

#ifndef __VTK_WRAP__
  std::shared_ptr<const hybridtree::Skeleton> MakeSkeleton() override;
#endif

  double Point1[3] = { -0.5, 0.0, 0.0 };
  double Point2[3] = { 0.5, 0.0, 0.0 };

private:
  vtkHybridTreeSegment(const vtkHybridTreeSegment&) = delete;
  void operator=(const vtkHybridTreeSegment&) = delete;
};

#endif
