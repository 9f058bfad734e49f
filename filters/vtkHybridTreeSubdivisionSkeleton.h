// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeSubdivisionSkeleton
 * @brief   implicit surface around subdivided curves and surfaces
 *
 * Lines and triangles of the input are a coarse skeleton graph ([SUB], Angelidis and Cani 2002):
 * segments that meet at a point of valence two make a curve, triangles that share an edge a
 * surface. Both are subdivided Level times, the radii with them, and dressed in a convolution
 * surface: where the skeleton is straight or flat and its radius the same all along, the surface is
 * at this radius.
 *
 * Larger polygons and strips become triangles, and points at exactly the same place one. Vertices
 * do not count.
 *
 * Output port 1 is the subdivided skeleton, with the point array Radius and the cell array
 * CoarseElement.
 */

#ifndef vtkHybridTreeSubdivisionSkeleton_h
#define vtkHybridTreeSubdivisionSkeleton_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeAlgorithm.h"

#include <string> // for RadiusArray

class vtkPolyData;

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeSubdivisionSkeleton : public vtkHybridTreeAlgorithm
{
public:
  static vtkHybridTreeSubdivisionSkeleton* New();
  vtkTypeMacro(vtkHybridTreeSubdivisionSkeleton, vtkHybridTreeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum SchemeType
  {
    APPROXIMATING = 0,
    INTERPOLATING = 1
  };

  enum RadiusInterpolationType
  {
    LINEAR = 0,
    CONSTANT = 1
  };

  enum BlendingType
  {
    EVERYTHING = 0,
    NEIGHBOURS = 1,
    PAPER = 2
  };

  enum KernelType
  {
    POLYNOMIAL = 0,
    CAUCHY = 1
  };

  ///@{
  /**
   * Name of the point array with the radius of the surface, world units, > 0. "Automatic"
   * (default): Radius, where there is an array of this name, else the property Radius everywhere.
   * "None" or empty: the property Radius. Any other name that is not there is an error.
   */
  vtkSetStdStringFromCharMacro(RadiusArray);
  vtkGetCharFromStdStringMacro(RadiusArray);
  ///@}

  ///@{
  /**
   * Radius of the surface where there is no RadiusArray, world units, >= 0. 0 (default): 0.03 of the
   * longest side of the input's bounds.
   */
  vtkSetMacro(Radius, double);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /**
   * LINEAR (0, default): the radius changes steadily along lines and triangles. CONSTANT (1): each
   * line and triangle of the subdivided skeleton has the mean of its corners, as in [SUB] 3.3.
   */
  vtkSetMacro(RadiusInterpolation, int);
  vtkGetMacro(RadiusInterpolation, int);
  ///@}

  ///@{
  /**
   * APPROXIMATING (0, default): Loop's scheme, curves and borders as cubic B-splines.
   * INTERPOLATING (1): through the coarse points, by modified butterfly and four-point schemes.
   */
  vtkSetMacro(Scheme, int);
  vtkGetMacro(Scheme, int);
  ///@}

  ///@{
  /**
   * How often the skeleton is subdivided, 0 to 6, default 2.
   */
  vtkSetMacro(Level, int);
  vtkGetMacro(Level, int);
  ///@}

  ///@{
  /**
   * What blends: EVERYTHING (0, default) that is near in space; NEIGHBOURS (1), only parts that are
   * near each other along the skeleton, which takes up to about twice as long; or PAPER (2),
   * elements that touch, the less the farther along, as [SUB] 5 has it, for comparison. What does
   * not blend is united.
   */
  vtkSetMacro(Blending, int);
  vtkGetMacro(Blending, int);
  ///@}

  ///@{
  /**
   * How far along the skeleton neighbours blend in full, in reaches of the field, 0.5 to 100,
   * default 2.25; from there it fades over one reach. Used when Blending is NEIGHBOURS.
   */
  vtkSetMacro(BlendDistance, double);
  vtkGetMacro(BlendDistance, double);
  ///@}

  ///@{
  /**
   * POLYNOMIAL (0, default): a kernel that ends InfluenceRatio radii from the skeleton. CAUCHY (1):
   * one that fades slowly, as [SUB] has it.
   */
  vtkSetMacro(Kernel, int);
  vtkGetMacro(Kernel, int);
  ///@}

  ///@{
  /**
   * How far the field reaches, in radii of the surface, 1.05 to 100, default 2.
   */
  vtkSetMacro(InfluenceRatio, double);
  vtkGetMacro(InfluenceRatio, double);
  ///@}

  ///@{
  /**
   * Exponent of the polynomial kernel, 2 to 8, default 2. A larger one blends tighter.
   */
  vtkSetMacro(Exponent, int);
  vtkGetMacro(Exponent, int);
  ///@}

  ///@{
  /**
   * Carve instead of add: the field is negative. Default off.
   */
  vtkSetMacro(Negative, bool);
  vtkGetMacro(Negative, bool);
  vtkBooleanMacro(Negative, bool);
  ///@}

  ///@{
  /**
   * Level of detail of the mesh, independent of Level: edges are split where the field at their
   * middle differs from that of the surface by more than this share, above 0 up to 1, default 0.1.
   */
  vtkSetMacro(Refinement, double);
  vtkGetMacro(Refinement, double);
  ///@}

  ///@{
  /**
   * Give the meshes around the pieces of the skeleton as they are, overlapping where pieces meet:
   * at once, and closed each, but not one 2-manifold. The tree is the same. Default off.
   */
  vtkSetMacro(Preview, bool);
  vtkGetMacro(Preview, bool);
  vtkBooleanMacro(Preview, bool);
  ///@}

protected:
  vtkHybridTreeSubdivisionSkeleton();
  ~vtkHybridTreeSubdivisionSkeleton() override;

#ifndef __VTK_WRAP__
  NodePtr MakeNode(const Operands& operands) override;
  bool TakesNodes(int port) override;
  bool ReadOtherInputs() override;
  MeshPtr MakeMesh(const hybridtree::Node& node, const hybridtree::Progress& progress) override;
  void FillOtherOutputs(vtkInformationVector* outputs) override;
#endif

  int FillInputPortInformation(int port, vtkInformation* info) override;

  std::string RadiusArray = "Automatic";
  double Radius = 0.0;
  int RadiusInterpolation = LINEAR;
  int Scheme = APPROXIMATING;
  int Level = 2;
  int Blending = EVERYTHING;
  double BlendDistance = 2.25;
  int Kernel = POLYNOMIAL;
  double InfluenceRatio = 2.0;
  int Exponent = 2;
  bool Negative = false;
  double Refinement = 0.1;
  bool Preview = false;

private:
  vtkPolyData* Input = nullptr; ///< only during a run
  vtkMTimeType InputTime = 0;

  vtkHybridTreeSubdivisionSkeleton(const vtkHybridTreeSubdivisionSkeleton&) = delete;
  void operator=(const vtkHybridTreeSubdivisionSkeleton&) = delete;
};

#endif
