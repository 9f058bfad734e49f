// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/polygonize/FieldSource.h"
#include "core/stitch/CellSet.h"

namespace hybridtree
{

/// What is known of the lattice points, edges and cells of one brick that belong to marked cells.
struct PatchBrick
{
  Index3 index{};
  BrickBits cells{};  ///< marked
  BrickBits points{}; ///< corners of marked cells, which may be those of other bricks
  BrickBits border{}; ///< of these, those that are also corners of cells that are not marked
  BrickBits inside{}; ///< sides of the points
  BrickBits busy{};   ///< cells that the line from outside touches
  std::array<BrickBits, 3> edges{};   ///< [axis]: from a point, an edge of a marked cell
  std::array<BrickBits, 3> inner{};   ///< of these, those all of whose four cells are marked
  std::array<BrickBits, 3> joined{};  ///< [axis]: the ambiguous face from a point, across the axis,
                                      ///< has its inside corners joined (AmbiguousFaces.h)
  std::array<BrickBits, 3> crossed{}; ///< of the inner ones, those that have a vertex
  BrickBits mixed{};                  ///< marked cells with corners on both sides
  std::array<std::int32_t, 27>
    near{};                  ///< number of the brick at offset (n % 3, n / 3 % 3, n / 9) - 1
  BrickBits known{};         ///< points at which the field was asked
  std::vector<float> values; ///< f - T at these
  FieldSourcePtr source;     ///< of its run: valid in the closed box of the brick's cells
  std::array<std::array<std::uint16_t, kBrickSide>, 3> rank{};
  std::int32_t firstVertex = 0;
  std::int32_t vertexCount = 0;

  static bool has(const BrickBits& bits, int x, int y, int z)
  {
    return (bits[z] >> (kBrickSide * y + x) & 1u) != 0;
  }
  /// Those of the 8 corners of a cell that are set, as the case of marching cubes has them. \pre x,
  /// y and z are less than 7.
  static unsigned corners(const BrickBits& bits, int x, int y, int z)
  {
    const auto square = [=](std::uint64_t word)
    {
      word >>= kBrickSide * y + x;
      return static_cast<unsigned>(word & 3u) |
        static_cast<unsigned>(word >> (kBrickSide - 2) & 12u);
    };
    return square(bits[z]) | square(bits[z + 1]) << 4;
  }
  /// Calls body(cell), with its place in the brick, for the cells that are set.
  template <class Body>
  static void forEachCell(const BrickBits& bits, Body&& body)
  {
    for (int z = 0; z < kBrickSide; ++z)
    {
      for (std::uint64_t word = bits[z]; word != 0; word &= word - 1)
      {
        const int n = CellSet::lowestBit(word);
        body(std::array<int, 3>{ n % kBrickSide, n / kBrickSide, z });
      }
    }
  }
  /// Number of the vertex on a crossed edge.
  std::int32_t vertexOn(unsigned axis, int x, int y, int z) const;
  void countVertices();
};

/// All bricks with corners of marked cells, sorted, and the field at corners that were asked for.
///
/// More than half of the corners are on the border of a thin layer of cells. The sides of these are
/// told by the line from outside (BorderSigns.h), and few have a vertex beside them.
class PatchBricks
{
public:
  /// Asks the field at all points that are not on the border, run by run in parallel. field and
  /// lattice must live as long as this.
  PatchBricks(const FieldSource& field, const CellSet& cells, const Lattice& lattice,
    const Progress& progress);

  /// Asks the field at points of each brick, where it was not asked yet. \param tellSides whether
  /// these are on the side that it says.
  void ask(const std::vector<BrickBits>& points, bool tellSides, const Progress& progress);
  /// Where vertices come to be, once findCrossed() has told. The sides stay.
  void askAtCrossed(const Progress& progress);

  std::vector<PatchBrick>& all() { return bricks_; }
  const std::vector<PatchBrick>& all() const { return bricks_; }

  /// Bricks [begin, end) that follow one another and lie together. They share their source, and are
  /// asked for at once: bricks at the border of the marks have a few points each.
  struct Run
  {
    std::size_t begin = 0;
    std::size_t end = 0;
  };
  const std::vector<Run>& runs() const { return runs_; }

  /// A lattice point or cell, by its brick and its place in it. brick is null where there is none.
  struct Place
  {
    PatchBrick* brick = nullptr;
    int x = 0, y = 0, z = 0;
  };
  /// \param x, y, z relative to a brick, from -8 to 15.
  Place locate(const PatchBrick& brick, int x, int y, int z)
  {
    const auto past = [](int place) { return static_cast<unsigned>(place + kBrickSide); };
    const unsigned n =
      past(x) / kBrickSide + 3 * (past(y) / kBrickSide) + 9 * (past(z) / kBrickSide);
    const auto within = [&](int place) { return static_cast<int>(past(place) % kBrickSide); };
    const std::int32_t near = brick.near[n];
    return { near < 0 ? nullptr : &bricks_[near], within(x), within(y), within(z) };
  }
  Place locate(const Index3& index);
  /// The side of a lattice point; outside where it is no corner of a marked cell.
  bool isInside(const PatchBrick& brick, int x, int y, int z);
  ///@{
  /// \param cell as x, y, z of locate().
  bool isMarked(const PatchBrick& brick, const std::array<int, 3>& cell);
  unsigned caseOf(const PatchBrick& brick, const std::array<int, 3>& cell); ///< of marching cubes
  ///@}

  /// Fills in which inner edges of a brick are crossed and which cells are mixed, once the sides of
  /// all points are known.
  void findCrossed(PatchBrick& brick) const;

private:
  void addBricks(const CellSet& cells);
  void findBits(PatchBrick& brick) const;
  std::uint64_t sides(const PatchBrick& brick, int dx, int dy, int z) const;
  void findRuns();
  template <class Body>
  void forEachRun(const Progress& progress, Body&& body);
  void narrow(const Run& run);
  void ask(const Run& run, const std::vector<BrickBits>& points, bool tellSides);

  const FieldSource& field_;
  const Lattice& lattice_;
  std::vector<PatchBrick> bricks_;
  std::vector<Run> runs_;
  std::unordered_map<Index3, std::int32_t, Index3Hash> index_;
};

} // namespace hybridtree
