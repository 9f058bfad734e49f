// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/BlendMesh.h"

#include "core/base/Dependency.h"
#include "core/geometry/BoxUnion.h"
#include "core/nodes/BlendChoice.h"
#include "core/nodes/BlendEstimate.h"
#include "core/nodes/BlendInteraction.h"
#include "core/nodes/BlendSource.h"
#include "core/nodes/LatticeMesh.h"
#include "core/nodes/NearDependencies.h"
#include "core/nodes/TriangleSources.h"
#include "core/stitch/KeptMesh.h"
#include "core/stitch/Stitch.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace hybridtree
{
namespace
{

constexpr std::size_t kMaxBytes = std::size_t(8) << 30;
constexpr double kSlightGrowth = 0.1; // of a surface: few triangles are split then

/// The cells that are the same for all methods: what is too thin for them is so for each.
CellGrid gridOf(const Node& blend, double edgeLength)
{
  return CellGrid::ofLevel(edgeLength, blend.depth());
}

TriangleMesh wholeLattice(
  const Node& blend, const CellGrid& grid, BlendMeshReport& report, const Progress& progress)
{
  TriangleMesh mesh = latticeMesh(blend, grid, progress);
  report.method = BlendMethod::Global;
  report.samplePoints = mesh.points.size();
  report.newTriangles = mesh.triangles.size();
  return mesh;
}

/// The mesh of a node at one edge length.
struct MeshOfNode
{
  Dependency node;

  bool operator==(const MeshOfNode& other) const { return node == other.node; }
  bool isExpired() const { return node.isExpired(); }
  std::uint64_t hash() const
  {
    HashSum sum;
    node.addTo(sum);
    return sum.value();
  }
};

/// Meshes that came out of stitch(): checked where they are new, and taken from sound ones
/// elsewhere, they need no second look.
RecentStore<MeshOfNode, bool>& stitchedMeshes()
{
  constexpr std::size_t kMostBytes = std::size_t(1) << 20;
  static auto* const instance =
    new RecentStore<MeshOfNode, bool>(kMostBytes); // outlives all statics
  return *instance;
}

bool isStitched(const Node& node, double edgeLength)
{
  return stitchedMeshes().find({ { node.shared_from_this(), edgeLength, 0 } }) != nullptr;
}

void noteStitched(const Node& node, double edgeLength)
{
  stitchedMeshes().keep({ { node.shared_from_this(), edgeLength, 0 } },
    std::make_shared<const bool>(true), sizeof(MeshOfNode));
}

/// The meshes of the parts that keep theirs; takes the right from those whose mesh is not sound.
std::vector<KeptPart> keptMeshes(const std::vector<BlendPart>& parts, std::vector<MarkTerm>& terms,
  double edgeLength, BlendMeshReport& report, const Progress& progress)
{
  std::vector<KeptPart> kept;
  for (std::size_t k = 0; k < parts.size(); ++k)
  {
    if (!terms[k].kept)
    {
      continue;
    }
    const Node& node = *parts[k].node;
    const double count = static_cast<double>(parts.size());
    KeptPart part;
    part.mesh =
      node.mesh(edgeLength, ProgressPart(progress, double(k) / count, double(k + 1) / count));
    part.firstLeaf = parts[k].firstLeaf;
    const MeshPtr leaf = node.leafMesh();
    part.isLeaf = leaf && leaf->triangles.size() == part.mesh->triangles.size();
    if (part.mesh->empty())
    {
      continue;
    }
    terms[k].kept = isStitched(node, edgeLength) || KeptMesh::of(part.mesh)->isSound();
    if (terms[k].kept)
    {
      kept.push_back(std::move(part));
    }
    else
    {
      report.warning =
        "An operand of the blend is not a closed surface, so its triangles cannot be "
        "kept: all that it reaches was polygonized anew, which is coarser and takes "
        "longer. Close its holes first, or reconstruct its points.";
    }
  }
  return kept;
}

/// Whether some mesh that is kept has more triangles than a lattice would make of its surface,
/// about three for each squared cell: the lattice would lose detail of it, and is no choice for
/// being cheaper.
bool isFinerThanLattice(
  const std::vector<BlendPart>& parts, const std::vector<MarkTerm>& terms, double edgeLength)
{
  constexpr double kPerSquare = 3.0;
  for (std::size_t k = 0; k < parts.size(); ++k)
  {
    if (terms[k].kept && parts[k].node->isFaceted())
    {
      const MeshPtr mesh = parts[k].node->mesh(edgeLength);
      const double squares = squaresOf({ { mesh } }, edgeLength);
      if (static_cast<double>(mesh->triangles.size()) > kPerSquare * squares)
      {
        return true;
      }
    }
  }
  return false;
}

std::vector<Box3> influenceBoxes(const std::vector<BlendPart>& parts)
{
  std::vector<Box3> boxes;
  for (const BlendPart& part : parts)
  {
    boxes.push_back(part.node->influenceBounds());
  }
  return boxes;
}

/// The field of a blend for the islands of marked cells.
class BlendField : public IslandField
{
public:
  explicit BlendField(const Node& blend) : blend_(blend) {}

  void findSources(TriangleMesh& island, const Progress& progress) const override
  {
    findSourceLeaves(blend_, island, 0, progress);
  }

protected:
  const Node& blend_;
};

/// Of a sum: of those parts that reach an island, in their order, so that the others do not even
/// change the rounding.
class SumIslandField final : public BlendField
{
public:
  SumIslandField(const Node& blend, const std::vector<BlendPart>& parts)
    : BlendField(blend), parts_(parts), boxes_(influenceBoxes(parts))
  {
  }

  Near near(const std::vector<Box3>& boxes) const override
  {
    NearDependencies near(boxes, NearDependencies::Leaves::Numbered);
    std::vector<BlendSource::Term> terms;
    for (std::size_t k = 0; k < parts_.size(); ++k)
    {
      const BlendPart& part = parts_[k];
      if (near.reaches(boxes_[k]))
      {
        terms.push_back({ FieldSourcePtr(FieldSourcePtr(), part.node), part.count });
        near.add(*part.node, part.firstLeaf, static_cast<double>(part.count));
      }
    }
    return { std::make_shared<BlendSource>(std::move(terms)), near.take(), near.isFaceted() };
  }

private:
  const std::vector<BlendPart>& parts_;
  const std::vector<Box3> boxes_;
};

/// Of a local blend: what does not reach an island is 0 there and changes nothing.
class LocalIslandField final : public BlendField
{
public:
  using BlendField::BlendField;

  Near near(const std::vector<Box3>& boxes) const override
  {
    NearDependencies near(boxes, NearDependencies::Leaves::Numbered);
    near.add(blend_, 0);
    return { FieldSourcePtr(FieldSourcePtr(), &blend_), near.take(), near.isFaceted() };
  }
};

double ratioOf(std::size_t part, const std::vector<Box3>& boxes)
{
  std::vector<Box3> others;
  for (std::size_t n = 0; n < boxes.size(); ++n)
  {
    if (n != part && boxes[n].intersects(boxes[part]))
    {
      others.push_back(boxes[n]);
    }
  }
  return overlapRatio(boxes[part], others);
}

std::vector<MarkTerm> termsOf(const std::vector<BlendPart>& parts, double threshold)
{
  const std::vector<Box3> boxes = influenceBoxes(parts);
  std::vector<MarkTerm> terms;
  for (std::size_t k = 0; k < parts.size(); ++k)
  {
    const double ratio = ratioOf(k, boxes);
    const bool kept = !parts[k].node->isNegative() && parts[k].count == 1 && ratio <= threshold;
    terms.push_back({ parts[k].node, kept, static_cast<double>(parts[k].count), ratio });
  }
  return terms;
}

} // namespace

void MeshWarnings::add(const std::string& warning) const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!warning.empty() && std::find(warnings_.begin(), warnings_.end(), warning) == warnings_.end())
  {
    warnings_.push_back(warning);
  }
}

