// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeSkeletonEditor
 * @brief   source of a coarse skeleton graph, for vtkHybridTreeSubdivisionSkeleton
 *
 * Points with radii, joined by segments and triangles ([SUB] 6): a graph of branching curves and
 * pieces of surface. Without any segment and triangle the points make one curve, in their order.
 *
 * By default a curve that ends in a leaf of two triangles.
 *
 * Output port 0 is the coarse graph, as vtkHybridTreeSubdivisionSkeleton takes it: lines, triangles
 * and the point array Radius. Output port 1 is what subdivision makes of it at Level, with the cell
 * array CoarseElement: the segment or, from the number of segments on, the triangle a cell comes
 * from.
 *
 * Pieces: the first piece is everything, all other pieces are empty.
 */

#ifndef vtkHybridTreeSkeletonEditor_h
#define vtkHybridTreeSkeletonEditor_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkPolyDataAlgorithm.h"

#include <array>  // for lists
#include <vector> // for lists

namespace hybridtree
{
struct SkeletonGraph;
}

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeSkeletonEditor : public vtkPolyDataAlgorithm
{
public:
  static vtkHybridTreeSkeletonEditor* New();
  vtkTypeMacro(vtkHybridTreeSkeletonEditor, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The points of the graph, world units. Points that are added are at the origin until they are
   * set; to set one that does not exist is an error.
   */
  void SetNumberOfPoints(int count);
  int GetNumberOfPoints() const;
  void SetPoint(int index, double x, double y, double z);
  ///@}

  ///@{
  /**
   * Radius of the surface at each point, world units, > 0. Where there are fewer radii than points,
   * the last one counts for the rest, so that points can be added in a view.
   */
  void SetNumberOfRadii(int count);
  int GetNumberOfRadii() const;
  void SetRadius(int index, double radius);
  ///@}

  ///@{
  /**
   * The curves: pairs of point numbers, from 0.
   */
  void SetNumberOfSegments(int count);
  int GetNumberOfSegments() const;
  void SetSegment(int index, int point0, int point1);
  ///@}

  ///@{
  /**
   * The pieces of surface: triples of point numbers, from 0.
   */
  void SetNumberOfTriangles(int count);
  int GetNumberOfTriangles() const;
  void SetTriangle(int index, int point0, int point1, int point2);
  ///@}

  ///@{
  /**
   * Scheme and Level of the second output; see vtkHybridTreeSubdivisionSkeleton. Default:
   * approximating, 2.
   */
  vtkSetMacro(Scheme, int);
  vtkGetMacro(Scheme, int);
  vtkSetMacro(Level, int);
  vtkGetMacro(Level, int);
  ///@}

protected:
  vtkHybridTreeSkeletonEditor();
  ~vtkHybridTreeSkeletonEditor() override;

  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  int Scheme = 0;
  int Level = 2;

private:
  vtkHybridTreeSkeletonEditor(const vtkHybridTreeSkeletonEditor&) = delete;
  void operator=(const vtkHybridTreeSkeletonEditor&) = delete;

#ifndef __VTK_WRAP__
  hybridtree::SkeletonGraph MakeGraph() const;
  template <typename List>
  void Resize(List& list, int count, const typename List::value_type& filler);
  template <typename List>
  void Set(const char* name, List& list, int index, const typename List::value_type& element);

  std::vector<std::array<double, 3>> Points;
  std::vector<std::array<double, 1>> Radii;
  std::vector<std::array<int, 2>> Segments;
  std::vector<std::array<int, 3>> Triangles;
#endif
};

#endif
