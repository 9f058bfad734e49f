// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/BlendMesh.h"

#include "core/base/Dependency.h"
#include "core/geometry/BoxUnion.h"
#include "core/nodes/BlendCost.h"
#include "core/nodes/BlendEstimate.h"
#include "core/nodes/BlendSource.h"
#include "core/nodes/LatticeMesh.h"
#include "core/nodes/NearDependencies.h"
#include "core/nodes/TriangleSources.h"
#include "core/stitch/KeptMesh.h"
#include "core/stitch/Stitch.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace hybridtree
{
namespace
{

constexpr std::size_t kMaxBytes = std::size_t(8) << 30;

/// Of a sum of fields: two that meet, or one without a mesh. What only carves has no surface.
class SumInteraction final : public Interaction
{
public:
  int kind() const override { return 0; }

  bool marks(const std::vector<MarkTerm>& terms, const std::vector<int>& present) const override
  {
    const auto isPositive = [&](int k) { return !terms[k].node->isNegative(); };
    const auto givesUp = [&](int k) { return isPositive(k) && !terms[k].kept; };
    return present.size() > 1 ? std::any_of(present.begin(), present.end(), isPositive)
                              : present.size() == 1 && givesUp(present.front());
  }

  Interval range(const std::vector<int>&, const std::vector<Interval>& ranges) const override
  {
    Interval sum;
    for (const Interval& range : ranges)
    {
      sum = sum + range;
    }
    return sum;
  }
};

/// Of a local blend over A, B, region and their union: only where all three are there it is not the
/// union.
class LocalInteraction final : public Interaction
{
public:
  int kind() const override { return 1; }

  bool marks(const std::vector<MarkTerm>& terms, const std::vector<int>& present) const override
  {
    bool has[4] = {};
    for (const int k : present)
    {
      has[k] = true;
    }
    return (has[0] && has[1] && has[2]) || (has[3] && !terms[3].kept);
  }

  Interval range(
    const std::vector<int>& present, const std::vector<Interval>& ranges) const override
  {
    // Between the least of the union, and the sum.
    Interval all{ 0.0, 0.0 };
    for (std::size_t k = 0; k < present.size(); ++k)
    {
      if (present[k] != 2)
      {
        all = { all.min + std::min(ranges[k].min, 0.0), all.max + std::max(ranges[k].max, 0.0) };
      }
    }
    return all;
  }
};

constexpr std::size_t kAllCells = std::numeric_limits<std::size_t>::max();

/// Area of what is kept, in squared cells.
double squaresOf(const std::vector<KeptPart>& kept, double cellSize)
{
  double area = 0.0;
  for (const KeptPart& part : kept)
  {
    area += KeptMesh::of(part.mesh)->area();
  }
  return area / (cellSize * cellSize);
}

/// Length of the sharp edges of meshes that are leaves, in cells.
double creasesOf(const std::vector<KeptPart>& kept, double cellSize)
{
  double length = 0.0;
  for (const KeptPart& part : kept)
  {
    length += part.isLeaf ? KeptMesh::of(part.mesh)->creaseLength() : 0.0;
  }
  return length / cellSize;
}

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

TriangleMesh stitchOver(const Node& blend, const IslandField& field,
  const std::vector<KeptPart>& kept, CellSet cells, const CellGrid& grid, BlendMeshReport& report,
  const Progress& progress)
{
  report.markedCells = cells.size();
  report.borderCells = cells.borderCount();
  StitchOptions options;
  options.grid = grid;
  options.maxBytes = kMaxBytes;
  std::optional<StitchedMesh> stitched =
    stitch(field, kept, std::move(cells), options, ProgressPart(progress, 0.0, 0.9));
  if (!stitched)
  {
    report.warning = "The blend could not be joined to the meshes of its operands; all of it was "
                     "polygonized anew. A shorter edge length may help.";
    report.rounds = options.maxRounds;
    return wholeLattice(blend, grid, report, progress);
  }
  report.samplePoints = stitched->samplePoints;
  report.keptTriangles = stitched->keptTriangles;
  report.cutTriangles = stitched->cutTriangles;
  report.newTriangles = stitched->mesh.triangles.size() - stitched->keptTriangles;
  report.islands = stitched->islands;
  report.rememberedIslands = stitched->remembered;
  report.rounds = stitched->rounds;
  noteStitched(blend, grid.cellSize);
  return std::move(stitched->mesh);
}

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

/// The way from parts to a mesh, which is the same for all blends.
TriangleMesh meshByParts(const Node& blend, const std::vector<BlendPart>& parts,
  std::vector<MarkTerm> terms, const Interaction& interaction, const IslandField& field,
  const BlendOptions& options, double edgeLength, BlendMeshReport& report, const Progress& progress)
{
  report.method = options.method;
  const bool choose = options.method == BlendMethod::Automatic;
  const BlendCost cost(
    choose ? sampleCost(terms, edgeLength) : BlendCost::Sample{ 0.0, 0.0 }, blend.isFaceted());
  const MemoryBudget budget{ kMaxBytes, edgeLength };
  const CellGrid grid = gridOf(blend, edgeLength);
  const ProgressPart marking(progress, 0.3, 0.4);
  std::optional<CellMarker> marker;
  marker.emplace(terms, interaction, grid, budget, marking);
  const double givenUp = choose ? squaresGivenUp(terms, grid.cellSize) : 0.0;
  const auto markIfCheaper = [&](const BlendCost::Surface& surface)
  {
    const std::size_t most = cost.mostCells(surface);
    std::optional<CellSet> cells;
    if (!marker->seemMoreThan(most))
    {
      cells = marker->mark(most + most / 4); // by their border, then
    }
    return cells && cost.isLocalCheaper(*cells, surface) ? cells : std::nullopt;
  };
  std::optional<CellSet> cells;
  // Skeletons are sampled whole in no time: there the choice comes before anything is meshed.
  const bool chooseFirst = choose && !blend.isFaceted();
  if (chooseFirst)
  {
    cells = markIfCheaper({ squaresByPoints(terms, edgeLength), givenUp });
  }
  if (chooseFirst && !cells)
  {
    return wholeLattice(blend, grid, report, progress);
  }
  const std::size_t keeping = keepingCount(terms);
  const std::vector<KeptPart> kept =
    keptMeshes(parts, terms, edgeLength, report, ProgressPart(progress, 0.0, 0.3));
  if (kept.empty())
  {
    return wholeLattice(blend, grid, report, ProgressPart(progress, 0.3, 1.0));
  }
  if (!chooseFirst || keepingCount(terms) < keeping)
  {
    const bool byCost = choose && !isFinerThanLattice(parts, terms, edgeLength);
    const auto surface = [&]() -> BlendCost::Surface {
      return { squaresOf(kept, edgeLength), givenUp, creasesOf(kept, edgeLength) };
    };
    marker.emplace(terms, interaction, grid, budget, marking); // the terms may have changed
    cells = byCost ? markIfCheaper(surface()) : marker->mark(kAllCells);
  }
  const ProgressPart rest(progress, 0.4, 1.0);
  return cells ? stitchOver(blend, field, kept, std::move(*cells), grid, report, rest)
               : wholeLattice(blend, grid, report, rest);
}

} // namespace

TriangleMesh blendMesh(const Node& blend, std::vector<BlendPart> parts, const BlendOptions& options,
  double edgeLength, BlendMeshReport& report, const Progress& progress)
{
  report = {};
  if (blend.isNegative())
  {
    return {};
  }
  if (options.method == BlendMethod::Global)
  {
    return wholeLattice(blend, gridOf(blend, edgeLength), report, progress);
  }
  std::sort(parts.begin(), parts.end(),
    [](const BlendPart& a, const BlendPart& b) { return a.firstLeaf < b.firstLeaf; });
  return meshByParts(blend, parts, termsOf(parts, options.overlapThreshold), SumInteraction(),
    SumIslandField(blend, parts), options, edgeLength, report, progress);
}

TriangleMesh localBlendMesh(const Node& blend, const LocalBlendParts& local,
  const BlendOptions& options, double edgeLength, BlendMeshReport& report, const Progress& progress)
{
  report = {};
  if (blend.isNegative())
  {
    return {};
  }
  if (options.method == BlendMethod::Global)
  {
    return wholeLattice(blend, gridOf(blend, edgeLength), report, progress);
  }
  const std::vector<MarkTerm> terms{ { local.a, false }, { local.b, false },
    { local.region, false }, { local.unionOfBoth, true } };
  const std::vector<BlendPart> parts{ { local.a }, { local.b }, { local.region },
    { local.unionOfBoth } };
  return meshByParts(blend, parts, terms, LocalInteraction(), LocalIslandField(blend), options,
    edgeLength, report, progress);
}

void forgetBlends()
{
  forgetMarks();
  forgetIslands();
}

} // namespace hybridtree
