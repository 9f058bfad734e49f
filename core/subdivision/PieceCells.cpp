// SPDX-License-Identifier: BSD-3-Clause
#include "core/subdivision/PieceCells.h"

#include "core/base/Dependency.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hybridtree
{
namespace
{

constexpr std::size_t kRememberedBytes = std::size_t(64) << 20;
constexpr double kMargin = 0.25; // around triangles, in cells: more than pieces differ by

/// The first triangle that came into each cell, in bricks, and which cells are unsettled.
class CellOwners
{
public:
  static constexpr std::int32_t kNone = -1;

  struct Owner
  {
    std::int32_t triangle = kNone;
    bool isSettled = true;
  };

  /// body(owner) for the cells from one to another.
  template <typename Body>
  void visit(const Index3& low, const Index3& high, Body&& body)
  {
    const Index3 first = brickOf(low);
    const Index3 last = brickOf(high);
    for (std::int64_t z = first[2]; z <= last[2]; ++z)
    {
      for (std::int64_t y = first[1]; y <= last[1]; ++y)
      {
        for (std::int64_t x = first[0]; x <= last[0]; ++x)
        {
          this->visitBrick({ x, y, z }, low, high, body);
        }
      }
    }
  }

  PieceCells cells() const
  {
    PieceCells cells;
    for (const OwnedBrick& brick : bricks_)
    {
      CellSet::Brick all{ brick.index, {} };
      CellSet::Brick unsettled{ brick.index, {} };
      for (std::size_t k = 0; k < brick.owners.size(); ++k)
      {
        constexpr std::size_t kLayer = kBrickSide * kBrickSide;
        const std::uint64_t bit = std::uint64_t(1) << k % kLayer;
        all.bits[k / kLayer] |= brick.owners[k].triangle != kNone ? bit : 0;
        unsettled.bits[k / kLayer] |= brick.owners[k].isSettled ? 0 : bit;
      }
      cells.all.insertBrick(all);
      if (unsettled.size() > 0)
      {
        cells.unsettled.insertBrick(unsettled);
      }
    }
    return cells;
  }

private:
  struct OwnedBrick
  {
    Index3 index;
    std::array<Owner, kBrickPoints> owners;
  };

  OwnedBrick& brick(const Index3& index)
  {
    if (bricks_.empty() || index != bricks_[last_].index)
    {
      const auto [found, isNew] = places_.try_emplace(index, bricks_.size());
      if (isNew)
      {
        bricks_.push_back({ index, {} });
      }
      last_ = found->second;
    }
    return bricks_[last_];
  }

  /// Those of the cells that are in one brick.
  template <typename Body>
  void visitBrick(const Index3& index, const Index3& low, const Index3& high, Body&& body)
  {
    OwnedBrick& of = this->brick(index);
    std::array<std::size_t, 3> begin, end;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const std::int64_t first = kBrickSide * index[axis];
      begin[axis] = std::size_t(std::max(low[axis] - first, std::int64_t(0)));
      end[axis] = std::size_t(std::min(high[axis] - first + 1, std::int64_t(kBrickSide)));
    }
    for (std::size_t z = begin[2]; z < end[2]; ++z)
    {
      for (std::size_t y = begin[1]; y < end[1]; ++y)
      {
        for (std::size_t x = begin[0]; x < end[0]; ++x)
        {
          body(of.owners[(z * kBrickSide + y) * kBrickSide + x]);
        }
      }
    }
  }

  std::size_t last_ = 0;
  std::vector<OwnedBrick> bricks_;
  std::unordered_map<Index3, std::size_t, Index3Hash> places_;
};

struct CellsKey
{
  Dependency piece;
  CellGrid grid;
  double tolerance;

  std::uint64_t hash() const
  {
    HashSum sum;
    piece.addTo(sum);
    return sum.value();
  }
  bool operator==(const CellsKey& other) const
  {
    return piece == other.piece && grid == other.grid && tolerance == other.tolerance;
  }
  bool isExpired() const { return piece.isExpired(); }
};

RecentStore<CellsKey, PieceCells>& store()
{
  static auto* const instance = // outlives all statics
    new RecentStore<CellsKey, PieceCells>(kRememberedBytes);
  return *instance;
}

/// Triangles whose corners are on the surface, and nearly their centers.
std::vector<char> settledTriangles(const PieceMesh& piece, const std::vector<Vec3>& centers,
  const PlacedField& field, double tolerance)
{
  std::vector<char> settled(piece.triangles.size(), 0);
  std::vector<std::size_t> triangles; // those to ask for
  std::vector<PlacedPoint> asked;
  for (std::size_t t = 0; t < piece.triangles.size(); ++t)
  {
    const auto& [a, b, c] = piece.triangles[t];
    if (piece.onSurface[a] && piece.onSurface[b] && piece.onSurface[c])
    {
      triangles.push_back(t);
      asked.push_back({ centers[t], piece.elements[a] });
    }
  }
  const std::vector<double> values = fieldAt(field, asked);
  for (std::size_t k = 0; k < triangles.size(); ++k)
  {
    settled[triangles[k]] = std::abs(values[k] - kThreshold) <= tolerance ? 1 : 0;
  }
  return settled;
}

} // namespace

