// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/PlanarTriangulation.h"

#include "core/geometry/Predicates.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

int turnOf(const Vec2& a, const Vec2& b, const Vec2& c)
{
  return orientation2d(a.x(), a.y(), b.x(), b.y(), c.x(), c.y());
}

double cross(const Vec2& a, const Vec2& b)
{
  return a.x() * b.y() - a.y() * b.x();
}

// What is left of a polygon while ears are cut off it.
class Ears
{
public:
  explicit Ears(const std::vector<Vec2>& points) : points_(points)
  {
    const int count = static_cast<int>(points.size());
    for (int k = 0; k < count; ++k)
    {
      next_.push_back((k + 1) % count);
      previous_.push_back((k + count - 1) % count);
    }
  }

  std::vector<Triangle> cut()
  {
    std::vector<Triangle> triangles;
    int left = static_cast<int>(points_.size());
    int at = 0;
    for (int tried = 0; left > 3 && tried <= 2 * left; ++tried)
    {
      const int next = next_[at];
      if (this->isEar(at))
      {
        triangles.push_back({ previous_[at], at, next });
        next_[previous_[at]] = next;
        previous_[next] = previous_[at];
        --left;
        tried = 0;
        // Not the neighbour at once: fans make slivers.
        at = next_[next];
        continue;
      }
      at = next;
    }
    triangles.push_back({ previous_[at], at, next_[at] });
    return triangles;
  }

private:
  bool isEar(int b) const
  {
    const int a = previous_[b];
    const int c = next_[b];
    if (turnOf(points_[a], points_[b], points_[c]) <= 0)
    {
      return false;
    }
    for (int k = next_[c]; k != a; k = next_[k])
    {
      const Vec2& p = points_[k];
      if (p == points_[a] || p == points_[b] || p == points_[c])
      {
        continue; // the way back of a bridge: what it bounds begins beside the ear
      }
      if (turnOf(points_[a], points_[b], p) >= 0 && turnOf(points_[b], points_[c], p) >= 0 &&
        turnOf(points_[c], points_[a], p) >= 0)
      {
        return false;
      }
    }
    return true;
  }

  const std::vector<Vec2>& points_;
  std::vector<int> next_, previous_;
};

} // namespace

std::vector<Triangle> triangulatePolygon(const std::vector<Vec2>& outline)
{
  return Ears(outline).cut();
}

PlanarTriangulation::PlanarTriangulation(const std::vector<Vec2>& outline)
  : PlanarTriangulation(outline, std::vector<char>(outline.size(), 1), triangulatePolygon(outline))
{
}

PlanarTriangulation::PlanarTriangulation(
  std::vector<Vec2> points, std::vector<char> fixed, std::vector<Triangle> triangles)
  : points_(std::move(points))
  , fixed_(std::move(fixed))
  , triangles_(std::move(triangles))
  , neighbours_(triangles_.size(), Sides{ -1, -1, -1 })
  , triangleAt_(points_.size(), 0)
{
  this->connect();
  this->flipAll();
}

void PlanarTriangulation::connect()
{
  // Sides in a list for each point that they begin at.
  const auto begin = [](const Triangle& t, int side) { return t[side]; };
  const auto end = [](const Triangle& t, int side) { return t[side == 2 ? 0 : side + 1]; };
  std::vector<int> first(points_.size(), -1);
  std::vector<int> next(3 * triangles_.size());
  for (int s = 0; s < static_cast<int>(next.size()); ++s)
  {
    const int point = begin(triangles_[s / 3], s % 3);
    next[s] = first[point];
    first[point] = s;
    triangleAt_[point] = s / 3;
  }
  for (int s = 0; s < static_cast<int>(next.size()); ++s)
  {
    const int point = begin(triangles_[s / 3], s % 3);
    for (int other = first[end(triangles_[s / 3], s % 3)]; other >= 0; other = next[other])
    {
      if (end(triangles_[other / 3], other % 3) == point)
      {
        neighbours_[s / 3][s % 3] = other / 3;
      }
    }
  }
}

int PlanarTriangulation::turn(int a, int b, int c) const
{
  return turnOf(points_[a], points_[b], points_[c]);
}

int PlanarTriangulation::addPoint(const Vec2& p, bool onOutline)
{
  points_.push_back(p);
  fixed_.push_back(onOutline ? 1 : 0);
  triangleAt_.push_back(-1);
  return static_cast<int>(points_.size()) - 1;
}

PlanarTriangulation::Edge PlanarTriangulation::outlineEdgeFrom(int point) const
{
  // Turn around the point clockwise, to the triangle with nothing on its right.
  int t = triangleAt_[point];
  for (;;)
  {
    const Triangle& triangle = triangles_[t];
    const int side = triangle[0] == point ? 0 : triangle[1] == point ? 1 : 2;
    const int next = neighbours_[t][side];
    if (next < 0)
    {
      return { t, side };
    }
    t = next;
  }
}

