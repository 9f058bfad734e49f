// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/KeptMesh.h"

#include "core/base/Parallel.h"
#include "core/mesh/MeshChecks.h"
#include "core/mesh/PerMesh.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

constexpr std::int64_t kMostBlocks = 1 << 21;
constexpr std::int64_t kLarge = 64; // blocks of a triangle
constexpr std::size_t kGrain = 16384;
constexpr double kSlack = 1e-6; // blocks, for rounding

std::int64_t floorDivided(std::int64_t a, std::int64_t b)
{
  return a >= 0 ? a / b : ~(~a / b);
}

} // namespace

/// Those that a box touches.
struct TriangleBricks::Blocks
{
  Index3 from{};
  Index3 to{};

  std::int64_t count() const
  {
    return (to[0] - from[0] + 1) * (to[1] - from[1] + 1) * (to[2] - from[2] + 1);
  }

  template <typename Visit>
  void forEach(Visit&& visit) const
  {
    Index3 block{};
    for (block[2] = from[2]; block[2] <= to[2]; ++block[2])
    {
      for (block[1] = from[1]; block[1] <= to[1]; ++block[1])
      {
        for (block[0] = from[0]; block[0] <= to[0]; ++block[0])
        {
          visit(block);
        }
      }
    }
  }
};

TriangleBricks::TriangleBricks(const TriangleMesh& mesh, const CellGrid& grid) : grid_(grid)
{
  const Box3 bounds = mesh.bounds();
  if (mesh.triangles.empty() || bounds.isEmpty())
  {
    begin_.assign(1, 0);
    return;
  }
  for (;; bricksPerBlock_ *= 2)
  {
    first_ = this->blockAt(bounds.min(), -kSlack);
    const Index3 last = this->blockAt(bounds.max(), kSlack);
    double count = 1.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      size_[axis] = last[axis] - first_[axis] + 1;
      count *= static_cast<double>(size_[axis]);
    }
    if (count <= static_cast<double>(kMostBlocks))
    {
      break;
    }
  }
  const std::vector<Blocks> blocks = this->blocksOf(mesh);
  begin_.assign(static_cast<std::size_t>(size_[0] * size_[1] * size_[2]) + 1, 0);
  for (const Blocks& own : blocks)
  {
    if (own.count() <= kLarge)
    {
      own.forEach([&](const Index3& block) { ++begin_[this->number(block) + 1]; });
    }
  }
  for (std::size_t k = 1; k < begin_.size(); ++k)
  {
    begin_[k] += begin_[k - 1];
  }
  triangles_.resize(static_cast<std::size_t>(begin_.back()));
  std::vector<std::int32_t> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t t = 0; t < blocks.size(); ++t)
  {
    const auto number = static_cast<std::int32_t>(t);
    if (blocks[t].count() > kLarge)
    {
      large_.push_back(number);
      continue;
    }
    blocks[t].forEach(
      [&](const Index3& block) { triangles_[next[this->number(block)]++] = number; });
  }
}

std::vector<TriangleBricks::Blocks> TriangleBricks::blocksOf(const TriangleMesh& mesh) const
{
  std::vector<Blocks> ofPoints(mesh.points.size());
  parallelFor(mesh.points.size(), kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t v = begin; v < end; ++v)
      {
        ofPoints[v] = { this->blockAt(mesh.points[v], -kSlack),
          this->blockAt(mesh.points[v], kSlack) };
      }
    });
  std::vector<Blocks> blocks(mesh.triangles.size());
  parallelFor(mesh.triangles.size(), kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t t = begin; t < end; ++t)
      {
        blocks[t] = ofPoints[mesh.triangles[t][0]];
        for (int k = 1; k < 3; ++k)
        {
          const Blocks& corner = ofPoints[mesh.triangles[t][k]];
          for (int axis = 0; axis < 3; ++axis)
          {
            blocks[t].from[axis] = std::min(blocks[t].from[axis], corner.from[axis]);
            blocks[t].to[axis] = std::max(blocks[t].to[axis], corner.to[axis]);
          }
        }
      }
    });
  return blocks;
}

