// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/CutMesh.h"

#include "core/stitch/CutPlanes.h"
#include "core/stitch/FillPolygon.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

constexpr std::int8_t kNoPlane = -1;

/// A plane of the lattice; of no axis: no plane, but the side of the triangle with this number.
struct Plane
{
  std::int8_t axis = kNoPlane;
  std::int64_t index = 0;
};

/// Corner of a piece of a triangle, and the plane in which the side from it to the next one lies.
struct Corner
{
  std::int32_t vertex;
  Plane side;
};
using Piece = std::vector<Corner>;

struct CutKey
{
  std::int32_t a;
  std::int32_t b;
  std::int64_t plane;
  int axis;

  bool operator==(const CutKey& other) const
  {
    return a == other.a && b == other.b && plane == other.plane && axis == other.axis;
  }
};

struct CutKeyHash
{
  std::size_t operator()(const CutKey& key) const
  {
    return Index3Hash()({ key.a, key.b, 4 * key.plane + key.axis });
  }
};

class Cutter
{
public:
  Cutter(const TriangleMesh& mesh, const CellSet& cells, const CellGrid& grid)
    : mesh_(mesh)
    , cells_(cells)
    , grid_(grid)
    , points_(static_cast<std::int32_t>(mesh.points.size()))
    , planes_(cells, grid)
  {
    low_ = cells.low();
    high_ = cells.high();
    bounds_ = grid.boxOf(low_, 0.0, 1.0);
    bounds_.extend(grid.boxOf(high_, 0.0, 2.0));
  }

  CutMesh run(const std::vector<std::int32_t>& candidates, const Progress& progress)
  {
    std::size_t count = 0;
    for (const std::int32_t t : candidates)
    {
      const CellSet::Share share = this->shareOf(t);
      if (share == CellSet::Share::All)
      {
        result_.gone.push_back(t);
      }
      else if (share == CellSet::Share::Some)
      {
        if (++count % 256 == 0)
        {
          progress.check();
        }
        this->cutTriangle(t);
      }
    }
    return std::move(result_);
  }

private:
  /// A vertex of a piece beyond those of the mesh.
  struct Made
  {
    bool onEdge = false; ///< on a side of a triangle: its neighbour has it too
    BorderCrossing crossing;
    bool isCrossing = false; ///< on an edge of the lattice
    bool used = false;
    std::int32_t number = -1;
  };

  /// A side of a piece.
  struct Side
  {
    std::int32_t from;
    std::int32_t to;
    Plane plane;
    bool outside;
    Index3 cell;

    std::pair<std::int32_t, std::int32_t> ends() const { return std::minmax(from, to); }
  };

  const Vec3& point(std::int32_t v) const
  {
    return v < points_ ? mesh_.points[v] : positions_[v - points_];
  }

  std::int64_t slab(std::int32_t v, int axis) const
  {
    // Nothing changes beyond the cells.
    return std::clamp(grid_.slab(axis, this->point(v)[axis]), low_[axis] - 1, high_[axis] + 1);
  }

  /// How many of the cells that a triangle's box touches are in the set.
  CellSet::Share shareOf(std::int32_t t) const
  {
    const Triangle& c = mesh_.triangles[t];
    const Vec3& a = mesh_.points[c[0]];
    const Vec3& b = mesh_.points[c[1]];
    const Vec3& d = mesh_.points[c[2]];
    const Box3 box(Vec3(a.cwiseMin(b).cwiseMin(d)), Vec3(a.cwiseMax(b).cwiseMax(d)));
    if (!box.intersects(bounds_))
    {
      return CellSet::Share::None;
    }
    Index3 from{}, to{};
    for (int axis = 0; axis < 3; ++axis)
    {
      from[axis] = std::max(grid_.slab(axis, box.min()[axis]), low_[axis] - 1);
      to[axis] = std::min(grid_.slab(axis, box.max()[axis]), high_[axis] + 1);
    }
    return cells_.shareOf(from, to);
  }

