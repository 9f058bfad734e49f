// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace hybridtree
{

/// Where a piece of the skeleton is (BlendPieces.h).
struct PiecePlace
{
  Vec3 center;
  double reach; ///< R there
  bool isTriangle;
};

/// A piece at a point of the skeleton. Pieces at points of one number are joined.
struct PieceContact
{
  std::int32_t point;
  std::uint32_t piece;
  Vec3 place;
};

/// A piece along a part of an edge of the skeleton, a < b being the ends of that. Pieces along
/// overlapping parts are joined, however either side is divided.
struct PieceSide
{
  std::int32_t a, b;
  double from, to; ///< in [0, 1], from a
  std::uint32_t piece;
};

/// The pieces of a skeleton, joined center to center, and how far they are from each other along
/// it, a length counting in units of R there.
///
/// Through sheets the way goes straight from center to center where that is at most a quarter
/// longer over what they share: over edges and around corners. Ways over many pieces of a sheet are
/// a little longer than straight ones, which is made up for, down to the straight line at least.
/// Distances are these ways less what two full pieces extend: at most 2 where both reach one point
/// of a straight limb or a plate.
class PieceGraph
{
public:
  ///@{
  /// Longest pieces, of segments and between corners of triangles, in units of R.
  static constexpr double kPieceLength = 0.65;
  static constexpr double kPieceSide = 1.25;
  ///@}

  PieceGraph(std::vector<PiecePlace> places, std::vector<PieceContact> contacts,
    std::vector<PieceSide> sides, const std::vector<Vec3>& points);

  std::size_t size() const { return places_.size(); }

  /// Searches from one piece after another.
  class Search
  {
  public:
    explicit Search(const PieceGraph& graph);

    /// Finds all pieces within the distance.
    void run(std::uint32_t from, double distance);
    /// Those that were found, in no order.
    const std::vector<std::uint32_t>& found() const { return touched_; }
    /// Infinite for what was not found, and little more than the distance or less otherwise.
    double distance(std::uint32_t to) const;

  private:
    void reach(std::uint32_t piece, double way);

    using Entry = std::pair<double, std::uint32_t>;
    const PieceGraph& graph_;
    std::uint32_t from_ = 0;
    std::vector<double> ways_;
    std::vector<std::uint32_t> touched_;
    std::vector<Entry> queue_;
  };

private:
  struct Way
  {
    std::uint32_t to;
    double length;
  };
  struct Link
  {
    std::uint32_t a, b;
    double length;
  };

  double straight(std::uint32_t a, std::uint32_t b) const;
  double over(std::uint32_t a, std::uint32_t b, const Vec3& place) const;
  void joinContacts(std::vector<PieceContact>& contacts);
  void joinSides(std::vector<PieceSide>& sides, const std::vector<Vec3>& points);
  void addLink(std::uint32_t a, std::uint32_t b, double length);
  void sortLinks();
  double extent(std::uint32_t piece) const;

  std::vector<PiecePlace> places_;
  std::size_t nodeCount_; // pieces, and points where many meet
  std::vector<Link> links_;
  std::vector<std::uint32_t> begin_; // per node: its first way
  std::vector<Way> ways_;
};

} // namespace hybridtree
