// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/BlendMesh.h"

#include "core/geometry/BoxUnion.h"
#include "core/mesh/SmoothNormals.h"
#include "core/nodes/LatticeMesh.h"
#include "core/nodes/TriangleSources.h"
#include "core/stitch/SoundMesh.h"
#include "core/stitch/Stitch.h"

#include <algorithm>
#include <unordered_map>

namespace hybridtree
{
namespace
{

constexpr std::size_t kMaxBytes = std::size_t(8) << 30;

/// Of a sum of fields: two that meet, or one without a mesh. What only carves has no surface.
class SumInteraction final : public Interaction
{
public:
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

/// Whether keeping the parts' triangles is faster than sampling where they are. With fields of
/// meshes a point of the patch, with the cut and the joint, costs about twice as much as one of the
/// whole lattice; fields of skeletons cost next to nothing, and cut and joint count for all.
bool pays(
  const Node& blend, const std::vector<KeptPart>& kept, const CellSet& cells, double cellSize)
{
  // Measured on scans and round shapes: marked cells per point made in them, and points of a
  // lattice per squared cell size of surface.
  constexpr double kCellsPerPoint = 6.0;
  constexpr double kPointsPerSquare = 1.4;
  const double costOfPatch = blend.isFaceted() ? 2.2 : 40.0;
  double area = 0.0;
  for (const KeptPart& part : kept)
  {
    for (std::size_t t = 0; t < part.mesh->triangles.size(); ++t)
    {
      area += 0.5 * areaNormal(*part.mesh, t).norm();
    }
  }
  const double all = kPointsPerSquare * area / (cellSize * cellSize);
  const double made = static_cast<double>(cells.size()) / kCellsPerPoint;
  return costOfPatch * made < std::max(all, made);
}

TriangleMesh wholeLattice(
  const Node& blend, double edgeLength, BlendMeshReport& report, const Progress& progress)
{
  TriangleMesh mesh = latticeMesh(blend, edgeLength, progress);
  report.method = BlendMethod::Global;
  report.samplePoints = mesh.points.size();
  report.newTriangles = mesh.triangles.size();
  return mesh;
}

/// The meshes of the parts that keep theirs; takes the right from those whose mesh is not sound.
std::vector<KeptPart> keptMeshes(const std::vector<BlendPart>& parts, std::vector<MarkTerm>& terms,
  double edgeLength, const Progress& progress)
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
    terms[k].kept = isSoundMesh(part.mesh);
    if (terms[k].kept)
    {
      kept.push_back(std::move(part));
    }
  }
  return kept;
}

/// As latticeMesh() does in a faceted tree, but for the new points alone.
void smoothNewNormals(StitchedMesh& stitched)
{
  TriangleMesh& mesh = stitched.mesh;
  TriangleMesh part;
  std::unordered_map<std::int32_t, std::int32_t> number;
  std::vector<std::int32_t> points;
  for (std::size_t t = stitched.keptTriangles; t < mesh.triangles.size(); ++t)
  {
    Triangle triangle = mesh.triangles[t];
    for (std::int32_t& v : triangle)
    {
      const auto [found, isNew] = number.try_emplace(v, static_cast<std::int32_t>(points.size()));
      if (isNew)
      {
        points.push_back(v);
        part.points.push_back(mesh.points[v]);
        part.normals.push_back(mesh.normals[v]);
      }
      v = found->second;
    }
    part.triangles.push_back(triangle);
  }
  smoothNormals(part);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    if (static_cast<std::size_t>(points[k]) >= stitched.keptPoints)
    {
      mesh.normals[points[k]] = part.normals[k];
    }
  }
}