std::vector<std::string> MeshWarnings::all() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return warnings_;
}

namespace
{

std::size_t keepingCount(const std::vector<MarkTerm>& terms)
{
  return static_cast<std::size_t>(
    std::count_if(terms.begin(), terms.end(), [](const MarkTerm& term) { return term.kept; }));
}

std::vector<MeshPtr> meshesOf(const std::vector<KeptPart>& kept)
{
  std::vector<MeshPtr> meshes;
  for (const KeptPart& part : kept)
  {
    meshes.push_back(part.mesh);
  }
  return meshes;
}

std::vector<BlendPart> inOrder(std::vector<BlendPart> parts)
{
  std::sort(parts.begin(), parts.end(),
    [](const BlendPart& a, const BlendPart& b) { return a.firstLeaf < b.firstLeaf; });
  return parts;
}

} // namespace

BlendMesher::BlendMesher(
  const Node& blend, std::vector<BlendPart> parts, const BlendOptions& options, double edgeLength)
  : blend_(blend)
  , parts_(inOrder(std::move(parts)))
  , terms_(termsOf(parts_, options.overlapThreshold))
  , shapes_(terms_)
  , interaction_(std::make_unique<SumInteraction>())
  , field_(std::make_unique<SumIslandField>(blend, parts_))
  , method_(options.method)
  , grid_(gridOf(blend, edgeLength))
{
}

