// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/Patch.h"

#include "core/base/Parallel.h"
#include "core/polygonize/MarchingCubesTable.h"
#include "core/stitch/BorderSigns.h"
#include "core/stitch/CellLoops.h"
#include "core/stitch/PatchBricks.h"
#include "core/stitch/PatchFaces.h"
#include "core/stitch/PatchVertices.h"

#include <algorithm>
#include <unordered_map>

namespace hybridtree
{
namespace
{

constexpr std::size_t kBricksPerTask = 1;

// A loop of more vertices gets one more in its midst: around a fan the angles stay good.
constexpr std::size_t kLongLoop = 9;

// Bytes of a brick's bits and samples, of its vertices and triangles, and of what they are made of.
constexpr double kBytesPerBrick = 20000.0;

// Corners of a face, counter-clockwise from outside of the cell.
std::array<unsigned, 4> faceCorners(unsigned face)
{
  const unsigned axis = face / 2;
  const unsigned b = 1u << (axis + 1) % 3;
  const unsigned c = 1u << (axis + 2) % 3;
  const unsigned base = (face & 1u) << axis;
  return (face & 1u) != 0 ? std::array<unsigned, 4>{ base, base | b, base | b | c, base | c }
                          : std::array<unsigned, 4>{ base, base | c, base | b | c, base | b };
}

class PatchMaker
{
public:
  PatchMaker(const FieldSource& field, const CellSet& cells, const CellGrid& grid,
    const PatchBorder& border, const Progress& progress)
    : border_(border)
    , progress_(progress)
    , lattice_(PatchMaker::latticeOf(cells, grid))
    , bricks_(field, cells, lattice_, ProgressPart(progress, 0.0, 0.5))
    , crossings_(border.crossings)
  {
    for (const BorderSegment& segment : border.segments)
    {
      segments_[segment.cell].push_back(segment);
      this->markBusy(segment.cell);
    }
    for (const BorderCrossing& crossing : border.crossings)
    {
      facesOf_[crossing.vertex] = { crossing.low, crossing.axis };
      for (int n = 0; n < 4; ++n)
      {
        Index3 cell = crossing.low;
        cell[(crossing.axis + 1) % 3] -= n & 1;
        cell[(crossing.axis + 2) % 3] -= n >> 1;
        this->markBusy(cell);
      }
    }
  }

  Patch run()
  {
    this->noteMisfits(alignBorderSigns(bricks_, crossings_, progress_));
    for (PatchBrick& brick : bricks_.all())
    {
      bricks_.findCrossed(brick);
    }
    bricks_.askAtCrossed(progress_);
    PatchFaces(bricks_).decide(lattice_, progress_);
    makePatchVertices(bricks_, lattice_, border_.vertexCount, patch_, progress_);
    this->makeTriangles();
    return std::move(patch_);
  }

private:
  struct BrickWork
  {
    std::vector<Triangle> triangles; ///< vertices below -1: -2 - k is the k-th of the centers
    std::vector<Vec3> centers;
    std::vector<Vec3> centerNormals;
    std::vector<Index3> misfits;
  };

  /// The region where the field counts: all that can be asked for.
  static Lattice latticeOf(const CellSet& cells, const CellGrid& grid)
  {
    Lattice lattice = grid.lattice(cells.low(), cells.high());
    for (int axis = 0; axis < 3; ++axis)
    {
      lattice.low[axis] -= 1;
      lattice.high[axis] += 1;
    }
    return lattice;
  }

  void markBusy(const Index3& cell)
  {
    if (const PatchBricks::Place place = bricks_.locate(cell); place.brick)
    {
      place.brick->busy[place.z] |= std::uint64_t(1) << (kBrickSide * place.y + place.x);
    }
  }

  void noteMisfits(const std::vector<Index3>& cells)
  {
    patch_.misfits.insert(patch_.misfits.end(), cells.begin(), cells.end());
  }

  template <class Body>
  void forEachBrick(double begin, double end, Body&& body)
  {
    const ProgressPart part(progress_, begin, end);
    parallelFor(bricks_.all().size(), kBricksPerTask,
      [&](std::size_t from, std::size_t to)
      {
        part.check();
        for (std::size_t k = from; k < to; ++k)
        {
          body(bricks_.all()[k], k);
        }
      });
    part.report(1.0);
  }

