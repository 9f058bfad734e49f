// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeReconstruction
 * @brief   closed triangle mesh through the points of a data set
 *
 * The input is anything with points; its cells are ignored. Points that coincide count once,
 * outliers are removed and the rest is thinned if asked for, or picked by a level of detail while
 * the surface is made; geometric convection over their
 * Delaunay tetrahedralization then gives the surface of a solid ([HT] 3; Chaine 2003): closed
 * (unless holes are to stay open), 2-manifold, oriented outward, its vertices a subset of the
 * input's points, bit for bit (unless they are smoothed).
 *
 * Output point data: Normals (unit, outward, area weighted), PointIds (index of the input point)
 * and the input's point arrays but for one called Normals. Cell data: SourceId, 0 throughout, with
 * the leaf's name in the field data SourceNames. The output is a node of the HybridTree, a mesh
 * leaf with a tenth of its diagonal as radius of influence.
 *
 * Pieces: the first piece is everything, all other pieces are empty; the input is asked for as one
 * piece. Blocks of composite data, and the parts that several processes have, are one point set.
 */

#ifndef vtkHybridTreeReconstruction_h
#define vtkHybridTreeReconstruction_h

#include "HybridTreeReconstructionModule.h" // for export macro
#include "vtkPolyDataAlgorithm.h"

#include <cstddef> // for numbers of points
#include <memory>  // for the state that is kept

class vtkDataSet;
namespace hybridtree
{
class KeptReconstruction;
struct WorkEstimate;
}

