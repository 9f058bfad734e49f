// SPDX-License-Identifier: BSD-3-Clause
#include "core/polygonize/Polygonize.h"

#include "core/base/Error.h"
#include "core/base/Parallel.h"
#include "core/base/Scratch.h"
#include "core/polygonize/Brick.h"
#include "core/polygonize/BrickFaces.h"
#include "core/polygonize/BrickTree.h"
#include "core/polygonize/CrossedCells.h"
#include "core/polygonize/EdgeRoots.h"
#include "core/polygonize/LoopCentre.h"
#include "core/polygonize/MarchingCubesTable.h"

#include <algorithm>
#include <atomic>
#include <limits>

namespace hybridtree
{
namespace
{

constexpr std::size_t kBricksPerTask = 4;

constexpr unsigned kAllNeighbours = 8;

Index3 offset(const Index3& brick, unsigned neighbour, std::int64_t sign)
{
  return { brick[0] + sign * (neighbour & 1), brick[1] + sign * (neighbour >> 1 & 1),
    brick[2] + sign * (neighbour >> 2 & 1) };
}

std::size_t pointOf(unsigned x, unsigned y, unsigned z)
{
  return (z * kBrickSide + y) * kBrickSide + x;
}

/// The steps of polygonize(). Each lattice point, edge and cell belongs to one brick, and only that
/// brick decides about it; the others look it up. So there is nothing to agree upon between bricks,
/// and nothing depends on the order in which they are worked on.
class Polygonizer
{
public:
  Polygonizer(const FieldSource& field, const Lattice& lattice, const MemoryBudget& budget,
    const Progress& progress)
    : field_(field)
    , lattice_(lattice)
    , budget_(budget)
    , progress_(progress)
    , tree_(field, lattice_, budget, ProgressPart(progress, 0.0, 0.2))
  {
  }

  TriangleMesh run()
  {
    this->sampleBricks(0);
    this->openMissedBricks();
    this->connectBricks();
    this->decideFaces();
    this->allocateMesh();
    this->makeVertices();
    this->makeTriangles();
    this->mendNormals();
    return std::move(mesh_);
  }

private:
  template <class Body>
  void forEachBrick(std::size_t first, double begin, double end, Body&& body)
  {
    const ProgressPart part(progress_, begin, end);
    const std::size_t count = bricks_.size() - first;
    std::atomic<std::size_t> done(0);
    parallelFor(count, kBricksPerTask,
      [&](std::size_t from, std::size_t to)
      {
        for (std::size_t k = from; k < to; ++k)
        {
          part.check();
          body(bricks_[first + k], first + k);
        }
        part.report(static_cast<double>(done += to - from) / static_cast<double>(count));
      });
  }

  // Samples.

  void sampleBricks(std::size_t first)
  {
    const auto& leaves = tree_.leaves();
    bricks_.resize(leaves.size());
    values_.resize(leaves.size() * kBrickPoints);
    this->forEachBrick(first, 0.2, 0.5,
      [&](Brick& brick, std::size_t k)
      {
        brick.index = leaves[k].brick;
        this->sample(brick, *leaves[k].source, &values_[k * kBrickPoints]);
      });
  }

  void sample(Brick& brick, const FieldSource& source, float* values) const
  {
    ScratchVectors points(kBrickPoints);
    ScratchArray field(kBrickPoints);
    this->placePoints(brick, points.batch());
    source.field(points.points(), field.data());
    for (unsigned z = 0; z < kBrickSide; ++z)
    {
      const std::uint64_t counted = this->countedPoints(brick, z);
      std::uint64_t inside = 0;
      for (unsigned n = 0; n < kBrickSide * kBrickSide; ++n)
      {
        const double value = field[pointOf(n, 0, z)] - kThreshold;
        inside |= std::uint64_t(isInside(value)) << n;
        values[pointOf(n, 0, z)] = static_cast<float>(value);
      }
      brick.inside[z] = inside & counted;
    }
  }

  Index3 firstPoint(const Brick& brick) const
  {
    return { brick.index[0] * kBrickSide, brick.index[1] * kBrickSide,
      brick.index[2] * kBrickSide };
  }