  // Triangles.

  void makeTriangles()
  {
    std::vector<BrickWork> work(bricks_.all().size());
    this->forEachBrick(
      0.8, 1.0, [&](PatchBrick& brick, std::size_t k) { this->fillCells(brick, work[k]); });
    for (BrickWork& part : work)
    {
      const auto first = static_cast<std::int32_t>(
        border_.vertexCount + static_cast<std::int32_t>(patch_.points.size()));
      for (std::size_t k = 0; k < part.centers.size(); ++k)
      {
        patch_.unsettled.push_back(first + static_cast<std::int32_t>(k));
      }
      patch_.points.insert(patch_.points.end(), part.centers.begin(), part.centers.end());
      patch_.normals.insert(
        patch_.normals.end(), part.centerNormals.begin(), part.centerNormals.end());
      for (Triangle triangle : part.triangles)
      {
        for (std::int32_t& v : triangle)
        {
          v = v < -1 ? first + (-2 - v) : v;
        }
        patch_.triangles.push_back(triangle);
      }
      this->noteMisfits(part.misfits);
    }
  }

  void fillCells(const PatchBrick& brick, BrickWork& work)
  {
    BrickBits withSurface = brick.mixed;
    for (int z = 0; z < kBrickSide; ++z)
    {
      withSurface[z] |= brick.busy[z] & brick.cells[z];
    }
    PatchBrick::forEachCell(withSurface,
      [&](const std::array<int, 3>& cell)
      {
        const unsigned signs = bricks_.caseOf(brick, cell);
        const bool joins = PatchFaces(bricks_).anyJoined(brick, cell, signs);
        if (!joins && this->isInner(brick, cell))
        {
          this->fillInnerCell(brick, cell, signs, work);
        }
        else
        {
          this->fillBorderCell(brick, cell, signs, work);
        }
      });
  }

  static Index3 indexOf(const PatchBrick& brick, const std::array<int, 3>& cell)
  {
    return { kBrickSide * brick.index[0] + cell[0], kBrickSide * brick.index[1] + cell[1],
      kBrickSide * brick.index[2] + cell[2] };
  }

  static std::array<int, 3> lowOf(const std::array<int, 3>& cell, unsigned edge)
  {
    const unsigned corner = MarchingCubesTable::corners(edge)[0];
    return { cell[0] + static_cast<int>(corner & 1u), cell[1] + static_cast<int>(corner >> 1 & 1u),
      cell[2] + static_cast<int>(corner >> 2 & 1u) };
  }

  /// No edge of the cell is on the border.
  bool isInner(const PatchBrick& brick, const std::array<int, 3>& cell)
  {
    if (std::max({ cell[0], cell[1], cell[2] }) < kBrickSide - 1)
    {
      // Corners at which the cell's edges along x, y and z begin.
      constexpr unsigned kBegin[3] = { 0x55, 0x33, 0x0f };
      bool inner = true;
      for (unsigned axis = 0; axis < 3; ++axis)
      {
        const unsigned known = PatchBrick::corners(brick.inner[axis], cell[0], cell[1], cell[2]);
        inner = inner && (known & kBegin[axis]) == kBegin[axis];
      }
      return inner;
    }
    for (unsigned edge = 0; edge < 12; ++edge)
    {
      const std::array<int, 3> low = lowOf(cell, edge);
      const auto place = bricks_.locate(brick, low[0], low[1], low[2]);
      if (!PatchBrick::has(place.brick->inner[edge / 4], place.x, place.y, place.z))
      {
        return false;
      }
    }
    return true;
  }

  std::int32_t vertexOn(const PatchBrick& brick, const std::array<int, 3>& cell, unsigned edge)
  {
    const std::array<int, 3> low = lowOf(cell, edge);
    const auto place = bricks_.locate(brick, low[0], low[1], low[2]);
    return place.brick->vertexOn(edge / 4, place.x, place.y, place.z);
  }