BlendMesher::BlendMesher(
  const Node& blend, const LocalBlendParts& local, const BlendOptions& options, double edgeLength)
  : blend_(blend)
  , parts_{ { local.a }, { local.b }, { local.region }, { local.unionOfBoth } }
  , terms_{ { local.a, false }, { local.b, false }, { local.region, false },
    { local.unionOfBoth, true } }
  , shapes_{ terms_.back() }
  , interaction_(std::make_unique<LocalInteraction>())
  , field_(std::make_unique<LocalIslandField>(blend))
  , method_(options.method)
  , grid_(gridOf(blend, edgeLength))
{
}

BlendMesher::~BlendMesher() = default;

BlendCost BlendMesher::cost() const
{
  return BlendCost(sampleCost(terms_, grid_.cellSize), blend_.isFaceted());
}

DeformedBlendCost BlendMesher::costToDeform(const SurfaceStretch& stretch) const
{
  return DeformedBlendCost(this->cost(), sampleCost(terms_, grid_.cellSize), stretch);
}

TriangleMesh BlendMesher::mesh(BlendMeshReport& report, const Progress& progress) const
{
  report = {};
  if (blend_.isNegative())
  {
    return {};
  }
  if (method_ == BlendMethod::Global)
  {
    return wholeLattice(blend_, grid_, report, progress);
  }
  report.method = method_;
  std::vector<MarkTerm> terms = terms_;
  const MemoryBudget budget{ kMaxBytes, grid_.cellSize };
  const ProgressPart marking(progress, 0.3, 0.4);
  std::optional<CellSet> cells;
  if (this->choosesFirst())
  {
    cells = BlendChoice(terms, *interaction_, grid_, budget, marking).byTerms(this->cost());
    if (!cells)
    {
      return wholeLattice(blend_, grid_, report, progress);
    }
  }
  const std::size_t keeping = keepingCount(terms);
  const std::vector<KeptPart> kept =
    keptMeshes(parts_, terms, grid_.cellSize, report, ProgressPart(progress, 0.0, 0.3));
  if (kept.empty())
  {
    return wholeLattice(blend_, grid_, report, ProgressPart(progress, 0.3, 1.0));
  }
  if (!this->choosesFirst() || keepingCount(terms) < keeping)
  {
    const bool byCost =
      method_ == BlendMethod::Automatic && !isFinerThanLattice(parts_, terms, grid_.cellSize);
    BlendChoice choice(terms, *interaction_, grid_, budget, marking);
    cells = byCost ? choice.byMeshes(this->cost(), kept) : choice.markAll();
  }
  const ProgressPart rest(progress, 0.4, 1.0);
  std::optional<TriangleMesh> mesh =
    cells ? stitchOver(kept, std::move(*cells), report, rest) : std::nullopt;
  if (!mesh)
  {
    return wholeLattice(blend_, grid_, report, rest);
  }
  noteStitched(blend_, grid_.cellSize);
  return std::move(*mesh);
}