  void placePoints(const Brick& brick, VectorBatch points) const
  {
    const Index3 first = this->firstPoint(brick);
    for (unsigned z = 0; z < kBrickSide; ++z)
    {
      for (unsigned y = 0; y < kBrickSide; ++y)
      {
        for (unsigned x = 0; x < kBrickSide; ++x)
        {
          const std::size_t k = pointOf(x, y, z);
          points.set(k, lattice_.point({ first[0] + x, first[1] + y, first[2] + z }));
        }
      }
    }
  }

  /// The points of layer z that lie in the region where the field counts.
  std::uint64_t countedPoints(const Brick& brick, unsigned z) const
  {
    const Index3 first = this->firstPoint(brick);
    const std::int64_t last = kBrickSide - 1;
    if (lattice_.contains({ first[0], first[1], first[2] + z }) &&
      lattice_.contains({ first[0] + last, first[1] + last, first[2] + z }))
    {
      return ~std::uint64_t(0);
    }
    std::uint64_t bits = 0;
    for (unsigned n = 0; n < kBrickSide * kBrickSide; ++n)
    {
      const Index3 point{ first[0] + n % kBrickSide, first[1] + n / kBrickSide, first[2] + z };
      bits |= std::uint64_t(lattice_.contains(point)) << n;
    }
    return bits;
  }

  /// A brick was pruned although a sampled neighbour tells that the surface crosses its cells: the
  /// range of the field is not quite conservative there. The samples decide.
  void openMissedBricks()
  {
    std::size_t first = 0;
    while (first < bricks_.size())
    {
      std::vector<std::array<bool, kAllNeighbours>> missed(bricks_.size());
      this->forEachBrick(first, 0.5, 0.5,
        [&](const Brick& brick, std::size_t k)
        {
          for (unsigned n = 1; n < kAllNeighbours; ++n)
          {
            missed[k][n] = this->isMissed(offset(brick.index, n, -1));
          }
        });
      const std::size_t end = bricks_.size();
      for (std::size_t k = first; k < end; ++k)
      {
        for (unsigned n = 1; n < kAllNeighbours; ++n)
        {
          if (missed[k][n])
          {
            tree_.open(offset(bricks_[k].index, n, -1));
          }
        }
      }
      first = end;
      this->sampleBricks(first);
    }
  }

  bool isMissed(const Index3& brick) const
  {
    return tree_.find(brick) < 0 && !gatherSigns(this->neighboursOf(brick), bricks_).uniform();
  }

  std::array<BrickTree::Content, kAllNeighbours> neighboursOf(const Index3& brick) const
  {
    std::array<BrickTree::Content, kAllNeighbours> contents{};
    for (unsigned n = 0; n < kAllNeighbours; ++n)
    {
      contents[n] = tree_.find(offset(brick, n, 1));
    }
    return contents;
  }

  // Counts.

  void connectBricks()
  {
    this->forEachBrick(0, 0.5, 0.55,
      [&](Brick& brick, std::size_t)
      {
        brick.neighbours = this->neighboursOf(brick.index);
        const CornerSigns signs = gatherSigns(brick.neighbours, bricks_);
        signs.findCrossedEdges(brick.crossed);
        brick.countVertices();
        brick.triangleCount = 0;
        forEachCrossedCell(signs,
          [&](const CrossedCell& cell)
          {
            brick.triangleCount += cell.way.triangleCount;
            brick.ambiguous = brick.ambiguous || cell.way.ambiguous != 0;
          });
      });
  }

  void decideFaces()
  {
    faces_.decide(bricks_, tree_, lattice_, progress_);
    for (Brick& brick : bricks_)
    {
      if (brick.ambiguous)
      {
        faces_.count(brick, gatherSigns(brick.neighbours, bricks_));
      }
    }
  }

  void allocateMesh()
  {
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    for (Brick& brick : bricks_)
    {
      brick.firstVertex = static_cast<std::uint32_t>(vertices);
      brick.firstTriangle = static_cast<std::uint32_t>(triangles);
      vertices += brick.vertexCount;
      triangles += brick.triangleCount;
    }
    for (Brick& brick : bricks_)
    {
      brick.firstCentre = static_cast<std::uint32_t>(vertices);
      vertices += brick.centreCount;
    }
    const double bytes = static_cast<double>(vertices) * 2 * sizeof(Vec3) +
      static_cast<double>(triangles) * sizeof(Triangle) +
      static_cast<double>(bricks_.size()) * (sizeof(Brick) + kBrickPoints * sizeof(float));
    const double cells = static_cast<double>(bricks_.size()) * kBrickPoints;
    budget_.check(bytes, cells);
    if (std::max(vertices, triangles) > std::numeric_limits<std::int32_t>::max())
    {
      budget_.check(std::numeric_limits<double>::infinity(), cells);
    }
    mesh_.points.resize(vertices);
    mesh_.normals.resize(vertices);
    mesh_.triangles.resize(triangles);
  }