class HYBRIDTREERECONSTRUCTION_EXPORT vtkHybridTreeReconstruction : public vtkPolyDataAlgorithm
{
public:
  static vtkHybridTreeReconstruction* New();
  vtkTypeMacro(vtkHybridTreeReconstruction, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Least distance between the points that are used, world units, >= 0; 0 (default) keeps all.
   * Every point left out is within this distance of one that is used.
   */
  vtkSetMacro(Spacing, double);
  vtkGetMacro(Spacing, double);
  ///@}

  ///@{
  /**
   * Drop points whose mean distance to their OutlierNeighbors nearest neighbours is more than
   * OutlierDeviation standard deviations above the average. Default off.
   */
  vtkSetMacro(RemoveOutliers, bool);
  vtkGetMacro(RemoveOutliers, bool);
  vtkBooleanMacro(RemoveOutliers, bool);
  ///@}

  ///@{
  /**
   * Number of neighbours that decide on an outlier, 1 to 1000, default 16.
   */
  vtkSetMacro(OutlierNeighbors, int);
  vtkGetMacro(OutlierNeighbors, int);
  ///@}

  ///@{
  /**
   * Standard deviations above the average from which a point is an outlier, >= 0, default 2.
   */
  vtkSetMacro(OutlierDeviation, double);
  vtkGetMacro(OutlierDeviation, double);
  ///@}

  ///@{
  /**
   * Let the surface enter hollows and holes whose mouth no point lies right behind. Default on.
   */
  vtkSetMacro(OpenPockets, bool);
  vtkGetMacro(OpenPockets, bool);
  vtkBooleanMacro(OpenPockets, bool);
  ///@}

  ///@{
  /**
   * Width of a mouth, in local distances between points, from which it leads into a pocket
   * whatever lies behind; a narrower one does only where what lies behind is not much wider.
   * No unit, 1 or more, default 6. Raise it where the surface breaks in through a gap of the
   * sampling.
   */
  vtkSetMacro(PocketFactor, double);
  vtkGetMacro(PocketFactor, double);
  ///@}

  ///@{
  /**
   * Close the surface over whatever the points miss (default): the surface of a solid. Off: holes
   * and the border of a sheet stay open, and the surface is an oriented manifold with boundary.
   */
  vtkSetMacro(CloseHoles, bool);
  vtkGetMacro(CloseHoles, bool);
  vtkBooleanMacro(CloseHoles, bool);
  ///@}

  ///@{
  /**
   * With CloseHoles off: diameter of the smallest empty disc that is a hole, in local mean
   * distances between points. No unit, 1 or more, default 5.
   */
  vtkSetMacro(HoleFactor, double);
  vtkGetMacro(HoleFactor, double);
  ///@}

  ///@{
  /**
   * Use the input's point normals, where it has any, to tell inside from outside; default on.
   * Without normals none are needed; with them cavities are found, and open sheets face their way.
   */
  vtkSetMacro(UseNormals, bool);
  vtkGetMacro(UseNormals, bool);
  vtkBooleanMacro(UseNormals, bool);
  ///@}

  ///@{
  /**
   * Radius in which points are moved onto a smooth surface first, against noise and the double
   * layers of overlapping scans: world units, >= 0; 0 (default) leaves all points in place. Points
   * nearer to each other than a quarter of it then count once, and vertices are no longer the
   * input's points bit for bit.
   */
  vtkSetMacro(SmoothingRadius, double);
  vtkGetMacro(SmoothingRadius, double);
  ///@}

  enum LevelOfDetails
  {
    ALL_POINTS = 0,
    TOLERANCE = 1,
    TARGET_VERTICES = 2,
    DETAIL_LEVEL = 3
  };

  ///@{
  /**
   * What decides how many points become vertices: ALL_POINTS (default) uses each, the others pick
   * points while they reconstruct, many where the surface bends and few where it is flat.
   */
  vtkSetMacro(LevelOfDetail, int);
  vtkGetMacro(LevelOfDetail, int);
  void SetLevelOfDetailToAllPoints() { this->SetLevelOfDetail(ALL_POINTS); }
  void SetLevelOfDetailToTolerance() { this->SetLevelOfDetail(TOLERANCE); }
  void SetLevelOfDetailToTargetVertices() { this->SetLevelOfDetail(TARGET_VERTICES); }
  void SetLevelOfDetailToDetailLevel() { this->SetLevelOfDetail(DETAIL_LEVEL); }
  ///@}

  ///@{
  /**
   * For TOLERANCE: greatest distance of an input point to the surface, world units, >= 0. 0
   * (default) stands for a thousandth of the longest side of the points' bounds. A warning tells of
   * points that stay farther off whatever is done.
   */
  vtkSetMacro(Tolerance, double);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * For TARGET_VERTICES: vertices of the surface, 4 or more, default 30000. All points are used
   * where there are no more.
   */
  vtkSetMacro(TargetVertices, int);
  vtkGetMacro(TargetVertices, int);
  ///@}

  ///@{
  /**
   * For DETAIL_LEVEL: share of the points that become vertices, 0.001 to 1, no unit, default 0.25.
   */
  vtkSetMacro(DetailLevel, double);
  vtkGetMacro(DetailLevel, double);
  ///@}

  ///@{
  /**
   * For all but ALL_POINTS: let the points in an axis-aligned box, from RefineOrigin to
   * RefineOrigin + RefineLengths in world coordinates, be no farther than RefineTolerance from the
   * surface (world units, >= 0; 0, the default: all points in the box are used). The vertices come
   * on top of those of the level. A negative length reaches to the other side. Default off.
   */
  vtkSetMacro(RefineRegion, bool);
  vtkGetMacro(RefineRegion, bool);
  vtkBooleanMacro(RefineRegion, bool);
  vtkSetVector3Macro(RefineOrigin, double);
  vtkGetVector3Macro(RefineOrigin, double);
  vtkSetVector3Macro(RefineLengths, double);
  vtkGetVector3Macro(RefineLengths, double);
  vtkSetMacro(RefineTolerance, double);
  vtkGetMacro(RefineTolerance, double);
  ///@}

  ///@{
  /**
   * For all but ALL_POINTS: keep what the surface was made from, about 250 bytes for each point and
   * 3 KB for each vertex, so that a change of the level of detail or of the region, and points that
   * are appended to the input, cost only what they change. Default on; off frees it.
   */
  vtkSetMacro(KeepState, bool);
  vtkGetMacro(KeepState, bool);
  vtkBooleanMacro(KeepState, bool);
  ///@}

  ///@{
  /**
   * Memory in MiB, above what the process has, and time in seconds that an update is expected to
   * take: after UpdateInformation() for all points that the input has by then, after an update for
   * those that were used; also told as the text of progress before its work begins. Time is that on
   * two cores of 2.6 GHz. Rounded up to 1 MiB and 0.1 s; 0 as long as no points are known.
   */
  vtkGetMacro(EstimatedMemory, double);
  vtkGetMacro(EstimatedTime, double);
  ///@}

protected:
  vtkHybridTreeReconstruction();
  ~vtkHybridTreeReconstruction() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  double Spacing = 0.0;
  bool RemoveOutliers = false;
  int OutlierNeighbors = 16;
  double OutlierDeviation = 2.0;
  bool OpenPockets = true;
  double PocketFactor = 6.0;
  bool CloseHoles = true;
  double HoleFactor = 5.0;
  bool UseNormals = true;
  double SmoothingRadius = 0.0;
  int LevelOfDetail = ALL_POINTS;
  double Tolerance = 0.0;
  int TargetVertices = 30000;
  double DetailLevel = 0.25;
  bool RefineRegion = false;
  double RefineOrigin[3] = { 0.0, 0.0, 0.0 };
  double RefineLengths[3] = { 1.0, 1.0, 1.0 };
  double RefineTolerance = 0.0;
  bool KeepState = true;
  double EstimatedMemory = 0.0;
  double EstimatedTime = 0.0;

private:
  vtkHybridTreeReconstruction(const vtkHybridTreeReconstruction&) = delete;
  void operator=(const vtkHybridTreeReconstruction&) = delete;

  void Reconstruct(vtkDataSet* input, vtkPolyData* output);
  void KeepEstimate(const hybridtree::WorkEstimate& estimate);
  void TellEstimate(std::size_t points);

  std::unique_ptr<hybridtree::KeptReconstruction> Kept;
};

#endif
