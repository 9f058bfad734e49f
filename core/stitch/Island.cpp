// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/Island.h"

#include "core/base/LargestFirst.h"
#include "core/mesh/SmoothNormals.h"
#include "core/polygonize/MemoryBudget.h"
#include "core/polygonize/SharpCreases.h"
#include "core/stitch/CheckPatch.h"
#include "core/stitch/GradeCut.h"
#include "core/stitch/KeptMesh.h"
#include "core/stitch/Patch.h"
#include "core/stitch/PatchShape.h"
#include "core/stitch/ProjectPoints.h"
#include "core/stitch/RimNumbers.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

constexpr double kReach = 0.5;     // cells that a cut vertex may move
constexpr double kRounding = 1e-6; // cells

/// Where the gradient gives no normal, the triangles do.
void mendNormals(TriangleMesh& mesh)
{
  std::vector<std::int32_t> missing;
  std::vector<Vec3> sums;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    for (const std::int32_t v : mesh.triangles[t])
    {
      if (mesh.normals[v].isZero(0.0))
      {
        missing.push_back(v);
        sums.push_back(areaNormal(mesh, t));
      }
    }
  }
  for (std::size_t k = 0; k < missing.size(); ++k)
  {
    mesh.normals[missing[k]] += sums[k];
  }
  std::sort(missing.begin(), missing.end());
  missing.erase(std::unique(missing.begin(), missing.end()), missing.end());
  for (const std::int32_t v : missing)
  {
    mesh.normals[v].stableNormalize();
  }
}

class IslandMaker
{
public:
  IslandMaker(const FieldSource& field, const std::vector<KeptPart>& parts, IslandCut cut,
    const CellSet& cells, const StitchOptions& options, const Progress& progress)
    : field_(field)
    , parts_(parts)
    , cut_(std::move(cut))
    , cells_(cells)
    , options_(options)
    , progress_(progress)
    , rimNumbers_(cut_.rim)
  {
  }

  Island run(const IslandField& whole, bool faceted)
  {
    const Patch patch = this->makePatchInside();
    this->join(patch);
    projectPoints(field_, this->pointsToMove(patch), kReach * options_.grid.cellSize, island_.mesh);
    mendNormals(island_.mesh);
    this->sharpen(patch, faceted);
    onCrease_.resize(island_.mesh.points.size(), true); // those that were added
    improveShapes(field_, island_.mesh, cut_.rim.size(), onCrease_, options_.grid.cellSize,
      options_.unfold ? Folds::Unfold : Folds::Stay);
    this->findFaults(patch);
    if (island_.faults.empty())
    {
      if (faceted)
      {
        this->smoothNewNormals();
      }
      whole.findSources(island_.mesh, progress_);
    }
    for (CutMesh& cut : cut_.cuts)
    {
      island_.gone.push_back(std::move(cut.gone));
    }
    island_.rim = std::move(cut_.rim);
    return std::move(island_);
  }

private:
  /// As latticeMesh(): where facets are smoothed away first, they are not looked at as creases.
  void sharpen(const Patch& patch, bool faceted)
  {
    TriangleMesh& mesh = island_.mesh;
    const std::vector<Vec3> before = mesh.normals;
    if (faceted)
    {
      this->smoothNewNormals();
    }
    if (options_.haveCreases)
    {
      sharpenCreases(field_, options_.grid.lattice({}, {}),
        mesh.triangles.size() - patch.triangles.size(), mesh, ProgressPart(progress_, 0.5, 1.0));
    }
    std::copy(before.begin(), before.end(), mesh.normals.begin());
  }

  void smoothNewNormals()
  {
    const auto kept = static_cast<std::ptrdiff_t>(cut_.rim.size());
    std::vector<Vec3>& normals = island_.mesh.normals;
    const std::vector<Vec3> before(normals.begin(), normals.begin() + kept);
    // Turned round, the normals of creases do not mix with those of the faces beside them.
    this->turnCreaseNormals();
    smoothNormals(island_.mesh);
    this->turnCreaseNormals();
    std::copy(before.begin(), before.end(), normals.begin());
  }

  void turnCreaseNormals()
  {
    for (std::size_t k = 0; k < onCrease_.size(); ++k)
    {
      Vec3& normal = island_.mesh.normals[k];
      normal = onCrease_[k] ? Vec3(-normal) : normal;
    }
  }

