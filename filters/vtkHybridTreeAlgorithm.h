// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridTreeAlgorithm
 * @brief   base of all filters that are nodes of a HybridTree
 *
 * A node of the tree is one filter. Its output is the closed triangle mesh of the shape (points in
 * double precision), with
 * - point data Normals: unit, outward, from the gradient of the field; see PointNormals for when;
 * - cell data SourceId: index of the leaf a triangle comes from, in depth-first order of the tree,
 * -1 where leaves blend; and a field-data array SourceNames, the name of each leaf;
 * - the arrays of mesh inputs where their triangles survive: interpolated at vertices (real
 * numbers; of integers and text the nearest corner's), copied to triangles; NaN, 0 or empty
 * elsewhere. Arrays of one name from several meshes become one;
 * - the tree itself, as field data (vtkHybridTreeArray).
 *
 * An input is a node of the tree when it brings a tree along that belongs to it; every other
 * polydata is taken as a triangle mesh, a new leaf with a tenth of its diagonal as radius of
 * influence.
 *
 * A filter whose consumers all take trees is asked for no mesh (FORMULATION): its output has the
 * tree and no points then.
 *
 * Composite inputs are taken whole, not block by block. Each block is a shape of its own, and open
 * meshes among them are taken for patches of one. Where one node is wanted the shapes are united;
 * inputs that take any number of nodes get them all.
 *
 * Pieces: the first piece is everything, all other pieces are empty; inputs are asked for as one
 * piece on every process. An input of which every process has a part nevertheless is gathered.
 *
 * Subclasses are their parameters and MakeNode().
 */

#ifndef vtkHybridTreeAlgorithm_h
#define vtkHybridTreeAlgorithm_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkPolyDataAlgorithm.h"

#include <memory> // for std::shared_ptr
#include <string> // for warnings
#include <vector> // for Operands

class vtkInformationIntegerKey;
class vtkInformationIntegerRequestKey;

namespace hybridtree
{
class Error;
class Node;
class Progress;
struct TriangleMesh;
}

class HYBRIDTREEFILTERS_EXPORT vtkHybridTreeAlgorithm : public vtkPolyDataAlgorithm
{
public:
  vtkTypeMacro(vtkHybridTreeAlgorithm, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Target edge length of the output's triangles, world units; 0 (the default) means about 1/100 of
   * the diagonal of the shape's bounds. Does not change the shape.
   */
  virtual void SetEdgeLength(double length);
  vtkGetMacro(EdgeLength, double);
  ///@}

  enum PointNormalsType
  {
    NORMALS_AUTOMATIC = 0,
    NORMALS_ALWAYS = 1,
    NORMALS_NEVER = 2,
    NORMALS_SPLIT = 3
  };

  ///@{
  /**
   * Whether the output has point normals. Points are shared, so at a sharp edge one normal serves
   * both sides and smears the shading over the triangles there; without normals each triangle is
   * shaded as the plane that it is. NORMALS_AUTOMATIC (0, default): not where more than a quarter
   * of the area is in triangles with a corner whose normal is over 40 degrees off their own, as on
   * drilled plates with their large triangles; scans, blends and fine meshes have them.
   * NORMALS_ALWAYS (1), NORMALS_NEVER (2). NORMALS_SPLIT (3): points at edges sharper than 40
   * degrees are doubled in the output, so that each side is shaded by itself, as Splitting of
   * vtkPolyDataNormals does; the output is open there for filters that go by points. The tree it
   * brings along is not, so nodes fed with it see the closed shape. Does not change the shape.
   */
  virtual void SetPointNormals(int when);
  vtkGetMacro(PointNormals, int);
  ///@}

  enum FormulationType
  {
    MESH = 0,
    FIELD = 1
  };

  /**
   * What a consumer needs of a node: MESH, or FIELD when the tree will do. Asked while a request
   * travels upstream; a mesh already made satisfies a later FIELD.
   */
  static vtkInformationIntegerRequestKey* FORMULATION();

  /**
   * Set to 1 in the information of an input port that takes the tree of a node and has no use for
   * its mesh. Every input port of this class does unless a subclass says otherwise.
   */
  static vtkInformationIntegerKey* TAKES_TREE();

  ///@{
  /**
   * How often this filter has run, and how often it has asked its shape for a mesh. For tests and
   * profiles.
   */
  vtkGetMacro(NumberOfExecutions, int);
  vtkGetMacro(NumberOfMeshings, int);
  ///@}

#ifndef __VTK_WRAP__
  using MeshPtr = std::shared_ptr<const hybridtree::TriangleMesh>;
  using NodePtr = std::shared_ptr<const hybridtree::Node>;

  /**
   * The node this filter made in its last run; null before the first and after an error.
   */
  NodePtr GetTree() const;
#endif

protected:
  vtkHybridTreeAlgorithm();
  ~vtkHybridTreeAlgorithm() override;

#ifndef __VTK_WRAP__
  /// One node per input connection, by port.
  using Operands = std::vector<std::vector<NodePtr>>;

  /**
   * The node that the properties and operands describe. Called again only after a change of either;
   * what it throws becomes the error message.
   */
  virtual NodePtr MakeNode(const Operands& operands) = 0;

  /**
   * What an input port is called in messages: the name that ParaView's users know it by.
   */
  virtual const char* InputName(int port);

  /**
   * False for an input port that takes data which are no node, such as curves. Operands have none
   * of its connections; ReadOtherInputs() reads them.
   */
  virtual bool TakesNodes(int port);

  /**
   * Reads the ports that take no nodes. True when they hold something else than in the last run, so
   * that the node has to be made again.
   */
  virtual bool ReadOtherInputs();

  /**
   * The first connection of a port as one polydata, for ReadOtherInputs(): blocks of composite
   * data, and the parts that several processes have, are joined. Null without a connection, and
   * for other data. Lives as long as the run. \throws hybridtree::InvalidGeometry for a cell of
   * points that are not there.
   */
  vtkPolyData* GetWholeInput(int port);

  /**
   * What stands for the node in the first output: its mesh at EdgeLength, unless a subclass shows
   * something else.
   */
  virtual MeshPtr MakeMesh(const hybridtree::Node& node, const hybridtree::Progress& progress);

  /**
   * Fills the output ports from 1 on, once the node is there.
   */
  virtual void FillOtherOutputs(vtkInformationVector* outputs);
#endif

  /**
   * True when MakeNode() looks at EdgeLength. By default it does not, and a change of it keeps the
   * node with all that it has computed.
   */
  virtual bool NodeDependsOnEdgeLength()
  {
    return false;
  }

  /**
   * True when meshes that are read as such, from ports without TAKES_TREE, get their holes closed.
   */
  virtual bool ClosesHoles()
  {
    return false;
  }

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int ModifyRequest(vtkInformation* request, int when) override;

  double EdgeLength = 0.0;
  int PointNormals = NORMALS_AUTOMATIC;

private:
  vtkHybridTreeAlgorithm(const vtkHybridTreeAlgorithm&) = delete;
  void operator=(const vtkHybridTreeAlgorithm&) = delete;

#ifndef __VTK_WRAP__
  void CollectInputs(vtkInformationVector** inputs);
  void ForgetInputs();
  std::string CalledInput(std::size_t port, int number);
  [[noreturn]] void ComplainOfInput(std::size_t port, int number, const hybridtree::Error& error);
  void Run(vtkInformationVector* outputs);
  Operands ReadOperands(std::vector<std::string>& warnings, const hybridtree::Progress& progress);
  std::vector<NodePtr> ReadPort(
    std::size_t port, std::vector<std::string>& warnings, const hybridtree::Progress& progress);
  void UpdateNode(const hybridtree::Progress& progress);
  void ModifiedButTheNode();
  bool NeedsNormals(const hybridtree::TriangleMesh& mesh) const;
  void WriteOutput(vtkPolyData* output, bool withMesh, const hybridtree::Progress& progress);
  void Warn(const std::vector<std::string>& warnings);
  void WarnOfLostShape(const hybridtree::TriangleMesh& mesh);
  void WarnOfTinyOperands();
  static void Clear(vtkInformationVector* outputs);

  struct State;
  std::unique_ptr<State> Internals;
#endif
  int NumberOfExecutions = 0;
  int NumberOfMeshings = 0;
};

#endif
