// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeFreeFormDeformation
 * @brief   deforms a node by the control points of a lattice
 *
 * A Bernstein lattice of any size ([HT] 4.5.2): moving its control points moves what is inside
 * the lattice box; outside nothing changes, so displaced control points on the faces of the box
 * tear a shape that reaches through them. Port 1 is the deformed lattice as points and lines,
 * for display.
 *
 * With FieldFrom DEFORMED_MESH, EdgeLength is the edge length of the mesh that is deformed, and
 * so part of the shape.
 */

#ifndef vtkHybridTreeFreeFormDeformation_h
#define vtkHybridTreeFreeFormDeformation_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeAlgorithm.h"

#include <array>  // for Displacements
#include <vector> // for Displacements

namespace hybridtree
{
struct ControlLattice;
struct FreeFormLattice;
}

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeFreeFormDeformation : public vtkHybridTreeAlgorithm
{
public:
  static vtkHybridTreeFreeFormDeformation* New();
  vtkTypeMacro(vtkHybridTreeFreeFormDeformation, vtkHybridTreeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum FieldFromType
  {
    DEFORMED_MESH = 0,
    INVERSE_MAP = 1
  };

  ///@{
  /**
   * Number of control points along each edge of the lattice, each 2 or more, at most 64.
   * Default (3, 3, 3).
   */
  vtkSetVector3Macro(LatticeDimensions, int);
  vtkGetVector3Macro(LatticeDimensions, int);
  ///@}

  ///@{
  /**
   * On (default): the lattice box is the bounds of the input's surface and a little more, and
   * LatticeOrigin and LatticeAxes are not used.
   */
  vtkSetMacro(FitLattice, bool);
  vtkGetMacro(FitLattice, bool);
  vtkBooleanMacro(FitLattice, bool);
  ///@}

  ///@{
  /**
   * Corner of the lattice box where control point (0, 0, 0) is at rest, world units. Default
   * (0, 0, 0). Used when FitLattice is off.
   */
  vtkSetVector3Macro(LatticeOrigin, double);
  vtkGetVector3Macro(LatticeOrigin, double);
  ///@}

  ///@{
  /**
   * The three full edges of the lattice box from LatticeOrigin, one after the other, world
   * units. They must span space. Default the unit vectors. Used when FitLattice is off.
   */
  vtkSetVectorMacro(LatticeAxes, double, 9);
  vtkGetVectorMacro(LatticeAxes, double, 9);
  ///@}

  ///@{
  /**
   * Where the field of the result comes from: DEFORMED_MESH (0, default), the distance to the
   * deformed mesh ([HT] 4.5.2), or INVERSE_MAP (1), the field of the input at the point that
   * the lattice moved here, which is exact but exists only where the lattice does not fold.
   */
  vtkSetMacro(FieldFrom, int);
  vtkGetMacro(FieldFrom, int);
  ///@}

  ///@{
  /**
   * Displacements of control points: row after row the indices i, j, k of a control point, whole
   * numbers from 0 to LatticeDimensions - 1, and its displacement dx, dy, dz in world units. Rows
   * for the same control point add up. No rows by default; one that SetNumberOfDisplacements has
   * made must be set.
   */
  void SetNumberOfDisplacements(int count);
  int GetNumberOfDisplacements() const;
  void SetDisplacement(int row, double i, double j, double k, double dx, double dy, double dz);
  void AddDisplacement(double i, double j, double k, double dx, double dy, double dz);
  void ClearDisplacements();
  ///@}

protected:
  vtkHybridTreeFreeFormDeformation();
  ~vtkHybridTreeFreeFormDeformation() override;

#ifndef __VTK_WRAP__
  NodePtr MakeNode(const Operands& operands) override;
  void FillOtherOutputs(vtkInformationVector* outputs) override;
#endif

  bool NodeDependsOnEdgeLength() override
  {
    return this->FieldFrom == DEFORMED_MESH;
  }

  int LatticeDimensions[3] = { 3, 3, 3 };
  bool FitLattice = true;
  double LatticeOrigin[3] = { 0.0, 0.0, 0.0 };
  double LatticeAxes[9] = { 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0 };
  int FieldFrom = DEFORMED_MESH;

private:
#ifndef __VTK_WRAP__
  hybridtree::FreeFormLattice GetLattice(const hybridtree::Node& input) const;
  void MoveControlPoints(hybridtree::FreeFormLattice& lattice) const;

  using Displacement = std::array<double, 6>;
  std::vector<Displacement> Displacements;
  std::unique_ptr<hybridtree::ControlLattice> Drawing; ///< of the lattice of the last node
#endif

  vtkHybridTreeFreeFormDeformation(const vtkHybridTreeFreeFormDeformation&) = delete;
  void operator=(const vtkHybridTreeFreeFormDeformation&) = delete;
};

#endif