  /// Points at which cut triangles meet that turn by more than 25 degrees. The pieces that are left
  /// of them are often too thin to tell.
  void findCreases()
  {
    constexpr double kCosine = 0.906;
    const TriangleMesh& mesh = island_.mesh;
    std::vector<Vec3> first(mesh.points.size(), Vec3::Zero());
    onCrease_.assign(mesh.points.size(), false);
    std::size_t t = 0;
    for (std::size_t p = 0; p < parts_.size(); ++p)
    {
      std::int32_t last = -1; // pieces of one triangle follow one another
      Vec3 normal = Vec3::Zero();
      for (const std::int32_t source : cut_.cuts[p].pieceOf)
      {
        normal = source == last
          ? normal
          : areaNormal(*parts_[p].mesh, static_cast<std::size_t>(source)).stableNormalized();
        last = source;
        for (const std::int32_t v : mesh.triangles[t++])
        {
          first[v] = first[v].isZero(0.0) ? normal : first[v];
          onCrease_[v] = onCrease_[v] || first[v].dot(normal) < kCosine;
        }
      }
    }
  }

  /// The lines in which all cut meshes meet the border: vertices are the cut vertices of the first
  /// part, those of the second, and so on.
  Patch makePatchInside()
  {
    std::vector<Vec3> points;
    PatchBorder border;
    for (std::size_t p = 0; p < parts_.size(); ++p)
    {
      const CutMesh& cut = cut_.cuts[p];
      const auto shift = static_cast<std::int32_t>(points.size()) - this->pointCount(p);
      for (BorderSegment segment : cut.segments)
      {
        segment.from += shift;
        segment.to += shift;
        border.segments.push_back(segment);
      }
      for (BorderCrossing crossing : cut.crossings)
      {
        crossing.vertex += shift;
        border.crossings.push_back(crossing);
      }
      for (const CutVertex& vertex : cut.vertices)
      {
        points.push_back(vertex.point);
      }
    }
    border.vertexCount = static_cast<std::int32_t>(points.size());
    border.points = points.data();
    const MemoryBudget budget{ options_.maxBytes, options_.grid.cellSize };
    return makePatch(
      field_, cells_, options_.grid, border, budget, ProgressPart(progress_, 0.0, 0.5));
  }

  std::int32_t pointCount(std::size_t p) const
  {
    return static_cast<std::int32_t>(parts_[p].mesh->points.size());
  }

  /// Number of a point of a part in the rim; -1 where it is not there.
  std::int32_t rimNumber(std::size_t p, std::int32_t point) const
  {
    return rimNumbers_.find({ static_cast<std::int32_t>(p), point });
  }

  /// One mesh of the rim, the cut vertices and the patch.
  void join(const Patch& patch)
  {
    TriangleMesh& mesh = island_.mesh;
    for (const KeptPart& part : parts_)
    {
      hasSourceTriangles_ = hasSourceTriangles_ || !part.mesh->sourceTriangle.empty();
      hasOrigins_ = hasOrigins_ || !part.mesh->vertexOrigin.empty();
    }
    for (const PartPoint& at : cut_.rim)
    {
      const TriangleMesh& from = *parts_[at.part].mesh;
      mesh.points.push_back(from.points[at.point]);
      mesh.normals.push_back(from.normals[at.point]);
    }
    for (std::size_t p = 0; p < parts_.size(); ++p)
    {
      firstCut_.push_back(static_cast<std::int32_t>(mesh.points.size()));
      this->addCutVertices(p);
    }
    mesh.vertexOrigin.resize(hasOrigins_ ? mesh.points.size() + patch.points.size() : 0);
    for (std::size_t p = 0; p < parts_.size(); ++p)
    {
      this->addPieces(p);
    }
    mesh.points.insert(mesh.points.end(), patch.points.begin(), patch.points.end());
    mesh.normals.insert(mesh.normals.end(), patch.normals.begin(), patch.normals.end());
    const auto shift = static_cast<std::int32_t>(cut_.rim.size());
    for (const Triangle& c : patch.triangles)
    {
      this->addTriangle({ c[0] + shift, c[1] + shift, c[2] + shift }, -1, -1);
    }
    island_.samplePoints = patch.points.size();
    this->findCreases();
  }

  void addTriangle(const Triangle& triangle, std::int32_t leaf, std::int32_t source)
  {
    island_.mesh.triangles.push_back(triangle);
    island_.mesh.sourceLeaf.push_back(leaf);
    if (hasSourceTriangles_)
    {
      island_.mesh.sourceTriangle.push_back(source);
    }
  }