PieceCells findPieceCells(
  const PieceMesh& piece, const PlacedField& field, double tolerance, const CellGrid& grid)
{
  std::vector<Vec3> centers;
  centers.reserve(piece.triangles.size());
  for (const auto& [a, b, c] : piece.triangles)
  {
    centers.push_back((piece.points[a] + piece.points[b] + piece.points[c]) / 3.0);
  }
  const std::vector<char> settled = settledTriangles(piece, centers, field, tolerance);
  std::vector<Vec3> bases;
  bases.reserve(piece.triangles.size());
  for (const auto& [a, b, c] : piece.triangles)
  {
    bases.push_back((piece.bases[a] + piece.bases[b] + piece.bases[c]) / 3.0);
  }
  const Vec3 margin = Vec3::Constant(kMargin * grid.cellSize);
  CellOwners owners;
  for (std::size_t t = 0; t < piece.triangles.size(); ++t)
  {
    const auto& [a, b, c] = piece.triangles[t];
    const bool isSettled = settled[t] != 0;
    Box3 box(piece.points[a]);
    box.extend(piece.points[b]);
    box.extend(piece.points[c]);
    // Neighbours around a limb share their base; beyond its thickness begins another part.
    const double apart = 2.0 * (centers[t] - bases[t]).norm() + 2.0 * grid.cellSize;
    owners.visit(grid.cellAt(box.min() - margin), grid.cellAt(box.max() + margin),
      [&](CellOwners::Owner& owner)
      {
        const bool isNew = owner.triangle == CellOwners::kNone;
        owner.triangle = isNew ? std::int32_t(t) : owner.triangle;
        owner.isSettled = owner.isSettled && isSettled &&
          (isNew || (bases[std::size_t(owner.triangle)] - bases[t]).squaredNorm() < apart * apart);
      });
  }
  return owners.cells();
}

std::shared_ptr<const PieceCells> pieceCells(const std::shared_ptr<const PieceMesh>& piece,
  const PlacedField& field, double tolerance, const CellGrid& grid)
{
  const CellsKey key{ Dependency(piece, 0.0, 0), grid, tolerance };
  if (auto known = store().find(key))
  {
    return known;
  }
  auto made = std::make_shared<const PieceCells>(findPieceCells(*piece, field, tolerance, grid));
  constexpr std::size_t kBytesPerBrick = 2 * sizeof(CellSet::Brick); // with the index
  store().keep(key, made,
    (made->all.bricks().size() + made->unsettled.bricks().size()) * kBytesPerBrick +
      sizeof(PieceCells));
  return made;
}

} // namespace hybridtree