  // Vertices.

  void makeVertices()
  {
    this->forEachBrick(0, 0.55, 0.9,
      [&](const Brick& brick, std::size_t k)
      {
        if (brick.vertexCount == 0)
        {
          return;
        }
        std::vector<CrossedEdge> edges;
        edges.reserve(brick.vertexCount);
        for (unsigned axis = 0; axis < 3; ++axis)
        {
          this->collectEdges(brick, k, axis, edges);
        }
        findSurface(*tree_.leaves()[k].source, lattice_, edges, &mesh_.points[brick.firstVertex],
          &mesh_.normals[brick.firstVertex]);
      });
  }

  void collectEdges(
    const Brick& brick, std::size_t k, unsigned axis, std::vector<CrossedEdge>& edges) const
  {
    const float* values = &values_[k * kBrickPoints];
    const Index3 first = this->firstPoint(brick);
    for (unsigned z = 0; z < kBrickSide; ++z)
    {
      const std::uint64_t crossed = brick.crossed[axis][z];
      for (unsigned n = 0; n < kBrickSide * kBrickSide && crossed >> n != 0; ++n)
      {
        if ((crossed >> n & 1u) == 0)
        {
          continue;
        }
        std::array<unsigned, 3> at{ n % kBrickSide, n / kBrickSide, z };
        CrossedEdge edge;
        edge.low = { first[0] + at[0], first[1] + at[1], first[2] + at[2] };
        edge.axis = axis;
        edge.lowInside = (brick.inside[z] >> n & 1u) != 0;
        edge.lowValue = values[pointOf(n, 0, z)];
        ++at[axis];
        edge.highValue = at[axis] < kBrickSide ? values[pointOf(at[0], at[1], at[2])]
                                               : this->valueBeyond(brick, axis, at);
        edges.push_back(edge);
      }
    }
  }

  /// Value at the first layer of the next brick along the axis, if that was sampled.
  float valueBeyond(const Brick& brick, unsigned axis, std::array<unsigned, 3> at) const
  {
    const BrickTree::Content content = brick.neighbours[1u << axis];
    at[axis] = 0;
    return content >= 0
      ? values_[static_cast<std::size_t>(content) * kBrickPoints + pointOf(at[0], at[1], at[2])]
      : std::numeric_limits<float>::quiet_NaN();
  }

  // Triangles.

  void makeTriangles()
  {
    this->forEachBrick(0, 0.9, 1.0,
      [&](const Brick& brick, std::size_t)
      {
        if (brick.triangleCount == 0)
        {
          return;
        }
        Triangle* triangle = &mesh_.triangles[brick.firstTriangle];
        std::uint32_t centre = brick.firstCentre;
        forEachCrossedCell(gatherSigns(brick.neighbours, bricks_),
          [&](const CrossedCell& cell)
          {
            if (const BrickFaces::Loops* loops = faces_.loopsOf(brick, cell))
            {
              for (const MarchingCubesTable::JoinedLoop& loop : *loops)
              {
                triangle = this->fillJoined(brick, loop, cell.at, centre, triangle);
              }
              return;
            }
            for (unsigned n = 0; n < cell.way.loopCount; ++n)
            {
              triangle = this->fillLoop(brick, cell.way.loops[n], cell.at, triangle);
            }
          });
      });
  }

  Triangle* fillLoop(const Brick& brick, const MarchingCubesTable::Loop& loop,
    const std::array<unsigned, 3>& cell, Triangle* triangle) const
  {
    std::array<std::int32_t, 7> vertices;
    for (unsigned n = 0; n < loop.size; ++n)
    {
      vertices[n] = this->vertexOn(brick, loop.edges[n], cell);
    }
    if (loop.size == 4)
    {
      return this->fillFour(vertices, triangle);
    }
    for (unsigned n = 0; n + 2 < loop.size; ++n)
    {
      const std::uint8_t* corner = &loop.triangles[3 * n];
      *triangle++ = { vertices[corner[0]], vertices[corner[1]], vertices[corner[2]] };
    }
    return triangle;
  }