  void cutTriangle(std::int32_t t)
  {
    sides_.clear();
    some_ = false;
    all_ = true;
    current_ = t;
    const Triangle& c = mesh_.triangles[t];
    planes_.choose(mesh_.points[c[0]], mesh_.points[c[1]], mesh_.points[c[2]]);
    whole_.clear();
    for (std::int8_t k = 0; k < 3; ++k)
    {
      whole_.push_back({ c[k], { kNoPlane, k } });
    }
    this->cutPiece(whole_, {}, 0);
    if (!some_)
    {
      return; // wholly outside
    }
    result_.gone.push_back(t);
    if (!all_)
    {
      result_.cutTriangles.push_back(t);
      this->takeApart(t);
    }
  }

  /// \param piece what is left of it in the last cell, afterwards.
  void cutPiece(Piece& piece, Index3 cell, int axis)
  {
    if (axis == 3)
    {
      const bool outside = !planes_.areAround(cell) || !cells_.contains(cell);
      some_ = some_ || !outside;
      all_ = all_ && !outside;
      for (std::size_t k = 0; k < piece.size(); ++k)
      {
        sides_.push_back(
          { piece[k].vertex, piece[(k + 1) % piece.size()].vertex, piece[k].side, outside, cell });
      }
      return;
    }
    std::int64_t first = this->slab(piece.front().vertex, axis);
    std::int64_t last = first;
    for (const Corner& corner : piece)
    {
      const std::int64_t slab = this->slab(corner.vertex, axis);
      first = std::min(first, slab);
      last = std::max(last, slab);
    }
    for (cell[axis] = first; cell[axis] < last; ++cell[axis])
    {
      if (!planes_.has(axis, cell[axis] + 1))
      {
        continue;
      }
      const std::size_t count =
        this->split(piece, { static_cast<std::int8_t>(axis), cell[axis] + 1 });
      for (std::size_t k = 0; k < count; ++k)
      {
        this->cutPiece(below_[axis][k], cell, axis + 1);
      }
    }
    this->cutPiece(piece, cell, axis + 1);
  }

  /// Takes off what of a piece is below a plane: the first in below_ of the axis, as many as this
  /// returns. In one part but for pieces that rounding has bent.
  std::size_t split(Piece& piece, const Plane& plane)
  {
    const std::size_t n = piece.size();
    // By slab(), which begins at its plane.
    const double height = grid_.plane(plane.axis, plane.index);
    const auto isBelow = [&](std::size_t k)
    { return this->point(piece[k < n ? k : k - n].vertex)[plane.axis] < height; };
    std::size_t start = 0; // above, with its predecessor below
    while (start < n && !(!isBelow(start) && isBelow(start + n - 1)))
    {
      ++start;
    }
    if (start == n)
    {
      return 0; // nothing is below
    }
    std::vector<Piece>& below = below_[plane.axis];
    std::size_t count = 0;
    const auto open = [&](const Corner& corner)
    {
      below.resize(std::max(below.size(), ++count));
      below[count - 1] = { corner };
    };
    Piece& above = above_;
    above.clear();
    for (std::size_t k = 0; k < n; ++k)
    {
      const std::size_t at = (start + k) % n;
      const Corner& corner = piece[at];
      if (!isBelow(at))
      {
        above.push_back(corner);
        if (isBelow(at + 1))
        {
          const std::int32_t v = this->vertexAt(corner, piece[(at + 1) % n].vertex, plane);
          above.push_back({ v, plane });
          open({ v, corner.side });
        }
        continue;
      }
      below[count - 1].push_back(corner);
      if (!isBelow(at + 1))
      {
        const std::int32_t v = this->vertexAt(corner, piece[(at + 1) % n].vertex, plane);
        below[count - 1].push_back({ v, plane });
        above.push_back({ v, corner.side });
      }
    }
    std::swap(piece, above);
    return count;
  }

