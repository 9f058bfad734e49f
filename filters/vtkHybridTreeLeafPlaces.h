// SPDX-License-Identifier: BSD-3-Clause
// Private: which place of which mesh leaf the parts of a made mesh take their values from.
#ifndef vtkHybridTreeLeafPlaces_h
#define vtkHybridTreeLeafPlaces_h

#include "core/nodes/Node.h"

#include <vector>

namespace hybridtree
{

/// Places on the mesh leaves of a tree, for all points and triangles of a mesh made of it.
struct LeafPlacesOfMesh
{
  std::vector<VertexOrigin> points;    ///< leaf -1: none
  std::vector<VertexOrigin> triangles; ///< of these only leaf and triangle count
};

/// What lies on a triangle of a leaf has its place there. What a blend has made anew has the
/// nearest one on the leaf whose field is largest there; none where no mesh leaf reaches, on faces
/// that are a primitive's alone, and on leaves below a deformation.
LeafPlacesOfMesh placesOnLeaves(const Node& tree, const TriangleMesh& mesh);

} // namespace hybridtree

#endif
