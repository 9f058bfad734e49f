// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/PatchVertices.h"

#include "core/base/Parallel.h"
#include "core/polygonize/EdgeRoots.h"

#include <cmath>
#include <limits>

namespace hybridtree
{
namespace
{

class PatchVertexMaker
{
public:
  PatchVertexMaker(PatchBricks& bricks, const Lattice& lattice, std::int32_t first, Patch& patch,
    const Progress& progress)
    : bricks_(bricks), lattice_(lattice), first_(first), patch_(patch), progress_(progress)
  {
  }

  void run()
  {
    this->countVertices();
    this->makeVertices();
    this->collectUnsettled();
  }

private:
  template <class Body>
  void forEachBrick(Body&& body)
  {
    parallelFor(bricks_.all().size(), 1,
      [&](std::size_t from, std::size_t to)
      {
        progress_.check();
        for (std::size_t k = from; k < to; ++k)
        {
          body(bricks_.all()[k], k);
        }
      });
  }

  void countVertices()
  {
    this->forEachBrick([&](PatchBrick& brick, std::size_t) { brick.countVertices(); });
    std::int64_t count = first_;
    for (PatchBrick& brick : bricks_.all())
    {
      brick.firstVertex = static_cast<std::int32_t>(count);
      count += brick.vertexCount;
    }
    patch_.points.resize(static_cast<std::size_t>(count - first_));
    patch_.normals.resize(patch_.points.size());
  }

  void makeVertices()
  {
    overruled_.resize(bricks_.runs().size());
    parallelFor(overruled_.size(), 1,
      [&](std::size_t begin, std::size_t end)
      {
        progress_.check();
        for (std::size_t k = begin; k < end; ++k)
        {
          this->makeVertices(bricks_.runs()[k], overruled_[k]);
        }
      });
  }

  /// Their vertices follow one another.
  void makeVertices(const PatchBricks::Run& run, std::vector<std::int32_t>& overruled)
  {
    std::vector<CrossedEdge> edges;
    const std::int32_t firstVertex = bricks_.all()[run.begin].firstVertex;
    FieldSourcePtr source;
    for (std::size_t k = run.begin; k < run.end; ++k)
    {
      source = source ? source : bricks_.all()[k].source;
      this->addEdges(bricks_.all()[k], edges);
    }
    for (std::size_t k = 0; k < edges.size(); ++k)
    {
      if (PatchVertexMaker::isOverruled(edges[k]))
      {
        overruled.push_back(firstVertex + static_cast<std::int32_t>(k));
      }
    }
    const std::int32_t first = firstVertex - first_;
    if (!source)
    {
      this->placeWithoutField(edges, first);
    }
    else if (!edges.empty())
    {
      findSurface(*source, lattice_, edges, &patch_.points[first], &patch_.normals[first]);
    }
  }

  void addEdges(const PatchBrick& brick, std::vector<CrossedEdge>& edges)
  {
    for (unsigned axis = 0; axis < 3; ++axis)
    {
      for (int z = 0; z < kBrickSide; ++z)
      {
        for (std::uint64_t word = brick.crossed[axis][z]; word != 0; word &= word - 1)
        {
          const int n = CellSet::lowestBit(word);
          edges.push_back(this->edgeAt(brick, axis, n % kBrickSide, n / kBrickSide, z));
        }
      }
    }
  }

  void collectUnsettled()
  {
    for (std::size_t k = 0; k < overruled_.size(); ++k)
    {
      patch_.unsettled.insert(patch_.unsettled.end(), overruled_[k].begin(), overruled_[k].end());
    }
  }

  /// The border has overruled a sample: the surface does not cross the edge, or not once.
  static bool isOverruled(const CrossedEdge& edge)
  {
    const auto disagrees = [](bool inside, float value)
    { return !std::isnan(value) && inside != hybridtree::isInside(value); };
    return disagrees(edge.lowInside, edge.lowValue) || disagrees(!edge.lowInside, edge.highValue);
  }

  CrossedEdge edgeAt(const PatchBrick& brick, unsigned axis, int x, int y, int z)
  {
    CrossedEdge edge;
    edge.low = { kBrickSide * brick.index[0] + x, kBrickSide * brick.index[1] + y,
      kBrickSide * brick.index[2] + z };
    edge.axis = axis;
    edge.lowInside = PatchBrick::has(brick.inside, x, y, z);
    edge.lowValue = this->valueAt(bricks_.locate(brick, x, y, z));
    edge.highValue =
      this->valueAt(bricks_.locate(brick, x + (axis == 0), y + (axis == 1), z + (axis == 2)));
    return edge;
  }

  float valueAt(const PatchBricks::Place& place) const
  {
    const bool known = place.brick && !place.brick->values.empty();
    return known ? place.brick->values[(place.z * kBrickSide + place.y) * kBrickSide + place.x]
                 : std::numeric_limits<float>::quiet_NaN();
  }

  /// The line from outside claims a surface where the field is 0.
  void placeWithoutField(const std::vector<CrossedEdge>& edges, std::int32_t first)
  {
    for (std::size_t k = 0; k < edges.size(); ++k)
    {
      Vec3 point = lattice_.point(edges[k].low);
      point[edges[k].axis] += 0.5 * lattice_.cellSize;
      patch_.points[first + k] = point;
      patch_.normals[first + k] = Vec3::Zero();
    }
  }

  PatchBricks& bricks_;
  const Lattice& lattice_;
  const std::int32_t first_;
  Patch& patch_;
  const Progress& progress_;
  std::vector<std::vector<std::int32_t>> overruled_; ///< per run: vertices off the surface
};

} // namespace

void makePatchVertices(PatchBricks& bricks, const Lattice& lattice, std::int32_t first,
  Patch& patch, const Progress& progress)
{
  PatchVertexMaker(bricks, lattice, first, patch, progress).run();
}

} // namespace hybridtree