void PlanarTriangulation::setTriangle(int t, const Triangle& corners, const Sides& neighbours)
{
  triangles_[t] = corners;
  neighbours_[t] = neighbours;
  for (const int corner : corners)
  {
    triangleAt_[corner] = t;
  }
}

void PlanarTriangulation::replaceNeighbour(int t, int before, int after)
{
  if (t >= 0)
  {
    *std::find(neighbours_[t].begin(), neighbours_[t].end(), before) = after;
  }
}

int PlanarTriangulation::splitOutline(int from, const Vec2& position)
{
  const auto [triangle, side] = this->outlineEdgeFrom(from);
  const Triangle old = triangles_[triangle];
  const Sides beside = neighbours_[triangle];
  const int a = old[side];
  const int b = old[(side + 1) % 3];
  const int c = old[(side + 2) % 3];
  const int right = beside[(side + 1) % 3];
  const int left = beside[(side + 2) % 3];
  const int p = this->addPoint(position, true);
  const int added = static_cast<int>(triangles_.size());
  triangles_.emplace_back();
  neighbours_.emplace_back();
  this->setTriangle(triangle, { a, p, c }, { -1, added, left });
  this->setTriangle(added, { p, b, c }, { -1, right, triangle });
  this->replaceNeighbour(right, triangle, added);
  std::vector<Edge> edges = { { triangle, 2 }, { added, 1 } };
  this->legalize(edges);
  return p;
}

int PlanarTriangulation::locate(const Vec2& p) const
{
  int t = last_;
  const int most = 100 + static_cast<int>(4.0 * std::sqrt(double(triangles_.size())));
  for (int step = 0; step < most; ++step)
  {
    int next = -2; // inside
    for (int side = 0; side < 3 && next == -2; ++side)
    {
      const int a = triangles_[t][side];
      const int b = triangles_[t][(side + 1) % 3];
      if (turnOf(points_[a], points_[b], p) < 0)
      {
        next = neighbours_[t][side];
      }
    }
    if (next == -2)
    {
      return t;
    }
    if (next == -1)
    {
      break; // out at a notch
    }
    t = next;
  }
  return this->scan(p);
}

int PlanarTriangulation::scan(const Vec2& p) const
{
  for (std::size_t t = 0; t < triangles_.size(); ++t)
  {
    const auto& [a, b, c] = triangles_[t];
    if (turnOf(points_[a], points_[b], p) >= 0 && turnOf(points_[b], points_[c], p) >= 0 &&
      turnOf(points_[c], points_[a], p) >= 0)
    {
      return static_cast<int>(t);
    }
  }
  return -1;
}

int PlanarTriangulation::insert(const Vec2& position)
{
  const int t = this->locate(position);
  if (t < 0)
  {
    return -1;
  }
  const auto [a, b, c] = triangles_[t];
  if (points_[a] == position || points_[b] == position || points_[c] == position)
  {
    return -1;
  }
  const Sides beside = neighbours_[t];
  const int p = this->addPoint(position, false);
  const int u = static_cast<int>(triangles_.size());
  const int v = u + 1;
  triangles_.resize(triangles_.size() + 2);
  neighbours_.resize(neighbours_.size() + 2);
  // A point on a side leaves a flat triangle there for the moment, whose side is then flipped.
  this->setTriangle(t, { a, b, p }, { beside[0], u, v });
  this->setTriangle(u, { b, c, p }, { beside[1], v, t });
  this->setTriangle(v, { c, a, p }, { beside[2], t, u });
  this->replaceNeighbour(beside[1], t, u);
  this->replaceNeighbour(beside[2], t, v);
  std::vector<Edge> edges = { { t, 0 }, { u, 0 }, { v, 0 } };
  this->legalize(edges);
  last_ = triangleAt_[p];
  return p;
}

PlanarTriangulation::Edge PlanarTriangulation::mirrored(Edge edge) const
{
  const int other = neighbours_[edge.triangle][edge.side];
  const Sides& back = neighbours_[other];
  const int end = triangles_[edge.triangle][(edge.side + 1) % 3];
  for (int side = 0; side < 3; ++side)
  {
    if (back[side] == edge.triangle && triangles_[other][side] == end)
    {
      return { other, side };
    }
  }
  return { other, 0 };
}

bool PlanarTriangulation::shouldFlip(Edge edge) const
{
  if (neighbours_[edge.triangle][edge.side] < 0)
  {
    return false;
  }
  const Edge other = this->mirrored(edge);
  const int a = triangles_[edge.triangle][edge.side];
  const int b = triangles_[edge.triangle][(edge.side + 1) % 3];
  const int c = triangles_[edge.triangle][(edge.side + 2) % 3];
  const int d = triangles_[other.triangle][(other.side + 2) % 3];
  // The angles at c and d together are more than two right ones: sin(c + d) < 0.
  const Vec2 ca = points_[a] - points_[c];
  const Vec2 cb = points_[b] - points_[c];
  const Vec2 da = points_[a] - points_[d];
  const Vec2 db = points_[b] - points_[d];
  const double sine = cross(ca, cb) * da.dot(db) + ca.dot(cb) * cross(db, da);
  return sine < 0.0 && // as nearly always not
    sine < -1e-9 * (ca.norm() * cb.norm() * da.norm() * db.norm()) && this->turn(c, a, d) > 0 &&
    this->turn(d, b, c) > 0;
}

