// SPDX-License-Identifier: BSD-3-Clause
#include "core/subdivision/PieceCells.h"

#include "core/base/Dependency.h"

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

  Owner& at(const Index3& cell)
  {
    const Index3 brick = brickOf(cell);
    if (bricks_.empty() || brick != bricks_[last_].index)
    {
      const auto [found, isNew] = places_.try_emplace(brick, bricks_.size());
      if (isNew)
      {
        bricks_.push_back({ brick, {} });
      }
      last_ = found->second;
    }
    const auto place = [&](int axis) { return std::size_t(cell[axis] - kBrickSide * brick[axis]); };
    return bricks_[last_].owners[(place(2) * kBrickSide + place(1)) * kBrickSide + place(0)];
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

  std::size_t last_ = 0;
  std::vector<OwnedBrick> bricks_;
  std::unordered_map<Index3, std::size_t, Index3Hash> places_;
};

template <typename Visit>
void visitCells(Box3 box, const CellGrid& grid, Visit&& visit)
{
  box.min().array() -= kMargin * grid.cellSize;
  box.max().array() += kMargin * grid.cellSize;
  const Index3 low = grid.cellAt(box.min());
  const Index3 high = grid.cellAt(box.max());
  for (std::int64_t z = low[2]; z <= high[2]; ++z)
  {
    for (std::int64_t y = low[1]; y <= high[1]; ++y)
    {
      for (std::int64_t x = low[0]; x <= high[0]; ++x)
      {
        visit(Index3{ x, y, z });
      }
    }
  }
}

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

} // namespace

PieceCells findPieceCells(
  const PieceMesh& piece, const PlacedField& field, double tolerance, const CellGrid& grid)
{
  std::vector<PlacedPoint> centers;
  centers.reserve(piece.triangles.size());
  for (const auto& [a, b, c] : piece.triangles)
  {
    centers.push_back(
      { (piece.points[a] + piece.points[b] + piece.points[c]) / 3.0, piece.elements[a] });
  }
  const std::vector<double> values = fieldAt(field, centers);
  const auto baseOf = [&](std::size_t t)
  {
    const auto& [a, b, c] = piece.triangles[t];
    return Vec3((piece.bases[a] + piece.bases[b] + piece.bases[c]) / 3.0);
  };
  CellOwners owners;
  for (std::size_t t = 0; t < piece.triangles.size(); ++t)
  {
    const auto& [a, b, c] = piece.triangles[t];
    const bool isSettled = piece.onSurface[a] && piece.onSurface[b] && piece.onSurface[c] &&
      std::abs(values[t] - kThreshold) <= tolerance;
    Box3 box(piece.points[a]);
    box.extend(piece.points[b]);
    box.extend(piece.points[c]);
    const Vec3 base = baseOf(t);
    // Neighbours around a limb share their base; beyond its thickness begins another part.
    const double apart = 2.0 * (centers[t].at - base).norm() + 2.0 * grid.cellSize;
    visitCells(box, grid,
      [&](const Index3& cell)
      {
        CellOwners::Owner& owner = owners.at(cell);
        const bool isNew = owner.triangle == CellOwners::kNone;
        owner.triangle = isNew ? std::int32_t(t) : owner.triangle;
        owner.isSettled = owner.isSettled && isSettled &&
          (isNew || (baseOf(std::size_t(owner.triangle)) - base).norm() < apart);
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