  void addCutVertices(std::size_t p)
  {
    const TriangleMesh& from = *parts_[p].mesh;
    TriangleMesh& mesh = island_.mesh;
    mesh.vertexOrigin.resize(hasOrigins_ ? mesh.points.size() : 0);
    for (const CutVertex& vertex : cut_.cuts[p].vertices)
    {
      const Triangle& c = from.triangles[vertex.triangle];
      mesh.points.push_back(vertex.point);
      mesh.normals.push_back(((1.0 - vertex.u - vertex.v) * from.normals[c[0]] +
        vertex.u * from.normals[c[1]] + vertex.v * from.normals[c[2]])
                               .stableNormalized());
      if (hasOrigins_)
      {
        mesh.vertexOrigin.push_back(this->originOf(p, vertex));
      }
    }
  }

  void addPieces(std::size_t p)
  {
    const CutMesh& cut = cut_.cuts[p];
    island_.cutTriangles += cut.cutTriangles.size();
    for (std::size_t k = 0; k < cut.pieces.size(); ++k)
    {
      Triangle c = cut.pieces[k];
      for (std::int32_t& v : c)
      {
        const std::int32_t beyond = v - this->pointCount(p);
        v = beyond < 0 ? this->rimNumber(p, v) : firstCut_[p] + beyond;
      }
      const std::int32_t t = cut.pieceOf[k];
      const bool isPart = cut.isPart.empty() || cut.isPart[k];
      this->addTriangle(c, this->leafOf(p, t), isPart ? this->sourceOf(p, t) : -1);
    }
  }

  std::int32_t leafOf(std::size_t p, std::int32_t t) const
  {
    const std::vector<std::int32_t>& leaf = parts_[p].mesh->sourceLeaf;
    return leaf.empty() || leaf[t] < 0 ? -1 : leaf[t] + parts_[p].firstLeaf;
  }

  std::int32_t sourceOf(std::size_t p, std::int32_t t) const
  {
    const std::vector<std::int32_t>& source = parts_[p].mesh->sourceTriangle;
    return source.empty() ? -1 : source[t];
  }

  /// Known where the corners of the triangle have their origins in the same triangle of the leaf.
  VertexOrigin originOf(std::size_t p, const CutVertex& vertex) const
  {
    const TriangleMesh& mesh = *parts_[p].mesh;
    const std::int32_t source = this->sourceOf(p, vertex.triangle);
    const std::int32_t leaf = this->leafOf(p, vertex.triangle);
    if (source < 0 || leaf < 0 || mesh.vertexOrigin.empty())
    {
      return {};
    }
    if (parts_[p].isLeaf)
    {
      return { leaf, source, vertex.u, vertex.v };
    }
    VertexOrigin result{ leaf, source, 0.0, 0.0 };
    const double weights[3] = { 1.0 - vertex.u - vertex.v, vertex.u, vertex.v };
    for (int k = 0; k < 3; ++k)
    {
      const VertexOrigin& corner = mesh.vertexOrigin[mesh.triangles[vertex.triangle][k]];
      if (corner.triangle != source)
      {
        return {};
      }
      result.u += weights[k] * corner.u;
      result.v += weights[k] * corner.v;
    }
    return result;
  }

  /// New points that are not yet on the surface: the unsettled ones of the patch, and cut vertices
  /// of parts whose triangles are chords of it. On mesh leaves those are where they belong.
  std::vector<std::size_t> pointsToMove(const Patch& patch) const
  {
    std::vector<std::size_t> points;
    for (std::size_t p = 0; p < parts_.size(); ++p)
    {
      for (std::size_t k = 0; k < cut_.cuts[p].vertices.size() && !parts_[p].isLeaf; ++k)
      {
        points.push_back(static_cast<std::size_t>(firstCut_[p]) + k);
      }
    }
    for (const std::int32_t v : patch.unsettled)
    {
      points.push_back(cut_.rim.size() + static_cast<std::size_t>(v));
    }
    return points;
  }

  /// The triangles at the rim that stay. Points that are not in the rim have numbers beyond those
  /// of the island.
  std::vector<Triangle> trianglesAround() const
  {
    std::vector<Triangle> around;
    auto beyond = static_cast<std::int32_t>(island_.mesh.points.size());
    for (std::size_t p = 0; p < parts_.size(); ++p)
    {
      const std::vector<std::int32_t>& gone = cut_.cuts[p].gone;
      if (!gone.empty())
      {
        this->addTrianglesAround(p, gone, beyond, around);
      }
      beyond += this->pointCount(p);
    }
    return around;
  }