  /// Where the side from a corner meets the plane: one vertex for both who have that side. A side
  /// of the triangle may be in other parts for the triangle beyond: its vertices are told by all of
  /// it.
  std::int32_t vertexAt(const Corner& corner, std::int32_t other, const Plane& plane)
  {
    const bool onEdge = corner.side.axis == kNoPlane;
    const Triangle& c = mesh_.triangles[current_];
    const auto [a, b] = onEdge ? std::minmax(c[corner.side.index], c[(corner.side.index + 1) % 3])
                               : std::minmax(corner.vertex, other);
    const auto [found, isNew] = numbers_.try_emplace({ a, b, plane.index, plane.axis },
      static_cast<std::int32_t>(points_ + static_cast<std::int32_t>(positions_.size())));
    if (!isNew)
    {
      return found->second;
    }
    const int axis = plane.axis;
    const bool upwards = this->point(a)[axis] <= this->point(b)[axis];
    const Vec3 from = this->point(upwards ? a : b);
    const Vec3 to = this->point(upwards ? b : a);
    const double height = grid_.plane(axis, plane.index);
    const double share = std::clamp((height - from[axis]) / (to[axis] - from[axis]), 0.0, 1.0);
    Vec3 position = from + share * (to - from);
    const Vec3& p = this->point(corner.vertex);
    const Vec3& q = this->point(other);
    position = position.cwiseMax(p.cwiseMin(q)).cwiseMin(p.cwiseMax(q));
    position[axis] = height;
    Made made;
    made.onEdge = onEdge;
    if (!made.onEdge)
    {
      made.isCrossing = true;
      const int along = 3 - axis - corner.side.axis;
      made.crossing.axis = static_cast<unsigned>(along);
      made.crossing.low[axis] = plane.index;
      made.crossing.low[corner.side.axis] = corner.side.index;
      made.crossing.low[along] = grid_.slab(along, position[along]);
      made.crossing.at = position[along];
    }
    positions_.push_back(position);
    made_.push_back(made);
    return found->second;
  }

  /// Keeps the outside of a triangle that the border cuts.
  void takeApart(std::int32_t t)
  {
    std::sort(sides_.begin(), sides_.end(),
      [](const Side& a, const Side& b)
      { return std::make_pair(a.ends(), a.from) < std::make_pair(b.ends(), b.from); });
    border_.clear();
    for (std::size_t k = 0; k < sides_.size();)
    {
      const Side& side = sides_[k];
      const bool paired = k + 1 < sides_.size() && sides_[k + 1].ends() == side.ends();
      if (!paired)
      {
        if (side.outside)
        {
          border_.push_back(side);
        }
        ++k;
        continue;
      }
      const Side& other = sides_[k + 1];
      if (side.outside != other.outside)
      {
        border_.push_back(side.outside ? side : other);
        this->addSegment(side.outside ? other : side);
      }
      k += 2;
    }
    this->fill(t, this->traceBorders());
  }

  void addSegment(const Side& inner)
  {
    const auto axis = static_cast<unsigned>(inner.plane.axis);
    const unsigned above = inner.cell[axis] < inner.plane.index ? 1 : 0; // the plane, of the cell
    result_.segments.push_back(
      { inner.cell, 2 * axis + above, this->use(inner.from), this->use(inner.to) });
  }

  /// Loops of border_, without the vertices in the midst of what is left of a triangle's side.
  std::vector<std::vector<std::int32_t>> traceBorders()
  {
    std::sort(
      border_.begin(), border_.end(), [](const Side& a, const Side& b) { return a.from < b.from; });
    std::vector<std::vector<std::int32_t>> borders;
    std::vector<bool> done(border_.size(), false);
    for (std::size_t first = 0; first < border_.size(); ++first)
    {
      std::vector<std::int32_t> loop;
      std::size_t k = first;
      bool wasMeshSide = false;
      while (k < border_.size() && !done[k])
      {
        done[k] = true;
        const Side& side = border_[k];
        const bool isMeshSide = side.plane.axis == kNoPlane;
        const bool between = side.from >= points_ && isMeshSide && wasMeshSide;
        if (!between)
        {
          loop.push_back(side.from);
        }
        wasMeshSide = isMeshSide;
        k = static_cast<std::size_t>(
          std::lower_bound(border_.begin(), border_.end(), side.to,
            [](const Side& s, std::int32_t from) { return s.from < from; }) -
          border_.begin());
      }
      if (loop.size() > 1 && wasMeshSide && border_[first].plane.axis == kNoPlane &&
        loop.front() >= points_)
      {
        loop.erase(loop.begin());
      }
      if (loop.size() >= 3)
      {
        borders.push_back(std::move(loop));
      }
    }
    return borders;
  }