std::optional<BlendPatch> BlendMesher::patchToDeform(
  const Deformation& by, const Progress& progress) const
{
  if (method_ != BlendMethod::Automatic || blend_.isNegative())
  {
    return std::nullopt;
  }
  std::vector<MarkTerm> terms = terms_;
  const MemoryBudget budget{ kMaxBytes, grid_.cellSize };
  const ProgressPart marking(progress, 0.3, 0.4);
  // Only where it is the lattice that is chosen otherwise, and has to be changed much.
  const auto isMuchChanged = [](const SurfaceStretch& stretch)
  { return stretch.isOneToOne && (stretch.spoilsShapes || stretch.growth > kSlightGrowth); };
  std::optional<CellSet> cells;
  if (this->choosesFirst())
  {
    const BlendSample sample(blend_, shapes_, grid_.cellSize);
    const SurfaceStretch stretch = stretchOf(by, sample.surface(), grid_.cellSize);
    BlendChoice choice(terms, *interaction_, grid_, budget, marking);
    if (isMuchChanged(stretch) && !choice.byTerms(this->cost()))
    {
      cells = choice.bySample(this->costToDeform(stretch), sample);
    }
    if (!cells)
    {
      return std::nullopt;
    }
  }
  const std::size_t keeping = keepingCount(terms);
  BlendMeshReport report;
  std::vector<KeptPart> kept =
    keptMeshes(parts_, terms, grid_.cellSize, report, ProgressPart(progress, 0.0, 0.3));
  if (kept.empty() || (cells && keepingCount(terms) < keeping))
  {
    return std::nullopt;
  }
  if (!cells && !isFinerThanLattice(parts_, terms, grid_.cellSize))
  {
    const SurfaceStretch stretch = stretchOf(by, sampleSurfaces(meshesOf(kept)), grid_.cellSize);
    BlendChoice choice(terms, *interaction_, grid_, budget, marking);
    if (isMuchChanged(stretch) && !choice.byMeshes(this->cost(), kept))
    {
      cells = choice.byMeshes(this->costToDeform(stretch), kept);
    }
  }
  return cells ? std::optional<BlendPatch>({ std::move(kept), std::move(*cells) }) : std::nullopt;
}

std::optional<TriangleMesh> BlendMesher::meshOver(
  BlendPatch patch, BlendMeshReport& report, const Progress& progress) const
{
  report = {};
  report.method = method_;
  return this->stitchOver(patch.kept, std::move(patch.cells), report, progress);
}

std::optional<TriangleMesh> BlendMesher::stitchOver(const std::vector<KeptPart>& kept,
  CellSet cells, BlendMeshReport& report, const Progress& progress) const
{
  report.markedCells = cells.size();
  report.borderCells = cells.borderCount();
  StitchOptions options;
  options.grid = grid_;
  options.maxBytes = kMaxBytes;
  std::optional<StitchedMesh> stitched =
    stitch(*field_, kept, std::move(cells), options, ProgressPart(progress, 0.0, 0.9));
  if (!stitched)
  {
    report.warning = "The blend could not be joined to the meshes of its operands; all of it was "
                     "polygonized anew. A shorter edge length may help.";
    report.rounds = options.maxRounds;
    return std::nullopt;
  }
  report.samplePoints = stitched->samplePoints;
  report.keptTriangles = stitched->keptTriangles;
  report.cutTriangles = stitched->cutTriangles;
  report.newTriangles = stitched->mesh.triangles.size() - stitched->keptTriangles;
  report.islands = stitched->islands;
  report.rememberedIslands = stitched->remembered;
  report.rounds = stitched->rounds;
  return std::move(stitched->mesh);
}

TriangleMesh blendMesh(const Node& blend, std::vector<BlendPart> parts, const BlendOptions& options,
  double edgeLength, BlendMeshReport& report, const Progress& progress)
{
  return BlendMesher(blend, std::move(parts), options, edgeLength).mesh(report, progress);
}

TriangleMesh localBlendMesh(const Node& blend, const LocalBlendParts& parts,
  const BlendOptions& options, double edgeLength, BlendMeshReport& report, const Progress& progress)
{
  return BlendMesher(blend, parts, options, edgeLength).mesh(report, progress);
}

MeshPtr blendMeshToDeform(const BlendMesher& mesher, const Deformation& by,
  const MeshWarnings& warnings, const KeepMesh& keep, const Progress& progress)
{
  std::optional<BlendPatch> patch = mesher.patchToDeform(by, progress);
  if (!patch)
  {
    return nullptr;
  }
  return keep(
    [&]
    {
      BlendMeshReport report;
      std::optional<TriangleMesh> mesh =
        mesher.meshOver(std::move(*patch), report, ProgressPart(progress, 0.4, 1.0));
      warnings.add(mesh ? report.warning : std::string());
      return mesh;
    });
}

void forgetBlends()
{
  forgetMarks();
  forgetIslands();
}

} // namespace hybridtree
