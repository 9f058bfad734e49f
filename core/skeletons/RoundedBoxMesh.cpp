// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/OffsetMesh.h"

#include "core/base/Error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace hybridtree
{

void requireModestCount(double triangles, double edgeLength)
{
  constexpr double kMost = 50e6;
  if (!(triangles <= kMost))
  {
    std::ostringstream text;
    text << "An edge length of " << edgeLength << " would make about " << triangles
         << " triangles of this primitive; at most " << kMost << " are made. Enlarge EdgeLength.";
    throw TooLarge(text.str());
  }
}

namespace
{

constexpr double kPi = 3.14159265358979323846;

using Index3 = std::array<int, 3>;

// No edge of a subdivided octant is longer than this many radii / n. Found numerically: the bound
// grows with n, to 2.30575 in the limit.
constexpr double kLongestOfOctant = 2.306;

class TriangleList
{
public:
  TriangleList(std::vector<Triangle>& triangles, bool mirrored)
    : triangles_(triangles), mirrored_(mirrored)
  {
  }

  void add(int a, int b, int c, bool flip)
  {
    triangles_.push_back(flip != mirrored_ ? Triangle{ a, c, b } : Triangle{ a, b, c });
  }

  // A cell with corners in this cyclic order, cut from a to c or from b to d.
  void addCell(int a, int b, int c, int d, bool fromA, bool flip)
  {
    if (fromA)
    {
      this->add(a, b, c, flip);
      this->add(a, c, d, flip);
    }
    else
    {
      this->add(a, b, d, flip);
      this->add(b, c, d, flip);
    }
  }

private:
  std::vector<Triangle>& triangles_;
  bool mirrored_;
};

// The six faces as grids of m cells a side, cut towards the middle so that mirror images agree.
// id(axis, positive, u) is the point of the face at grid position u.
template <class Id>
void addFaces(const Index3& m, const Id& id, TriangleList& list)
{
  for (int a = 0; a < 3; ++a)
  {
    const int b = (a + 1) % 3;
    const int c = (a + 2) % 3;
    for (const bool positive : { false, true })
    {
      const auto at = [&](int ub, int uc)
      {
        Index3 u;
        u[a] = positive ? m[a] : 0;
        u[b] = ub;
        u[c] = uc;
        return id(a, positive, u);
      };
      for (int ub = 0; ub < m[b]; ++ub)
      {
        for (int uc = 0; uc < m[c]; ++uc)
        {
          const bool fromA = (2 * ub + 1 < m[b]) == (2 * uc + 1 < m[c]);
          list.addCell(
            at(ub, uc), at(ub + 1, uc), at(ub + 1, uc + 1), at(ub, uc + 1), fromA, !positive);
        }
      }
    }
  }
}

// Coordinate of grid position u of m cells on [-half, half]; the middle where there are no cells.
double gridCoordinate(int u, int m, double half)
{
  return m > 0 ? half * (static_cast<double>(2 * u - m) / m) : 0.0;
}

// The surface as a Minkowski sum: a point is a grid position u of the box, plus radius times one of
// the directions of a subdivided octahedron, written as the integers d with |d0| + |d1| + |d2| = n.
// Where d points along +a or -a at all, u is at that end of the box; each pair occurs once.
class RoundedBox
{
public:
  RoundedBox(const BoxShape& box, double radius, double edgeLength) : box_(box), radius_(radius)
  {
    this->chooseCounts(edgeLength);
    profile_.resize(static_cast<std::size_t>(n_) + 1);
    for (int k = 0; k <= n_; ++k)
    {
      profile_[static_cast<std::size_t>(k)] = std::sin(0.5 * kPi * k / n_);
    }
    int next = 8 * this->octantSize();
    for (int a = 0; a < 3; ++a)
    {
      firstOfArcs_[a] = next;
      next += 4 * (n_ - 1) * (m_[a] + 1);
    }
    for (int a = 0; a < 3; ++a)
    {
      firstOfFaces_[a] = next;
      next += 2 * (m_[(a + 1) % 3] + 1) * (m_[(a + 2) % 3] + 1);
    }
    mesh_.points.resize(static_cast<std::size_t>(next));
    mesh_.normals.resize(static_cast<std::size_t>(next));
  }

  TriangleMesh make()
  {
    this->placePoints();
    mesh_.triangles.reserve(static_cast<std::size_t>(this->triangleCount(n_, m_[0], m_[1], m_[2])));
    TriangleList list(mesh_.triangles, box_.axes.determinant() < 0.0);
    this->addOctants(list);
    for (int a = 0; a < 3; ++a)
    {
      this->addQuadrants(a, list);
    }
    addFaces(
      m_,
      [this](int a, bool positive, const Index3& u)
      {
        Index3 d{};
        d[a] = positive ? n_ : -n_;
        return this->id(d, u);
      },
      list);
    return std::move(mesh_);
  }

private:
  static double triangleCount(double n, double mx, double my, double mz)
  {
    return 8.0 * n * n + 8.0 * n * (mx + my + mz) + 4.0 * (mx * my + my * mz + mz * mx);
  }

  void chooseCounts(double edgeLength)
  {
    // Right-angled cells on flat and cylindrical parts, of sides edgeLength / sqrt(2).
    const double side = edgeLength / std::sqrt(2.0);
    const double coarsest = std::ceil(kLongestOfOctant * radius_ / edgeLength);
    const double chord = 2.0 * radius_ * std::sin(0.25 * kPi / coarsest);
    // Along a single thin tube cells may not become needles, within reason.
    const bool tube = (box_.half.array() > 0.25 * chord).count() == 1;
    const double step = tube ? std::min(side, std::max(2.0 * chord, edgeLength / 8.0)) : side;
    double cells[3];
    double squaredStretch = 0.0;
    for (int a = 0; a < 3; ++a)
    {
      const double half = box_.half[a];
      const bool gap = half <= 0.25 * chord; // cells would be needles: leave it to the round parts
      cells[a] = gap ? 0.0 : std::ceil(2.0 * half / step);
      squaredStretch += gap ? half * half : 0.0;
    }
    const double room = edgeLength - std::sqrt(2.0 * squaredStretch);
    const double n = std::ceil(kLongestOfOctant * radius_ / room);
    requireModestCount(triangleCount(n, cells[0], cells[1], cells[2]), edgeLength);
    n_ = static_cast<int>(n);
    for (int a = 0; a < 3; ++a)
    {
      m_[a] = static_cast<int>(cells[a]);
    }
  }

  int octantSize() const { return (n_ - 1) * (n_ - 2) / 2; }

  // Number of the point at direction d and grid position u, of which only the components that d
  // leaves free are read. Inner points of the octants come first, then arcs, then faces.
  int id(const Index3& d, const Index3& u) const
  {
    const int zeros = (d[0] == 0) + (d[1] == 0) + (d[2] == 0);
    if (zeros == 0)
    {
      const int octant = (d[0] < 0) + 2 * (d[1] < 0) + 4 * (d[2] < 0);
      const int i = std::abs(d[0]);
      const int j = std::abs(d[1]);
      return octant * this->octantSize() + (i - 1) * (n_ - 1) - (i - 1) * i / 2 + j - 1;
    }
    if (zeros == 1)
    {
      const int a = d[0] == 0 ? 0 : d[1] == 0 ? 1 : 2;
      const int b = (a + 1) % 3;
      const int quadrant = (d[b] < 0) + 2 * (d[(a + 2) % 3] < 0);
      return firstOfArcs_[a] + (quadrant * (n_ - 1) + std::abs(d[b]) - 1) * (m_[a] + 1) + u[a];
    }
    const int a = d[0] != 0 ? 0 : d[1] != 0 ? 1 : 2;
    const int b = (a + 1) % 3;
    const int c = (a + 2) % 3;
    return firstOfFaces_[a] + ((d[a] < 0) * (m_[b] + 1) + u[b]) * (m_[c] + 1) + u[c];
  }

  void place(const Index3& d, const Index3& u)
  {
    Vec3 direction;
    Vec3 core;
    for (int a = 0; a < 3; ++a)
    {
      const double value = profile_[static_cast<std::size_t>(std::abs(d[a]))];
      direction[a] = d[a] < 0 ? -value : value;
      core[a] =
        d[a] == 0 ? gridCoordinate(u[a], m_[a], box_.half[a]) : std::copysign(box_.half[a], d[a]);
    }
    direction.normalize();
    const std::size_t point = static_cast<std::size_t>(this->id(d, u));
    mesh_.points[point] = box_.center + box_.axes * (core + radius_ * direction);
    mesh_.normals[point] = box_.axes * direction;
  }

  void placePoints()
  {
    // Each direction once, with all grid positions that go with it.
    for (int i = -n_; i <= n_; ++i)
    {
      const int rest = n_ - std::abs(i);
      for (int j = -rest; j <= rest; ++j)
      {
        const int k = rest - std::abs(j);
        this->placeAll({ i, j, k });
        if (k > 0)
        {
          this->placeAll({ i, j, -k });
        }
      }
    }
  }

  void placeAll(const Index3& d)
  {
    const auto last = [&](int a) { return d[a] == 0 ? m_[a] : 0; };
    for (int x = 0; x <= last(0); ++x)
    {
      for (int y = 0; y <= last(1); ++y)
      {
        for (int z = 0; z <= last(2); ++z)
        {
          this->place(d, { x, y, z });
        }
      }
    }
  }

  void addOctants(TriangleList& list) const
  {
    for (int octant = 0; octant < 8; ++octant)
    {
      const Index3 sign = { (octant & 1) ? -1 : 1, (octant & 2) ? -1 : 1, (octant & 4) ? -1 : 1 };
      const bool flip = sign[0] * sign[1] * sign[2] < 0;
      Index3 corner;
      for (int a = 0; a < 3; ++a)
      {
        corner[a] = sign[a] > 0 ? m_[a] : 0;
      }
      const auto at = [&](int i, int j, int k) {
        return this->id({ sign[0] * i, sign[1] * j, sign[2] * k }, corner);
      };
      for (int i = 0; i < n_; ++i)
      {
        for (int j = 0; i + j < n_; ++j)
        {
          const int k = n_ - 1 - i - j;
          list.add(at(i + 1, j, k), at(i, j + 1, k), at(i, j, k + 1), flip);
          if (k > 0)
          {
            list.add(at(i, j + 1, k), at(i + 1, j, k), at(i + 1, j + 1, k - 1), flip);
          }
        }
      }
    }
  }

  // The four quarter cylinders along axis a.
  void addQuadrants(int a, TriangleList& list) const
  {
    const int b = (a + 1) % 3;
    const int c = (a + 2) % 3;
    for (int quadrant = 0; quadrant < 4; ++quadrant)
    {
      const int signB = (quadrant & 1) ? -1 : 1;
      const int signC = (quadrant & 2) ? -1 : 1;
      const auto at = [&](int step, int t)
      {
        Index3 d;
        d[a] = 0;
        d[b] = signB * t;
        d[c] = signC * (n_ - t);
        Index3 u;
        u[a] = step;
        u[b] = signB > 0 ? m_[b] : 0;
        u[c] = signC > 0 ? m_[c] : 0;
        return this->id(d, u);
      };
      for (int t = 0; t < n_; ++t)
      {
        for (int step = 0; step < m_[a]; ++step)
        {
          const bool fromA = (2 * step + 1 < m_[a]) == (2 * t + 1 < n_);
          list.addCell(at(step, t), at(step + 1, t), at(step + 1, t + 1), at(step, t + 1), fromA,
            signB * signC < 0);
        }
      }
    }
  }

  const BoxShape& box_;
  double radius_;
  int n_ = 1;  // segments of a quarter circle
  Index3 m_{}; // cells along each length
  std::vector<double> profile_;
  Index3 firstOfArcs_{};
  Index3 firstOfFaces_{};
  TriangleMesh mesh_;
};

} // namespace

TriangleMesh meshRoundedBox(const BoxShape& box, double radius, double edgeLength)
{
  return RoundedBox(box, radius, edgeLength).make();
}

TriangleMesh meshSharpBox(const BoxShape& box, double edgeLength)
{
  const Vec3 cells = (box.half * (2.0 * std::sqrt(2.0) / edgeLength)).array().ceil();
  requireModestCount(
    4.0 * (cells[0] * cells[1] + cells[1] * cells[2] + cells[2] * cells[0]), edgeLength);
  const Index3 m = { static_cast<int>(cells[0]), static_cast<int>(cells[1]),
    static_cast<int>(cells[2]) };

  // Bottom and top are full grids of points, the layers between them closed loops.
  const int layer = (m[0] + 1) * (m[1] + 1);
  const int loop = 2 * (m[0] + m[1]);
  const auto id = [&](const Index3& u)
  {
    if (u[2] == 0 || u[2] == m[2])
    {
      return (u[2] == 0 ? 0 : layer) + u[1] * (m[0] + 1) + u[0];
    }
    const int along = u[1] == 0 ? u[0]
      : u[0] == m[0]            ? m[0] + u[1]
      : u[1] == m[1]            ? m[0] + m[1] + (m[0] - u[0])
                                : 2 * m[0] + m[1] + (m[1] - u[1]);
    return 2 * layer + (u[2] - 1) * loop + along;
  };

  TriangleMesh mesh;
  const std::size_t count = static_cast<std::size_t>(2 * layer + (m[2] - 1) * loop);
  mesh.points.resize(count);
  mesh.normals.assign(count, Vec3::Zero());
  TriangleList list(mesh.triangles, box.axes.determinant() < 0.0);
  addFaces(
    m,
    [&](int a, bool positive, const Index3& u)
    {
      const int point = id(u);
      const std::size_t k = static_cast<std::size_t>(point);
      Vec3 local;
      for (int b = 0; b < 3; ++b)
      {
        local[b] = gridCoordinate(u[b], m[b], box.half[b]);
      }
      mesh.points[k] = box.center + box.axes * local;
      // Each face once, however many of its cells ask.
      const Vec3 outward = positive ? Vec3(box.axes.col(a)) : Vec3(-box.axes.col(a));
      if (!(mesh.normals[k].dot(outward) > 0.5))
      {
        mesh.normals[k] += outward;
      }
      return point;
    },
    list);
  for (Vec3& normal : mesh.normals)
  {
    normal.normalize();
  }
  return mesh;
}

} // namespace hybridtree
