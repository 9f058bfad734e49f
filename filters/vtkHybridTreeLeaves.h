// SPDX-License-Identifier: BSD-3-Clause
// Private: mesh leaves, and the arrays of the meshes they were made from, as they ride along in
// field data. There is no second, live way for them: whatever reaches an operator, straight or
// through a file, reaches it as field-data arrays named by the content hash of the leaf's mesh.
#ifndef vtkHybridTreeLeaves_h
#define vtkHybridTreeLeaves_h

#include "core/nodes/Node.h"
#include "core/nodes/NodeMaker.h"
#include "vtkHybridTreeConvert.h"

#include <map>
#include <string>
#include <vector>

class vtkAbstractArray;
class vtkFieldData;

namespace hybridtree
{

/// A leaf of a tree, in the depth-first order that SourceId counts in.
struct Leaf
{
  std::string name; ///< kind and index: "Point 0", "Mesh 3"
  MeshPtr mesh;     ///< of a mesh leaf; null for all other leaves
  std::string hash; ///< of the mesh
};
std::vector<Leaf> leavesOf(const Node& tree);

/// Arrays of mesh leaves by the name they ride under.
using LeafArrays = std::map<std::string, vtkSmartPointer<vtkAbstractArray>>;

/// The arrays of an input as arrays over the points and triangles of the leaf it became. Left
/// behind are ghost marks, global ids, what every output of ours has of its own: normals, SourceId;
/// and, with a warning, arrays that have too few values.
LeafArrays arraysOf(
  vtkPolyData* input, const ConvertedMesh& leaf, std::vector<std::string>& warnings);

/// The leaf arrays that ride in `data`.
LeafArrays arraysIn(vtkFieldData* data);

/// Adds arrays to others. Where there is one of the name already it stays; the return value names
/// those that differ from the one that stayed.
std::vector<std::string> mergeArrays(const LeafArrays& from, LeafArrays& to);

/// Takes everything of ours out of `data`.
void removeLeaves(vtkFieldData* data);

/// Puts the names of the leaves into `data`, as SourceNames.
void putNames(const std::vector<Leaf>& leaves, vtkFieldData* data);

/// Puts the meshes of the mesh leaves of `tree` into `data`, shared.
void putMeshes(const Node& tree, vtkFieldData* data);

/// Puts those arrays into `data` that belong to leaves of `tree`.
void putArrays(const LeafArrays& arrays, const std::vector<Leaf>& leaves, vtkFieldData* data);

/// The tree that a polydata brings along.
struct CarriedTree
{
  bool belongs = false; ///< there is one, and it was put on this very geometry
  NodePtr live;         ///< null when it has to be parsed
  std::string text;
};
CarriedTree carriedTree(vtkPolyData* mesh);

/// fingerprint() as 16 hexadecimal digits.
std::string fingerprintText(vtkPolyData* mesh);

/// Finds the meshes that putMeshes() has put there. It throws InvalidText for a damaged one.
MeshLookup meshesIn(vtkFieldData* data);

/// Gives the output its leaves' point and cell arrays, at the places that placesOnLeaves() gives
/// its vertices and triangles: interpolated within the leaf's triangle (real numbers) or taken from
/// its nearest corner (integers and text); copied for cells. NaN, 0 or "" elsewhere. Arrays of one
/// name from several leaves become one array, of the type of the first; the return value names
/// those that could not. Active scalars, vectors, texture coordinates and tensors are those of the
/// first leaf that has some, scalars only where all of the output has a value.
std::vector<std::string> passArrays(const LeafArrays& arrays, const Node& tree,
  const std::vector<Leaf>& leaves, const TriangleMesh& mesh, vtkPolyData* output);

} // namespace hybridtree

#endif