TriangleMesh stitchOver(const Node& blend, const std::vector<KeptPart>& kept, CellSet cells,
  const CellGrid& grid, BlendMeshReport& report, const Progress& progress)
{
  StitchOptions options;
  options.grid = grid;
  options.maxBytes = kMaxBytes;
  std::optional<StitchedMesh> stitched =
    stitch(blend, kept, std::move(cells), options, ProgressPart(progress, 0.0, 0.9));
  if (!stitched)
  {
    report.warning = "The blend could not be joined to the meshes of its operands; all of it was "
                     "polygonized anew. A shorter edge length may help.";
    report.rounds = options.maxRounds;
    return wholeLattice(blend, grid.cellSize, report, progress);
  }
  report.samplePoints = stitched->samplePoints;
  report.keptTriangles = stitched->keptTriangles;
  report.cutTriangles = stitched->cutTriangles;
  report.newTriangles = stitched->mesh.triangles.size() - stitched->keptTriangles;
  report.rounds = stitched->rounds;
  if (blend.isFaceted())
  {
    smoothNewNormals(*stitched);
  }
  findSourceLeaves(blend, stitched->mesh, stitched->keptTriangles, progress);
  return std::move(stitched->mesh);
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

/// A first glance, before anything is meshed or marked: where no part is a mesh, only parts that
/// hardly meet are worth it.
bool mayPay(const Node& blend, const std::vector<BlendPart>& parts, const BlendOptions& options)
{
  if (options.method != BlendMethod::Automatic || blend.isFaceted())
  {
    return true;
  }
  constexpr double kHardlyMeet = 0.1;
  const std::vector<Box3> boxes = influenceBoxes(parts);
  for (std::size_t k = 0; k < boxes.size(); ++k)
  {
    if (ratioOf(k, boxes) > kHardlyMeet)
    {
      return false;
    }
  }
  return true;
}

std::vector<MarkTerm> termsOf(const std::vector<BlendPart>& parts, double threshold)
{
  const std::vector<Box3> boxes = influenceBoxes(parts);
  std::vector<MarkTerm> terms;
  for (std::size_t k = 0; k < parts.size(); ++k)
  {
    const bool kept =
      !parts[k].node->isNegative() && parts[k].count == 1 && ratioOf(k, boxes) <= threshold;
    terms.push_back({ parts[k].node, kept, static_cast<double>(parts[k].count) });
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

TriangleMesh blendMesh(const Node& blend, const std::vector<BlendPart>& parts,
  const BlendOptions& options, double edgeLength, BlendMeshReport& report, const Progress& progress)
{
  report = {};
  if (blend.isNegative())
  {
    return {};
  }
  if (options.method == BlendMethod::Global || !mayPay(blend, parts, options))
  {
    return wholeLattice(blend, edgeLength, report, progress);
  }
  report.method = options.method;
  std::vector<MarkTerm> terms = termsOf(parts, options.overlapThreshold);
  const std::vector<KeptPart> kept =
    keptMeshes(parts, terms, edgeLength, ProgressPart(progress, 0.0, 0.3));
  if (kept.empty())
  {
    return wholeLattice(blend, edgeLength, report, ProgressPart(progress, 0.3, 1.0));
  }
  const MemoryBudget budget{ kMaxBytes, edgeLength };
  const CellGrid grid = CellGrid::ofLevel(edgeLength, blend.depth());
  CellSet cells =
    markedCells(terms, SumInteraction(), grid, budget, ProgressPart(progress, 0.3, 0.4));
  if (options.method == BlendMethod::Automatic && !pays(blend, kept, cells, edgeLength))
  {
    return wholeLattice(blend, edgeLength, report, ProgressPart(progress, 0.4, 1.0));
  }
  return stitchOver(blend, kept, std::move(cells), grid, report, ProgressPart(progress, 0.4, 1.0));
}

TriangleMesh localBlendMesh(const Node& blend, const LocalBlendParts& local,
  const BlendOptions& options, double edgeLength, BlendMeshReport& report, const Progress& progress)
{
  report = {};
  if (blend.isNegative())
  {
    return {};
  }
  if (options.method == BlendMethod::Global ||
    (options.method == BlendMethod::Automatic && !blend.isFaceted()))
  {
    return wholeLattice(blend, edgeLength, report, progress);
  }
  report.method = options.method;
  std::vector<MarkTerm> terms{ { local.a, false }, { local.b, false }, { local.region, false },
    { local.unionOfBoth, true } };
  const std::vector<BlendPart> parts{ { local.a }, { local.b }, { local.region },
    { local.unionOfBoth } };
  const std::vector<KeptPart> kept =
    keptMeshes(parts, terms, edgeLength, ProgressPart(progress, 0.0, 0.3));
  if (kept.empty())
  {
    return wholeLattice(blend, edgeLength, report, ProgressPart(progress, 0.3, 1.0));
  }
  const MemoryBudget budget{ kMaxBytes, edgeLength };
  const CellGrid grid = CellGrid::ofLevel(edgeLength, blend.depth());
  CellSet cells =
    markedCells(terms, LocalInteraction(), grid, budget, ProgressPart(progress, 0.3, 0.4));
  if (options.method == BlendMethod::Automatic && !pays(blend, kept, cells, edgeLength))
  {
    return wholeLattice(blend, edgeLength, report, ProgressPart(progress, 0.4, 1.0));
  }
  return stitchOver(blend, kept, std::move(cells), grid, report, ProgressPart(progress, 0.4, 1.0));
}

} // namespace hybridtree