  const Vec3& pointOf(std::int32_t vertex) const
  {
    return vertex < border_.vertexCount ? border_.points[vertex]
                                        : patch_.points[vertex - border_.vertexCount];
  }

  void fillInnerCell(
    const PatchBrick& brick, const std::array<int, 3>& cell, unsigned signs, BrickWork& work)
  {
    const MarchingCubesTable::Case& way = MarchingCubesTable::instance()[signs];
    for (unsigned n = 0; n < way.loopCount; ++n)
    {
      const MarchingCubesTable::Loop& loop = way.loops[n];
      std::array<std::int32_t, 7> v{};
      for (unsigned k = 0; k < loop.size; ++k)
      {
        v[k] = this->vertexOn(brick, cell, loop.edges[k]);
      }
      if (loop.size == 4)
      {
        const auto length = [&](unsigned a, unsigned b)
        { return (this->pointOf(v[a]) - this->pointOf(v[b])).squaredNorm(); };
        const unsigned first = length(0, 2) <= length(1, 3) ? 0 : 1; // by the shorter diagonal
        work.triangles.push_back({ v[first], v[first + 1], v[first + 2] });
        work.triangles.push_back({ v[first], v[first + 2], v[(first + 3) % 4] });
        continue;
      }
      for (unsigned k = 0; k + 2 < loop.size; ++k)
      {
        const std::uint8_t* corner = &loop.triangles[3 * k];
        work.triangles.push_back({ v[corner[0]], v[corner[1]], v[corner[2]] });
      }
    }
  }

  void fillBorderCell(
    const PatchBrick& brick, const std::array<int, 3>& cell, unsigned signs, BrickWork& work)
  {
    const Index3 index = PatchMaker::indexOf(brick, cell);
    std::vector<CellSegment> segments;
    this->addBorderSegments(index, segments);
    bool good = true;
    for (unsigned face = 0; face < 6; ++face)
    {
      std::array<int, 3> beyond = cell;
      beyond[face / 2] += (face & 1u) != 0 ? 1 : -1;
      if (bricks_.isMarked(brick, beyond))
      {
        good = this->addContour(brick, cell, index, face, signs, segments) && good;
      }
    }
    std::vector<CellLoop> loops;
    good = joinSegments(segments, loops) && good;
    for (const CellLoop& loop : loops)
    {
      this->fill(loop, work);
    }
    if (!good)
    {
      work.misfits.push_back(index);
    }
  }

  CellVertex borderVertex(std::int32_t vertex, const Index3& cell, unsigned face) const
  {
    CellVertex result{ vertex, 1u << face, border_.points[vertex] };
    const auto found = facesOf_.find(vertex);
    if (found != facesOf_.end())
    {
      result.faces = PatchMaker::facesAt(found->second, cell);
    }
    return result;
  }

  /// Faces of a cell at one of its edges.
  static unsigned facesAt(const LatticeEdge& edge, const Index3& cell)
  {
    unsigned faces = 0;
    for (unsigned axis = 0; axis < 3; ++axis)
    {
      if (axis != edge.axis)
      {
        faces |= 1u << (2 * axis + (edge.low[axis] > cell[axis] ? 1u : 0u));
      }
    }
    return faces;
  }

  void addBorderSegments(const Index3& cell, std::vector<CellSegment>& segments) const
  {
    const auto found = segments_.find(cell);
    if (found == segments_.end())
    {
      return;
    }
    for (const BorderSegment& segment : found->second)
    {
      segments.push_back({ this->borderVertex(segment.from, cell, segment.face),
        this->borderVertex(segment.to, cell, segment.face) });
    }
  }

  /// The contour of a face between two marked cells: from each vertex at which the way around the
  /// face enters the solid to the next, where it leaves it; where the inside corners are joined, to
  /// the one before.
  bool addContour(const PatchBrick& brick, const std::array<int, 3>& cell, const Index3& index,
    unsigned face, unsigned signs, std::vector<CellSegment>& segments)
  {
    const std::array<unsigned, 4> corners = faceCorners(face);
    std::vector<CellVertex> way;
    const bool first = (signs >> corners[0] & 1u) != 0;
    for (unsigned k = 0; k < 4; ++k)
    {
      this->addCrossings(brick, cell, index, corners[k], corners[(k + 1) % 4], signs, way);
    }
    if (way.size() % 2 != 0)
    {
      return false;
    }
    const std::size_t n = way.size();
    const std::size_t step = n == 4 && PatchFaces(bricks_).isJoined(brick, cell, face) ? n - 1 : 1;
    for (std::size_t k = first ? 1 : 0; k < n; k += 2)
    {
      segments.push_back({ way[k], way[(k + step) % n] });
    }
    return true;
  }

