// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/OffsetMesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace hybridtree
{
namespace
{

constexpr double kPi = 3.14159265358979323846;

// One ring of points around the axis. Point k stands at the angle (2k + shift) pi / count.
struct Ring
{
  int count = 0;
  int shift = 0;
  int first = 0; // number of its first point in the mesh
};

class Torus
{
public:
  // \param spacing aimed at along the rings; the rings themselves are that of an equilateral
  // triangle apart.
  Torus(const CircleShape& circle, double tube, double spacing)
    : circle_(circle), tube_(tube), across_(circle.normal.cross(circle.side))
  {
    const double outer = circle.radius + tube;
    const double inner = circle.radius - tube;
    // Even, so that the two sides of the circle's plane mirror each other.
    const int rings =
      std::max(4, 2 * static_cast<int>(std::ceil(kPi * tube / (std::sqrt(0.75) * spacing))));
    // Triangles of a thin tube may not become needles, within reason.
    const double chord = 2.0 * tube * std::sin(kPi / rings);
    const double along = std::min(spacing, std::max(2.0 * chord, spacing / 8.0));
    const bool regular = inner >= 0.6 * outer;
    int next = 0;
    for (int k = 0; k < rings; ++k)
    {
      const double radius = regular
        ? outer
        : circle.radius + tube * std::cos(2.0 * kPi * std::min(k, rings - k) / rings);
      Ring ring;
      // A multiple of 4 keeps two planes through the axis as mirrors.
      ring.count =
        std::max(regular ? 8 : 4, 4 * static_cast<int>(std::ceil(0.5 * kPi * radius / along)));
      ring.shift = k % 2;
      ring.first = next;
      next += ring.count;
      rings_.push_back(ring);
    }
  }

  TriangleMesh make() const
  {
    TriangleMesh mesh;
    const int rings = static_cast<int>(rings_.size());
    for (int k = 0; k < rings; ++k)
    {
      this->addPoints(k, mesh);
    }
    // From the outer equator inwards on both sides, so that they come out alike.
    for (int k = 0; 2 * k < rings; ++k)
    {
      this->addStrip(rings_[k], rings_[k + 1], false, mesh);
      this->addStrip(rings_[(rings - k) % rings], rings_[rings - k - 1], true, mesh);
    }
    return mesh;
  }

private:
  void addPoints(int k, TriangleMesh& mesh) const
  {
    const int rings = static_cast<int>(rings_.size());
    const Ring& ring = rings_[k];
    // The lower half from the same numbers as the upper.
    const double angle = 2.0 * kPi * std::min(k, rings - k) / rings;
    const double radial = std::cos(angle);
    const double height = 2 * k > rings ? -std::sin(angle) : std::sin(angle);
    for (int point = 0; point < ring.count; ++point)
    {
      const double turn = kPi * (2 * point + ring.shift) / ring.count;
      const Vec3 outward = std::cos(turn) * circle_.side + std::sin(turn) * across_;
      const Vec3 normal = (radial * outward + height * circle_.normal).normalized();
      mesh.normals.push_back(normal);
      mesh.points.push_back(circle_.center + circle_.radius * outward + tube_ * normal);
    }
  }

  // Triangles between two rings, advancing on the one that gives the shorter diagonal. In integers,
  // so that the pattern repeats all around.
  static void addStrip(const Ring& a, const Ring& b, bool flip, TriangleMesh& mesh)
  {
    const auto add = [&](int p, int q, int r) {
      mesh.triangles.push_back(flip ? Triangle{ p, r, q } : Triangle{ p, q, r });
    };
    const auto id = [](const Ring& ring, int k) { return ring.first + k % ring.count; };
    int i = 0;
    int j = 0;
    while (i < a.count || j < b.count)
    {
      // Middle of the next edge of each ring, as a fraction of the turn, over a common denominator.
      const std::int64_t middleA = std::int64_t(2 * i + 1 + a.shift) * b.count;
      const std::int64_t middleB = std::int64_t(2 * j + 1 + b.shift) * a.count;
      if (j == b.count || (i < a.count && middleA < middleB))
      {
        add(id(a, i), id(a, i + 1), id(b, j));
        ++i;
      }
      else
      {
        add(id(a, i), id(b, j + 1), id(b, j));
        ++j;
      }
    }
  }

  const CircleShape& circle_;
  double tube_;
  Vec3 across_;
  std::vector<Ring> rings_;
};

double longestEdge(const TriangleMesh& mesh)
{
  double squared = 0.0;
  for (const Triangle& t : mesh.triangles)
  {
    for (int side = 0; side < 3; ++side)
    {
      squared =
        std::max(squared, (mesh.points[t[side]] - mesh.points[t[(side + 1) % 3]]).squaredNorm());
    }
  }
  return std::sqrt(squared);
}

} // namespace

TriangleMesh meshTorus(const CircleShape& circle, double tube, double edgeLength)
{
  // Area over that of an equilateral triangle, whose edges come out some tenths shorter.
  requireModestCount(
    4.0 * kPi * kPi * circle.radius * tube / (0.3 * edgeLength * edgeLength), edgeLength);
  double spacing = edgeLength;
  for (;;)
  {
    TriangleMesh mesh = Torus(circle, tube, spacing).make();
    const double longest = longestEdge(mesh);
    // The coarsest tori can be coarser than asked for only by their own size.
    if (longest <= edgeLength)
    {
      return mesh;
    }
    spacing *= std::min(0.99, edgeLength / longest);
  }
}

} // namespace hybridtree