Index3 TriangleBricks::blockAt(const Vec3& point, double slack) const
{
  const double scale = 1.0 / (static_cast<double>(kBrickSide * bricksPerBlock_) * grid_.cellSize);
  Index3 block{};
  for (int axis = 0; axis < 3; ++axis)
  {
    block[axis] = roundedDown((point[axis] - grid_.origin[axis]) * scale + slack);
  }
  return block;
}

Index3 TriangleBricks::blockOf(const Index3& brick) const
{
  return { floorDivided(brick[0], bricksPerBlock_), floorDivided(brick[1], bricksPerBlock_),
    floorDivided(brick[2], bricksPerBlock_) };
}

std::int64_t TriangleBricks::number(const Index3& block) const
{
  return ((block[2] - first_[2]) * size_[1] + block[1] - first_[1]) * size_[0] + block[0] -
    first_[0];
}

std::vector<std::int32_t> TriangleBricks::inBlocks(std::vector<Index3> bricks) const
{
  for (Index3& brick : bricks)
  {
    brick = this->blockOf(brick);
  }
  std::sort(bricks.begin(), bricks.end());
  bricks.erase(std::unique(bricks.begin(), bricks.end()), bricks.end());
  std::vector<std::int32_t> result = large_;
  for (const Index3& block : bricks)
  {
    bool within = true;
    for (int axis = 0; axis < 3; ++axis)
    {
      within = within && block[axis] >= first_[axis] && block[axis] < first_[axis] + size_[axis];
    }
    if (within)
    {
      const std::int64_t k = this->number(block);
      result.insert(
        result.end(), triangles_.begin() + begin_[k], triangles_.begin() + begin_[k + 1]);
    }
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

std::vector<std::int32_t> TriangleBricks::near(const CellSet& cells) const
{
  std::vector<Index3> bricks;
  for (const CellSet::Brick& brick : cells.bricks())
  {
    bricks.push_back(brick.index);
  }
  return this->inBlocks(std::move(bricks));
}

std::vector<std::int32_t> TriangleBricks::near(const std::vector<Vec3>& points) const
{
  std::vector<Index3> bricks;
  for (const Vec3& point : points)
  {
    bricks.push_back(brickOf(grid_.cellAt(point)));
  }
  return this->inBlocks(std::move(bricks));
}

std::shared_ptr<const KeptMesh> KeptMesh::of(const MeshPtr& mesh)
{
  static PerMesh<KeptMesh> known;
  return known.of(
    mesh, [](const TriangleMesh& object) { return std::make_shared<const KeptMesh>(object); });
}

bool KeptMesh::isSound() const
{
  std::call_once(soundOnce_,
    [&] { sound_ = mesh_.normals.size() == mesh_.points.size() && isClosedManifold(mesh_); });
  return sound_;
}

double KeptMesh::area() const
{
  std::call_once(areaOnce_,
    [&]
    {
      for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      {
        area_ += 0.5 * areaNormal(mesh_, t).norm();
      }
    });
  return area_;
}

Box3 KeptMesh::bounds() const
{
  std::call_once(boundsOnce_, [&] { bounds_ = mesh_.bounds(); });
  return bounds_;
}

const std::vector<std::int32_t>& KeptMesh::valence() const
{
  std::call_once(valenceOnce_,
    [&]
    {
      valence_.assign(mesh_.points.size(), 0);
      for (const Triangle& triangle : mesh_.triangles)
      {
        for (const std::int32_t v : triangle)
        {
          ++valence_[v];
        }
      }
    });
  return valence_;
}

std::shared_ptr<const TriangleBricks> KeptMesh::bricks(const CellGrid& grid) const
{
  // Islands ask for it all at once: the others wait for the first.
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!bricks_ || !(bricks_->grid() == grid))
  {
    bricks_ = std::make_shared<const TriangleBricks>(mesh_, grid);
  }
  return bricks_;
}

} // namespace hybridtree