  Triangle* fillJoined(const Brick& brick, const MarchingCubesTable::JoinedLoop& loop,
    const std::array<unsigned, 3>& cell, std::uint32_t& centre, Triangle* triangle)
  {
    std::vector<std::int32_t> vertices;
    for (const std::uint8_t edge : loop.edges)
    {
      vertices.push_back(this->vertexOn(brick, edge, cell));
    }
    for (std::size_t n = 0; n < loop.triangles.size(); n += 3)
    {
      const std::uint8_t* corner = &loop.triangles[n];
      *triangle++ = { vertices[corner[0]], vertices[corner[1]], vertices[corner[2]] };
    }
    if (loop.triangles.empty())
    {
      const auto middle = static_cast<std::int32_t>(centre++);
      const LoopCentre place = centreOf(mesh_, vertices, field_, lattice_.cellSize);
      mesh_.points[middle] = place.point;
      mesh_.normals[middle] = place.normal;
      for (std::size_t n = 0; n < vertices.size(); ++n)
      {
        *triangle++ = { vertices[n], vertices[(n + 1) % vertices.size()], middle };
      }
    }
    return triangle;
  }

  /// By the shorter diagonal.
  Triangle* fillFour(const std::array<std::int32_t, 7>& v, Triangle* triangle) const
  {
    const auto length = [&](unsigned a, unsigned b)
    { return (mesh_.points[v[a]] - mesh_.points[v[b]]).squaredNorm(); };
    const unsigned first = length(0, 2) <= length(1, 3) ? 0 : 1;
    *triangle++ = { v[first], v[first + 1], v[first + 2] };
    *triangle++ = { v[first], v[first + 2], v[(first + 3) % 4] };
    return triangle;
  }

  std::int32_t vertexOn(
    const Brick& brick, unsigned edge, const std::array<unsigned, 3>& cell) const
  {
    const unsigned corner = MarchingCubesTable::corners(edge)[0];
    std::array<unsigned, 3> at{ cell[0] + (corner & 1u), cell[1] + (corner >> 1 & 1u),
      cell[2] + (corner >> 2 & 1u) };
    unsigned neighbour = 0;
    for (unsigned axis = 0; axis < 3; ++axis)
    {
      neighbour |= (at[axis] / kBrickSide) << axis;
      at[axis] %= kBrickSide;
    }
    const BrickTree::Content content = brick.neighbours[neighbour];
    if (content < 0)
    {
      throw Error("The range of the field does not bound it: the surface crosses a brick that the "
                  "range excludes.");
    }
    const Brick& owner = bricks_[static_cast<std::size_t>(content)];
    return static_cast<std::int32_t>(
      owner.firstVertex + owner.vertexRank(edge / 4, at[0], at[1], at[2]));
  }

  /// Where the field gave no normal, the triangles do.
  void mendNormals()
  {
    std::vector<bool> missing(mesh_.normals.size());
    bool any = false;
    for (std::size_t k = 0; k < missing.size(); ++k)
    {
      missing[k] = mesh_.normals[k].isZero(0.0);
      any = any || missing[k];
    }
    for (std::size_t t = 0; any && t < mesh_.triangles.size(); ++t)
    {
      for (const std::int32_t corner : mesh_.triangles[t])
      {
        if (missing[corner])
        {
          mesh_.normals[corner] += areaNormal(mesh_, t);
        }
      }
    }
    for (std::size_t k = 0; any && k < missing.size(); ++k)
    {
      if (missing[k])
      {
        const double length = mesh_.normals[k].norm();
        mesh_.normals[k] = length > 0.0 ? Vec3(mesh_.normals[k] / length) : Vec3::UnitZ();
      }
    }
  }

  const FieldSource& field_;
  const Lattice lattice_;
  const MemoryBudget budget_;
  const Progress& progress_;
  BrickTree tree_;
  std::vector<Brick> bricks_;
  std::vector<float> values_; ///< f - T at the points of each brick, only to start searches from
  BrickFaces faces_;
  TriangleMesh mesh_;
};

} // namespace

TriangleMesh polygonize(const FieldSource& field, const Box3& bounds,
  const PolygonizeOptions& options, const Progress& progress)
{
  if (bounds.isEmpty())
  {
    return {};
  }
  const Lattice lattice = Lattice::covering(bounds, options.cellSize, options.origin);
  return Polygonizer(field, lattice, { options.maxBytes, options.cellSize }, progress).run();
}

} // namespace hybridtree