  void addCrossings(const PatchBrick& brick, const std::array<int, 3>& cell, const Index3& index,
    unsigned from, unsigned to, unsigned signs, std::vector<CellVertex>& way)
  {
    const unsigned low = std::min(from, to);
    const unsigned difference = from ^ to;
    const unsigned axis = difference == 1 ? 0 : difference == 2 ? 1 : 2;
    const std::array<int, 3> at{ cell[0] + static_cast<int>(low & 1u),
      cell[1] + static_cast<int>(low >> 1 & 1u), cell[2] + static_cast<int>(low >> 2 & 1u) };
    const auto place = bricks_.locate(brick, at[0], at[1], at[2]);
    const LatticeEdge edge{
      { index[0] + (low & 1u), index[1] + (low >> 1 & 1u), index[2] + (low >> 2 & 1u) }, axis
    };
    const unsigned faces = PatchMaker::facesAt(edge, index);
    if (PatchBrick::has(place.brick->inner[axis], place.x, place.y, place.z))
    {
      if ((signs >> from & 1u) != (signs >> to & 1u))
      {
        const std::int32_t v = place.brick->vertexOn(axis, place.x, place.y, place.z);
        way.push_back({ v, faces, this->pointOf(v) });
      }
      return;
    }
    const std::vector<std::int32_t>* vertices = crossings_.find(edge);
    if (!vertices)
    {
      return;
    }
    const std::size_t first = way.size();
    for (const std::int32_t v : *vertices)
    {
      way.push_back({ v, faces, border_.points[v] });
    }
    if (from > to)
    {
      std::reverse(way.begin() + static_cast<std::ptrdiff_t>(first), way.end());
    }
  }

  void fill(const CellLoop& loop, BrickWork& work) const
  {
    if (loop.size() <= kLongLoop && fillLoop(loop, work.triangles))
    {
      return;
    }
    Vec3 center = Vec3::Zero();
    Vec3 normal = Vec3::Zero();
    double length = 0.0;
    for (std::size_t k = 0; k < loop.size(); ++k)
    {
      const Vec3& a = loop[k].point;
      const Vec3& b = loop[(k + 1) % loop.size()].point;
      const double weight = (b - a).norm();
      center += 0.5 * weight * (a + b);
      normal += (a - loop.front().point).cross(b - loop.front().point);
      length += weight;
    }
    const auto number =
      static_cast<std::int32_t>(-2 - static_cast<std::int32_t>(work.centers.size()));
    work.centers.push_back(length > 0.0 ? Vec3(center / length) : loop.front().point);
    work.centerNormals.push_back(normal.stableNormalized());
    for (std::size_t k = 0; k < loop.size(); ++k)
    {
      work.triangles.push_back({ loop[k].vertex, loop[(k + 1) % loop.size()].vertex, number });
    }
  }

  const PatchBorder& border_;
  const Progress& progress_;
  const Lattice lattice_;
  PatchBricks bricks_;
  BorderCrossings crossings_;
  std::unordered_map<Index3, std::vector<BorderSegment>, Index3Hash> segments_;
  std::unordered_map<std::int32_t, LatticeEdge> facesOf_;
  Patch patch_;
};

} // namespace

Patch makePatch(const FieldSource& field, const CellSet& cells, const CellGrid& grid,
  const PatchBorder& border, const MemoryBudget& budget, const Progress& progress)
{
  if (cells.empty())
  {
    return {};
  }
  const auto bricks = static_cast<double>(cells.bricks().size());
  budget.check(bricks * kBytesPerBrick, bricks * kBrickPoints);
  return PatchMaker(field, cells, grid, border, progress).run();
}

} // namespace hybridtree
