// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Parameters.h"
#include "core/base/Progress.h"
#include "core/mesh/TriangleMesh.h"
#include "core/polygonize/FieldSource.h"

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hybridtree
{

/// How the field of one leaf falls off around its surface: the potential over the distance to that
/// surface, as MeshField takes it.
struct SurfaceField
{
  double maximumField;    ///< I, |I| >= T
  double influenceRadius; ///< distance outside of the surface where the field ends
  int exponent;           ///< n
};

class Deformation;
class Node;
using NodePtr = std::shared_ptr<const Node>;

/// A node of the HybridTree ([HT] 3): one shape, answered as field, gradient, membership and mesh.
///
/// Immutable and shared: an edit makes new nodes on the path to the root and keeps the rest, with
/// all that those have already computed. Any number of threads may ask one node.
class Node
  : public FieldSource
  , public std::enable_shared_from_this<Node>
{
public:
  Node() = default;
  ~Node() override;
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  /// Classification of p_k ([HT] 4): 1 inside, 0 on the surface (within rounding), -1 outside.
  /// Answered by what is cheapest for the kind of node, not always by the field.
  virtual void membership(PointBatch points, std::int8_t* side) const = 0;

  /// Euclidean distance to the surface, negative inside, where the node knows it exactly; NaN where
  /// it does not (the default).
  virtual void signedDistance(PointBatch points, double* distance) const;

  /// Which leaf alone makes the field at p_k: its index in the depth-first order of this tree
  /// (0 .. leafCount() - 1), or -1 where several or none do.
  virtual void sourceLeaf(PointBatch points, std::int32_t* leaf) const = 0;
  virtual int leafCount() const { return 1; }

  /// Nodes above each other, this one included.
  virtual int depth() const { return 1; }

  /// Makes what the field needs and takes long, such as the mesh of a deformed shape below a blend.
  /// Otherwise the first query does so, deaf to its caller. mesh() begins with it.
  /// \throws as mesh().
  virtual void prepare(const Progress& progress) const { static_cast<void>(progress); }

  /// Closure of where the field is not 0. Empty for an empty shape.
  virtual Box3 influenceBounds() const = 0;

  /// A box around the surface: conservative, tight where cheap.
  virtual Box3 surfaceBounds() const = 0;

  /// True when every leaf below has I < 0: a negative shape has no surface of its own ([HT] 4.3).
  virtual bool isNegative() const = 0;

  /// Closed, consistently oriented 2-manifold of the surface, with normals; empty when there is no
  /// surface. Kept: the second call with the same length gives the same object.
  /// \param edgeLength target length, world units; 0 means defaultEdgeLength().
  /// \throws InvalidParameter, InvalidGeometry, TooLarge, Cancelled.
  MeshPtr mesh(double edgeLength = 0.0, const Progress& progress = Progress::none()) const;

  /// A mesh of the same surface for a map: as mesh(), or another one where that one and the work of
  /// deforming it cost less together. Kept as well. The same whatever was asked before.
  MeshPtr meshToDeform(
    double edgeLength, const Deformation& by, const Progress& progress = Progress::none()) const;

  /// The same, null where it is that of mesh(): nothing is made then.
  MeshPtr otherMeshToDeform(
    double edgeLength, const Deformation& by, const Progress& progress = Progress::none()) const;

  /// About diagonal of surfaceBounds() / 100: the nearest power of 2^(1/8).
  double defaultEdgeLength() const;

  /// This shape under an affine map, pushed down to the leaves ([HT] 4.5.3). Exact: the field of
  /// the image at map * p is this field at p, for similarities and for all other invertible maps.
  /// \throws InvalidParameter for a map that is not finite or not invertible.
  NodePtr affine(const Affine3& map) const;

  /// This tree as it has to be below a blend: Booleans of automatic form take their smooth form
  /// ([HT] 4.4). The same object where nothing changes.
  virtual NodePtr underBlend() const { return this->shared_from_this(); }

  /// Name in the serialised tree, everything but the children needed to make the node again, and
  /// the children in order.
  virtual const char* kind() const = 0;
  virtual Parameters parameters() const = 0;
  virtual std::vector<NodePtr> children() const { return {}; }

  /// The mesh a mesh leaf is made of, which parameters() names by its content hash as "mesh"; null
  /// for every other kind.
  virtual MeshPtr leafMesh() const { return nullptr; }

  /// True when a triangle mesh shapes the field somewhere, so that its gradient jumps from facet to
  /// facet.
  virtual bool isFaceted() const { return false; }

  /// For single leaves with a level of +-T, in the mean over directions where a map has stretched
  /// them: what keeps their field when only their mesh is left ([HT] 4.5.2). Empty for every other
  /// kind.
  virtual std::optional<SurfaceField> surfaceField() const { return std::nullopt; }

  /// What a value of the field costs near the surface, in microseconds of one processor, as far as
  /// the kind of node tells: to choose between ways to mesh (fieldCost()). Only ratios matter;
  /// measured on bricks of a lattice (docs/figures.md). The same for the same node. \param below
  /// what a value of the fields of its children costs, together; 0 for leaves. \param edgeLength of
  /// the lattice: the triangles of a mesh are the closer together for it the
  ///   longer it is.
  virtual double sampleCost(double below, double edgeLength) const = 0;

  /// What the user should know about this node itself: repairs made to its input, folds, open
  /// meshes.
  virtual std::vector<std::string> warnings() const { return {}; }

protected:
  virtual TriangleMesh makeMesh(double edgeLength, const Progress& progress) const = 0;

  /// As otherMeshToDeform(), with what the field needs prepared. By default mesh() will do.
  virtual MeshPtr findOtherMesh(
    double edgeLength, const Deformation& by, const Progress& progress) const;

  /// A mesh that is kept besides those of mesh(), by edge length and by the mesh that it is made
  /// from, null for none. Where `make` makes none it is asked again the next time.
  MeshPtr keptOtherMesh(double edgeLength, const MeshPtr& from,
    const std::function<std::optional<TriangleMesh>()>& make) const;

  /// \pre map is finite and invertible.
  virtual NodePtr makeAffine(const Affine3& map) const = 0;

private:
  struct Meshes;

  // Made with the first mesh: of the hundreds of leaves of a tree few are ever meshed.
  Meshes& meshes() const;

  mutable std::atomic<Meshes*> meshes_{ nullptr };
};

} // namespace hybridtree
