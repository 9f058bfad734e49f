// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/RingMesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace hybridtree
{
namespace
{

constexpr double kPi = 3.14159265358979323846;

/// Cosine and sine of the angles of a ring. Most rings of a shape are like one of the last two.
class Turns
{
public:
  const std::vector<Vec2>& of(const Ring& ring)
  {
    std::vector<Vec2>& turns = turns_[ring.shift];
    const std::size_t count = static_cast<std::size_t>(ring.count);
    if (turns.size() != count)
    {
      turns.resize(count);
      fill(turns, ring);
    }
    return turns;
  }

private:
  // A few angles and their sums with multiples of a large one: a fraction of the sines.
  static void fill(std::vector<Vec2>& turns, const Ring& ring)
  {
    constexpr int kBlock = 16;
    const double unit = kPi / ring.count;
    Vec2 small[kBlock];
    for (int k = 0; k < std::min(kBlock, ring.count); ++k)
    {
      const double angle = (2 * k + ring.shift) * unit;
      small[k] = Vec2(std::cos(angle), std::sin(angle));
    }
    for (int begin = 0; begin < ring.count; begin += kBlock)
    {
      const double angle = 2 * begin * unit;
      const double c = std::cos(angle);
      const double s = std::sin(angle);
      for (int k = 0; k < std::min(kBlock, ring.count - begin); ++k)
      {
        turns[static_cast<std::size_t>(begin + k)] =
          Vec2(c * small[k].x() - s * small[k].y(), s * small[k].x() + c * small[k].y());
      }
    }
  }

  std::vector<Vec2> turns_[2];
};

class RingMesher
{
public:
  RingMesher(const std::vector<Ring>& rings, bool closed) : rings_(rings), closed_(closed)
  {
    std::size_t points = 0;
    std::size_t triangles = 0;
    for (const Ring& ring : rings)
    {
      first_.push_back(static_cast<int>(points));
      points += static_cast<std::size_t>(ring.count);
      triangles += 2 * static_cast<std::size_t>(ring.count);
    }
    mesh_.points.reserve(points);
    mesh_.normals.reserve(points);
    mesh_.triangles.reserve(triangles);
  }

  template <class FrameOf>
  TriangleMesh make(const FrameOf& frameOf)
  {
    for (std::size_t k = 0; k < rings_.size(); ++k)
    {
      this->addPoints(rings_[k], frameOf(k));
    }
    const std::size_t strips = closed_ ? rings_.size() : rings_.size() - 1;
    for (std::size_t k = 0; k < strips; ++k)
    {
      this->addStrip(k, (k + 1) % rings_.size());
    }
    return std::move(mesh_);
  }

private:
  void addPoints(const Ring& ring, const RevolvedFrame& frame)
  {
    const Vec3 across = frame.axis.cross(frame.side);
    const Vec3 center = frame.origin + ring.place.position.y() * frame.axis;
    const Vec3 up = ring.place.normal.y() * frame.axis;
    if (ring.count == 1)
    {
      mesh_.points.push_back(center);
      mesh_.normals.push_back(up);
      return;
    }
    for (const Vec2& turn : turns_.of(ring))
    {
      const Vec3 outward = turn.x() * frame.side + turn.y() * across;
      mesh_.points.push_back(center + ring.place.position.x() * outward);
      mesh_.normals.push_back(up + ring.place.normal.x() * outward);
    }
  }

  void addStrip(std::size_t from, std::size_t to)
  {
    const Ring& a = rings_[from];
    const Ring& b = rings_[to];
    const int firstA = first_[from];
    const int firstB = first_[to];
    if (a.count == 1 || b.count == 1)
    {
      const int around = std::max(a.count, b.count);
      for (int k = 0; k < around; ++k)
      {
        const int next = k + 1 < around ? k + 1 : 0;
        mesh_.triangles.push_back(a.count == 1 ? Triangle{ firstA, firstB + next, firstB + k }
                                               : Triangle{ firstA + k, firstA + next, firstB });
      }
      return;
    }
    this->addBetween(a, firstA, b, firstB);
  }

  void addBetween(const Ring& a, int firstA, const Ring& b, int firstB)
  {
    // Middle of the next edge of each ring, as a fraction of the turn over a common denominator.
    const std::int64_t stepA = 2 * std::int64_t(b.count);
    const std::int64_t stepB = 2 * std::int64_t(a.count);
    std::int64_t middleA = (1 + a.shift) * std::int64_t(b.count);
    std::int64_t middleB = (1 + b.shift) * std::int64_t(a.count);
    const std::int64_t whole = stepA * a.count;
    const bool aFirst = this->goesFirst(a.place.position, b.place.position);
    // On a tie the other way in every other quarter: mirror images.
    const auto aOnTie = [&] { return aFirst == ((4 * middleA / whole) % 2 == 0); };
    int i = 0;
    int j = 0;
    Triangle* next = this->append(static_cast<std::size_t>(a.count) + std::size_t(b.count));
    // Without branches, which nobody could predict, up to where one of the rings closes.
    while (i + 1 < a.count && j + 1 < b.count)
    {
      const bool onA = middleA != middleB ? middleA < middleB : aOnTie();
      *next++ = { firstA + i, onA ? firstA + i + 1 : firstB + j + 1, firstB + j };
      i += onA;
      j += !onA;
      middleA += onA ? stepA : 0;
      middleB += onA ? 0 : stepB;
    }
    while (i < a.count || j < b.count)
    {
      const bool before = middleA != middleB ? middleA < middleB : aOnTie();
      const bool onA = j == b.count || (i < a.count && before);
      const int nextA = firstA + (i + 1 < a.count ? i + 1 : 0);
      const int nextB = firstB + (j + 1 < b.count ? j + 1 : 0);
      *next++ = { firstA + (i < a.count ? i : 0), onA ? nextA : nextB,
        firstB + (j < b.count ? j : 0) };
      i += onA;
      j += !onA;
      middleA += onA ? stepA : 0;
      middleB += onA ? 0 : stepB;
    }
  }

  // Room for more triangles, to be written.
  Triangle* append(std::size_t count)
  {
    const std::size_t before = mesh_.triangles.size();
    mesh_.triangles.resize(before + count);
    return &mesh_.triangles[before];
  }

  // The same answer for a strip and its mirror image in height.
  static bool goesFirst(const Vec2& a, const Vec2& b)
  {
    return a.x() != b.x() ? a.x() > b.x() : std::abs(a.y()) > std::abs(b.y());
  }

  const std::vector<Ring>& rings_;
  bool closed_;
  std::vector<int> first_;
  Turns turns_;
  TriangleMesh mesh_;
};

} // namespace

TriangleMesh meshRings(const std::vector<Ring>& rings, bool closed, const RevolvedFrame& frame)
{
  return RingMesher(rings, closed).make([&](std::size_t) -> const auto& { return frame; });
}

TriangleMesh meshRings(
  const std::vector<Ring>& rings, bool closed, const std::vector<RevolvedFrame>& frames)
{
  return RingMesher(rings, closed).make([&](std::size_t k) -> const auto& { return frames[k]; });
}

double longestEdge(const TriangleMesh& mesh, const std::vector<Ring>& rings)
{
  double around = 0.0;
  for (const Ring& ring : rings)
  {
    around = std::max(
      around, ring.count > 1 ? 2.0 * ring.place.position.x() * std::sin(kPi / ring.count) : 0.0);
  }
  double squared = 0.0;
  for (const Triangle& t : mesh.triangles)
  {
    squared = std::max(squared, (mesh.points[t[0]] - mesh.points[t[2]]).squaredNorm());
  }
  return std::max(around, std::sqrt(squared));
}

double longestAcross(const Ring& a, const Ring& b)
{
  const Vec2& p = a.place.position;
  const Vec2& q = b.place.position;
  double turn = 0.0;
  if (a.count > 1 && b.count > 1)
  {
    // Points are joined where their sectors, each from the middle of one edge to that of the next,
    // overlap; the farther apart, the less they overlap. Middles differ by all numbers that are
    // `phase` modulo twice the common divisor, over the product of the counts.
    const std::int64_t m = a.count;
    const std::int64_t n = b.count;
    const std::int64_t period = 2 * std::gcd(m, n);
    const std::int64_t phase = std::abs((1 + a.shift) * n - (1 + b.shift) * m) % period;
    const std::int64_t overlap = std::min(phase, period - phase);
    turn = kPi * (double(m + n - overlap) / (double(m) * double(n)));
  }
  // The chord of the turn, without cancellation.
  const double half = std::sin(0.5 * std::min(turn, kPi));
  return std::sqrt((p - q).squaredNorm() + 4.0 * p.x() * q.x() * half * half);
}

} // namespace hybridtree