  void addTrianglesAround(std::size_t p, const std::vector<std::int32_t>& gone, std::int32_t beyond,
    std::vector<Triangle>& around) const
  {
    const PointTriangles& triangles = KeptMesh::of(parts_[p].mesh)->pointTriangles();
    std::vector<std::int32_t> near;
    for (const PartPoint& at : cut_.rim)
    {
      if (at.part == static_cast<std::int32_t>(p))
      {
        const std::int32_t* const of = triangles.of(at.point);
        near.insert(near.end(), of, of + triangles.count(at.point));
      }
    }
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    std::vector<std::int32_t> staying;
    std::set_difference(
      near.begin(), near.end(), gone.begin(), gone.end(), std::back_inserter(staying));
    for (const std::int32_t t : staying)
    {
      Triangle c = parts_[p].mesh->triangles[t];
      for (std::int32_t& v : c)
      {
        const std::int32_t number = this->rimNumber(p, v);
        v = number >= 0 ? number : beyond + v;
      }
      around.push_back(c);
    }
  }

  void findFaults(const Patch& patch)
  {
    const TriangleMesh& mesh = island_.mesh;
    const CellGrid& grid = options_.grid;
    island_.faults = patch.misfits;
    for (const std::int32_t v : faultyPoints(mesh, this->trianglesAround()))
    {
      island_.faults.push_back(grid.cellAt(mesh.points[v]));
    }
    for (const std::size_t t : turnedTriangles(mesh))
    {
      const Triangle& c = mesh.triangles[t];
      const Vec3 middle = (mesh.points[c[0]] + mesh.points[c[1]] + mesh.points[c[2]]) / 3.0;
      island_.faults.push_back(grid.cellAt(middle));
    }
  }

  const FieldSource& field_;
  const std::vector<KeptPart>& parts_;
  IslandCut cut_;
  const CellSet& cells_;
  const StitchOptions& options_;
  const Progress& progress_;
  const RimNumbers rimNumbers_;
  bool hasSourceTriangles_ = false;
  bool hasOrigins_ = false;
  std::vector<std::int32_t> firstCut_; ///< per part: its first cut vertex in the island
  std::vector<bool> onCrease_;         ///< per point of the island
  Island island_;
};

template <typename T>
std::size_t bytesOf(const std::vector<T>& values)
{
  return values.capacity() * sizeof(T);
}

} // namespace

std::vector<std::size_t> sizesOf(const std::vector<KeptPart>& parts)
{
  std::vector<std::size_t> sizes;
  for (const KeptPart& part : parts)
  {
    sizes.push_back(part.mesh->triangles.size());
  }
  return sizes;
}

std::size_t Island::bytes() const
{
  std::size_t sum = sizeof *this + bytesOf(rim) + bytesOf(faults);
  for (const std::vector<std::int32_t>& part : gone)
  {
    sum += sizeof part + bytesOf(part);
  }
  return sum + bytesOf(mesh.points) + bytesOf(mesh.normals) + bytesOf(mesh.triangles) +
    bytesOf(mesh.sourceLeaf) + bytesOf(mesh.sourceTriangle) + bytesOf(mesh.vertexOrigin);
}

IslandCut cutIsland(const std::vector<KeptPart>& parts, const CellSet& cells, const CellGrid& grid,
  const Progress& progress)
{
  IslandCut result;
  result.cuts.resize(parts.size());
  std::vector<std::vector<std::int32_t>> corners(parts.size()); // of cut triangles
  const std::vector<Box3> boxes = cells.boxes(grid, kRounding);
  forLargestFirst(sizesOf(parts),
    [&](std::size_t p)
    {
      const TriangleMesh& mesh = *parts[p].mesh;
      const std::shared_ptr<const KeptMesh> known = KeptMesh::of(parts[p].mesh);
      CutMesh& cut = result.cuts[p];
      cut = cutMesh(mesh, known->blocks().near(boxes), cells, grid, progress);
      gradeCut(mesh, *known, grid.cellSize, cut);
      for (const std::int32_t t : cut.cutTriangles)
      {
        corners[p].insert(corners[p].end(), mesh.triangles[t].begin(), mesh.triangles[t].end());
      }
      std::sort(corners[p].begin(), corners[p].end());
      corners[p].erase(std::unique(corners[p].begin(), corners[p].end()), corners[p].end());
    });
  for (std::size_t p = 0; p < parts.size(); ++p)
  {
    for (const std::int32_t v : corners[p])
    {
      result.rim.push_back({ static_cast<std::int32_t>(p), v });
    }
  }
  return result;
}

Island makeIsland(const IslandField& field, const IslandField::Near& near,
  const std::vector<KeptPart>& parts, IslandCut cut, const CellSet& cells,
  const StitchOptions& options, const Progress& progress)
{
  return IslandMaker(*near.source, parts, std::move(cut), cells, options, progress)
    .run(field, near.faceted);
}

} // namespace hybridtree