void PlanarTriangulation::flip(Edge edge)
{
  const Edge other = this->mirrored(edge);
  const int t = edge.triangle;
  const int u = other.triangle;
  const int a = triangles_[t][edge.side];
  const int b = triangles_[t][(edge.side + 1) % 3];
  const int c = triangles_[t][(edge.side + 2) % 3];
  const int d = triangles_[u][(other.side + 2) % 3];
  const int bc = neighbours_[t][(edge.side + 1) % 3];
  const int ca = neighbours_[t][(edge.side + 2) % 3];
  const int ad = neighbours_[u][(other.side + 1) % 3];
  const int db = neighbours_[u][(other.side + 2) % 3];
  this->setTriangle(t, { c, a, d }, { ca, ad, u });
  this->setTriangle(u, { d, b, c }, { db, bc, t });
  this->replaceNeighbour(ad, u, t);
  this->replaceNeighbour(bc, t, u);
}

void PlanarTriangulation::legalize(std::vector<Edge>& edges)
{
  // Each flip makes the angles better; the limit is against rounding alone.
  for (std::size_t left = 100 + 100 * triangles_.size(); !edges.empty() && left > 0; --left)
  {
    const Edge edge = edges.back();
    edges.pop_back();
    if (this->shouldFlip(edge))
    {
      const int t = edge.triangle;
      const int u = neighbours_[t][edge.side];
      this->flip(edge);
      edges.insert(edges.end(), { { t, 0 }, { t, 1 }, { u, 0 }, { u, 1 } });
    }
  }
}

void PlanarTriangulation::flipAll()
{
  std::vector<Edge> edges;
  for (int t = 0; t < static_cast<int>(triangles_.size()); ++t)
  {
    for (int side = 0; side < 3; ++side)
    {
      if (neighbours_[t][side] > t && this->shouldFlip({ t, side }))
      {
        edges.push_back({ t, side });
        this->legalize(edges);
      }
    }
  }
}

void PlanarTriangulation::splitLongEdges(double length)
{
  for (bool changed = true; changed;)
  {
    std::vector<std::pair<Vec2, int>> middles; // and a point near by
    for (int t = 0; t < static_cast<int>(triangles_.size()); ++t)
    {
      for (int side = 0; side < 3; ++side)
      {
        const Vec2& a = points_[triangles_[t][side]];
        const Vec2& b = points_[triangles_[t][(side + 1) % 3]];
        if (neighbours_[t][side] > t && (a - b).squaredNorm() > length * length)
        {
          middles.emplace_back(0.5 * (a + b), triangles_[t][side]);
        }
      }
    }
    changed = false;
    for (const auto& [middle, near] : middles)
    {
      last_ = triangleAt_[near];
      changed = this->insert(middle) >= 0 || changed;
    }
  }
}

double PlanarTriangulation::longestEdge() const
{
  double squared = 0.0;
  for (const auto& [a, b, c] : triangles_)
  {
    squared = std::max({ squared, (points_[a] - points_[b]).squaredNorm(),
      (points_[b] - points_[c]).squaredNorm(), (points_[c] - points_[a]).squaredNorm() });
  }
  return std::sqrt(squared);
}

void PlanarTriangulation::relax(std::vector<Vec2>& before)
{
  before = points_;
  std::vector<Vec2> sum(points_.size(), Vec2::Zero());
  std::vector<int> count(points_.size(), 0);
  for (const auto& [a, b, c] : triangles_)
  {
    sum[a] += before[b] + before[c];
    sum[b] += before[c] + before[a];
    sum[c] += before[a] + before[b];
    ++count[a], ++count[b], ++count[c];
  }
  for (std::size_t k = 0; k < points_.size(); ++k)
  {
    if (!fixed_[k])
    {
      points_[k] = sum[k] / (2.0 * count[k]);
    }
  }
}

void PlanarTriangulation::smooth(int rounds)
{
  std::vector<Vec2> before;
  for (int round = 0; round < rounds; ++round)
  {
    this->relax(before);
    // Points of triangles that would turn over go back; that may turn over others.
    for (bool changed = true; changed;)
    {
      changed = false;
      for (const auto& [a, b, c] : triangles_)
      {
        const Vec2 ab = points_[b] - points_[a];
        const Vec2 ac = points_[c] - points_[a];
        if (cross(ab, ac) <= 1e-3 * std::max(ab.squaredNorm(), ac.squaredNorm()))
        {
          for (const int corner : { a, b, c })
          {
            changed = changed || points_[corner] != before[corner];
            points_[corner] = before[corner];
          }
        }
      }
    }
  }
  this->flipAll();
}

} // namespace hybridtree
