// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/Blend.h"
#include "core/nodes/BlendCost.h"
#include "core/nodes/Deformation.h"
#include "core/nodes/DeformedBlendCost.h"
#include "core/nodes/MarkedCells.h"
#include "core/stitch/Stitch.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace hybridtree
{

/// A node whose mesh may be kept in that of a blend.
struct BlendPart
{
  const Node* node = nullptr;
  std::int32_t firstLeaf = 0; ///< of the node, among those of the blend
  std::int32_t count = 1;     ///< how often its field counts; more than once, and it has no mesh
};

/// How a mesh came to be.
struct BlendMeshReport
{
  BlendMethod method = BlendMethod::Global; ///< Global where everything was polygonized
  std::size_t markedCells = 0;              ///< those polygonized; 0 where all of the lattice was
  std::size_t borderCells = 0;              ///< of these, those beside one that is not marked
  std::size_t samplePoints = 0;             ///< new points on the surface
  std::size_t keptTriangles = 0;            ///< of the parts, as they are
  std::size_t cutTriangles = 0;
  std::size_t newTriangles = 0;
  std::size_t islands = 0;           ///< parts of the new surface that do not touch
  std::size_t rememberedIslands = 0; ///< of these, those taken from an earlier mesh
  int rounds = 0;      ///< of marking, cutting and polygonizing; more than 1 after a repair
  std::string warning; ///< what the user should know; empty if all went well
};

/// Warnings of meshing, each once, for Node::warnings(). Thread-safe.
class MeshWarnings
{
public:
  void add(const std::string& warning) const;
  std::vector<std::string> all() const;

private:
  mutable std::mutex mutex_;
  mutable std::vector<std::string> warnings_;
};

/// Mesh of a global blend ([HT] 5.2.1, 5.2.2): the parts' own meshes where nothing blends, the
/// lattice where something does.
///
/// A part with an overlap ratio above options.overlapThreshold gives up its mesh: all it reaches is
/// polygonized. The ratio is the share of its influence box that lies in those of the others. For
/// two parts these are the three cases of [HT]; for more, its primitive-based ratios. A part that
/// gives up its mesh is never meshed, so that blends below one another which overlap strongly are
/// polygonized in one go: the clusters of [HT].
///
/// Departs from [HT] in what it marks: not boxes but the cells where the fields are not 0
/// (MarkedCells.h), and in how it joins: exact cuts instead of filled gaps (Stitch.h).
///
/// What was made for earlier blends of the same parts is taken over where nothing else reaches, so
/// that an edit costs what it changes. The mesh is the same, bit for bit, as without.
///
/// \param parts whose fields add up to that of the blend: its children (node-based) or, through
/// nested blends, all that is blended (primitive-based). \param method told in the report.
TriangleMesh blendMesh(const Node& blend, std::vector<BlendPart> parts, const BlendOptions& options,
  double edgeLength, BlendMeshReport& report, const Progress& progress = Progress::none());

/// What a local blend is made of.
struct LocalBlendParts
{
  const Node* a;
  const Node* b;
  const Node* region;
  const Node* unionOfBoth; ///< of A and B, which stands outside of the region
};

/// As blendMesh(), of a local blend ([HT] 5.2.3).
TriangleMesh localBlendMesh(const Node& blend, const LocalBlendParts& parts,
  const BlendOptions& options, double edgeLength, BlendMeshReport& report,
  const Progress& progress = Progress::none());

/// What is kept of the parts of a blend, and where it is made anew.
struct BlendPatch
{
  std::vector<KeptPart> kept;
  CellSet cells;
};

/// blendMesh() and localBlendMesh() in steps, for a mesh that a map deforms.
class BlendMesher
{
public:
  ///@{ \pre parts and what they point to outlive this.
  BlendMesher(const Node& blend, std::vector<BlendPart> parts, const BlendOptions& options,
    double edgeLength);
  BlendMesher(const Node& blend, const LocalBlendParts& parts, const BlendOptions& options,
    double edgeLength);
  ///@}
  ~BlendMesher();
  BlendMesher(const BlendMesher&) = delete;
  BlendMesher& operator=(const BlendMesher&) = delete;

  TriangleMesh mesh(BlendMeshReport& report, const Progress& progress) const;

  /// Where the automatic method makes mesh() over the lattice, but keeping the parts' meshes and
  /// deforming the result would cost less than deforming that of the lattice, most of which has
  /// thin triangles that a map must mend. Nothing elsewhere, where mesh() will do.
  std::optional<BlendPatch> patchToDeform(const Deformation& by, const Progress& progress) const;

  /// Nothing where it could not be joined.
  std::optional<TriangleMesh> meshOver(
    BlendPatch patch, BlendMeshReport& report, const Progress& progress) const;

private:
  /// Skeletons are sampled whole in no time: there the choice comes before anything is meshed.
  bool choosesFirst() const { return method_ == BlendMethod::Automatic && !blend_.isFaceted(); }
  BlendCost cost() const;
  DeformedBlendCost costToDeform(const SurfaceStretch& stretch) const;
  std::optional<TriangleMesh> stitchOver(const std::vector<KeptPart>& kept, CellSet cells,
    BlendMeshReport& report, const Progress& progress) const;

  const Node& blend_;
  const std::vector<BlendPart> parts_;
  const std::vector<MarkTerm> terms_;
  const std::vector<MarkTerm> shapes_; ///< of these, those that make the surface
  const std::unique_ptr<const Interaction> interaction_;
  const std::unique_ptr<const IslandField> field_;
  const BlendMethod method_;
  const CellGrid grid_;
};

/// Keeps what is made, or takes what was made before.
using KeepMesh = std::function<MeshPtr(const std::function<std::optional<TriangleMesh>()>& make)>;

/// Node::otherMeshToDeform() of a blend.
MeshPtr blendMeshToDeform(const BlendMesher& mesher, const Deformation& by,
  const MeshWarnings& warnings, const KeepMesh& keep, const Progress& progress);

/// Forgets what was made for earlier blends; for tests and benchmarks.
void forgetBlends();

} // namespace hybridtree