  void fill(std::int32_t t, std::vector<std::vector<std::int32_t>> borders)
  {
    const Vec3 normal = areaNormal(mesh_, static_cast<std::size_t>(t));
    int axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    const int u = (axis + (normal[axis] >= 0.0 ? 1 : 2)) % 3;
    const int v = (axis + (normal[axis] >= 0.0 ? 2 : 1)) % 3;
    std::vector<std::int32_t> vertices;
    std::vector<Eigen::Vector2d> place;
    for (auto& border : borders)
    {
      for (std::int32_t& vertex : border)
      {
        const Vec3& p = this->point(vertex);
        place.emplace_back(p[u], p[v]);
        vertices.push_back(this->use(vertex));
        vertex = static_cast<std::int32_t>(vertices.size() - 1);
      }
    }
    for (const Triangle& c : fillPolygon(std::move(borders), place))
    {
      result_.pieces.push_back({ vertices[c[0]], vertices[c[1]], vertices[c[2]] });
      result_.pieceOf.push_back(t);
    }
  }

  /// Number of a vertex in the result.
  std::int32_t use(std::int32_t v)
  {
    if (v < points_)
    {
      return v;
    }
    Made& made = made_[v - points_];
    if (!made.used)
    {
      made.used = true;
      made.number = points_ + static_cast<std::int32_t>(result_.vertices.size());
      result_.vertices.push_back(cutVertexOn(mesh_, current_, positions_[v - points_]));
      if (made.isCrossing)
      {
        made.crossing.vertex = made.number;
        result_.crossings.push_back(made.crossing);
      }
    }
    return made.number;
  }

  const TriangleMesh& mesh_;
  const CellSet& cells_;
  const CellGrid grid_;
  const std::int32_t points_;
  Index3 low_{};
  Index3 high_{};
  Box3 bounds_;      ///< of the cells, and a bit more
  CutPlanes planes_; ///< of the triangle that is being cut
  CutMesh result_;
  std::vector<Vec3> positions_; ///< of made vertices
  std::vector<Made> made_;
  std::unordered_map<CutKey, std::int32_t, CutKeyHash> numbers_;

  // Of the triangle that is being cut, so that nothing is allocated for it.
  Piece whole_;
  Piece above_;
  std::array<std::vector<Piece>, 3> below_; ///< per axis
  std::vector<Side> sides_;
  std::vector<Side> border_;
  std::int32_t current_ = 0;
  bool some_ = false; ///< some piece is inside
  bool all_ = true;
};

} // namespace

CutVertex cutVertexOn(const TriangleMesh& mesh, std::int32_t triangle, const Vec3& point)
{
  CutVertex vertex;
  vertex.point = point;
  vertex.triangle = triangle;
  const Triangle& c = mesh.triangles[triangle];
  const Vec3 a = mesh.points[c[1]] - mesh.points[c[0]];
  const Vec3 b = mesh.points[c[2]] - mesh.points[c[0]];
  const Vec3 p = point - mesh.points[c[0]];
  const Vec3 normal = a.cross(b);
  const double squared = normal.squaredNorm();
  if (squared > 0.0)
  {
    vertex.u = std::clamp(p.cross(b).dot(normal) / squared, 0.0, 1.0);
    vertex.v = std::clamp(a.cross(p).dot(normal) / squared, 0.0, 1.0 - vertex.u);
  }
  return vertex;
}

CutMesh cutMesh(const TriangleMesh& mesh, const std::vector<std::int32_t>& candidates,
  const CellSet& cells, const CellGrid& grid, const Progress& progress)
{
  return cells.empty() ? CutMesh() : Cutter(mesh, cells, grid).run(candidates, progress);
}

} // namespace hybridtree
