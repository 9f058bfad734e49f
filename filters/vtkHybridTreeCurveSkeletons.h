// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeCurveSkeletons
 * @brief   implicit primitives around all curves of a polydata
 *
 * Each vertex of the input is a point skeleton, each line or polyline a curve: a chain of segments
 * or a spline through its points; one whose last point is its first is closed. Hundreds of
 * primitives are one node. Polygons of the input do not count.
 *
 * Where SurfaceRadius is 0 (default) it is 3 % of the longest side of the curves' bounds, at most
 * half of InfluenceRadius; where InfluenceRadius is 0 (default) it is twice the surface radius.
 *
 * RadiusArray, a point array of one component, gives the surface its radius along the curves; the
 * other field parameters are then scaled from curve to curve by its largest radius.
 */

#ifndef vtkHybridTreeCurveSkeletons_h
#define vtkHybridTreeCurveSkeletons_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeFieldAlgorithm.h"

#include <string> // for RadiusArray
#include <vector> // for curves

class vtkPolyData;

namespace hybridtree
{
struct SplineCurve;
}

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeCurveSkeletons : public vtkHybridTreeFieldAlgorithm
{
public:
  static vtkHybridTreeCurveSkeletons* New();
  vtkTypeMacro(vtkHybridTreeCurveSkeletons, vtkHybridTreeFieldAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum AsType
  {
    SEGMENTS = 0,
    SPLINE = 1
  };

  enum BlendType
  {
    WITHIN_CURVE = 0,
    ACROSS_ALL = 1
  };

  ///@{
  /**
   * Name of the point array with the surface radius at each point, world units, >= 0, and > 0
   * somewhere on each curve. Empty or "None" (default): SurfaceRadius everywhere.
   */
  vtkSetStdStringFromCharMacro(RadiusArray);
  vtkGetCharFromStdStringMacro(RadiusArray);
  ///@}

  ///@{
  /**
   * What a polyline becomes: SEGMENTS (0), straight from point to point, or SPLINE (1, default), a
   * smooth curve through its points.
   */
  vtkSetMacro(As, int);
  vtkGetMacro(As, int);
  ///@}

  ///@{
  /**
   * Which curves blend: WITHIN_CURVE (0), each only with itself, and all are united; or ACROSS_ALL
   * (1, default).
   */
  vtkSetMacro(Blend, int);
  vtkGetMacro(Blend, int);
  ///@}

  ///@{
  /**
   * 0 (coarse) to 4 (exact, default). Level k leaves out points of curves as long as these move by
   * no more than 2, 1, 0.5 or 0.25 % of the diagonal of each curve's bounds (k = 0 .. 3).
   */
  vtkSetMacro(LevelOfDetail, int);
  vtkGetMacro(LevelOfDetail, int);
  ///@}

protected:
  vtkHybridTreeCurveSkeletons();
  ~vtkHybridTreeCurveSkeletons() override;

#ifndef __VTK_WRAP__
  NodePtr MakeNode(const Operands& operands) override;
  std::shared_ptr<const hybridtree::Skeleton> MakeSkeleton() override;
  bool TakesNodes(int port) override;
  bool ReadOtherInputs() override;
  hybridtree::Potential FittedPotential(const std::vector<hybridtree::SplineCurve>& curves) const;
#endif

  int FillInputPortInformation(int port, vtkInformation* info) override;

  std::string RadiusArray = "None";
  int As = SPLINE;
  int Blend = ACROSS_ALL;
  int LevelOfDetail = 4;

private:
  vtkPolyData* Input = nullptr; ///< only during a run
  vtkMTimeType InputTime = 0;

  vtkHybridTreeCurveSkeletons(const vtkHybridTreeCurveSkeletons&) = delete;
  void operator=(const vtkHybridTreeCurveSkeletons&) = delete;
};

#endif
