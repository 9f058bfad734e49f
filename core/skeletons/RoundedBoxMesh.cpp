// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/OffsetMesh.h"

#include "core/base/Error.h"
#include "core/skeletons/BoxGrid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
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
    mesh_.triangles.resize(static_cast<std::size_t>(this->triangleCount(n_, m_[0], m_[1], m_[2])));
    next_ = mesh_.triangles.data();
    mirrored_ = box_.axes.determinant() < 0.0;
    this->addOctants();
    for (int a = 0; a < 3; ++a)
    {
      this->addQuadrants(a);
      this->addFaces(a);
    }
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

  // The direction d in the first octant, along the axes of the box.
  Vec3 direction(int i, int j, int k) const
  {
    return Vec3(profile_[static_cast<std::size_t>(i)], profile_[static_cast<std::size_t>(j)],
      profile_[static_cast<std::size_t>(k)])
      .normalized();
  }

  Vec3 cornerAt(const Vec3& signs) const
  {
    return box_.center + box_.axes * box_.half.cwiseProduct(signs);
  }

  void placePoints()
  {
    this->placeOctants();
    for (int a = 0; a < 3; ++a)
    {
      this->placeArcs(a);
      this->placeFaces(a);
    }
  }

  // Each direction is made once, and mirrored: normals of the octants differ by signs along the
  // axes of the box.
  void placeOctants()
  {
    const int size = this->octantSize();
    Vec3 corners[8];
    for (int octant = 0; octant < 8; ++octant)
    {
      corners[octant] = this->cornerAt(signsOf(octant));
    }
    int inOctant = 0;
    for (int i = 1; i < n_ - 1; ++i)
    {
      for (int j = 1; i + j < n_; ++j, ++inOctant)
      {
        const Vec3 d = this->direction(i, j, n_ - i - j);
        const Vec3 x = d[0] * box_.axes.col(0);
        const Vec3 y = d[1] * box_.axes.col(1);
        const Vec3 z = d[2] * box_.axes.col(2);
        const Vec3 sums[4] = { x + y, y - x, x - y, -x - y };
        for (int octant = 0; octant < 8; ++octant)
        {
          const Vec3 normal = octant & 4 ? Vec3(sums[octant & 3] - z) : Vec3(sums[octant & 3] + z);
          const std::size_t point = static_cast<std::size_t>(octant * size + inOctant);
          mesh_.normals[point] = normal;
          mesh_.points[point] = corners[octant] + radius_ * normal;
        }
      }
    }
  }

  // The arcs across axis a, each at every grid position along it.
  void placeArcs(int a)
  {
    const int b = (a + 1) % 3;
    const int c = (a + 2) % 3;
    std::size_t point = static_cast<std::size_t>(firstOfArcs_[a]);
    for (int quadrant = 0; quadrant < 4; ++quadrant)
    {
      Vec3 signs = Vec3::Zero();
      signs[b] = (quadrant & 1) ? -1.0 : 1.0;
      signs[c] = (quadrant & 2) ? -1.0 : 1.0;
      const Vec3 edge = this->cornerAt(signs);
      for (int t = 1; t < n_; ++t)
      {
        const Vec3 d = this->direction(0, t, n_ - t);
        const Vec3 normal = signs[b] * d[1] * box_.axes.col(b) + signs[c] * d[2] * box_.axes.col(c);
        const Vec3 middle = edge + radius_ * normal;
        for (int step = 0; step <= m_[a]; ++step, ++point)
        {
          mesh_.normals[point] = normal;
          mesh_.points[point] =
            middle + gridCoordinate(step, m_[a], box_.half[a]) * box_.axes.col(a);
        }
      }
    }
  }

  // The two faces across axis a.
  void placeFaces(int a)
  {
    const int b = (a + 1) % 3;
    const int c = (a + 2) % 3;
    std::size_t point = static_cast<std::size_t>(firstOfFaces_[a]);
    for (const double side : { 1.0, -1.0 })
    {
      const Vec3 normal = side * box_.axes.col(a);
      const Vec3 middle = box_.center + (box_.half[a] + radius_) * normal;
      for (int u = 0; u <= m_[b]; ++u)
      {
        const Vec3 row = middle + gridCoordinate(u, m_[b], box_.half[b]) * box_.axes.col(b);
        for (int v = 0; v <= m_[c]; ++v, ++point)
        {
          mesh_.normals[point] = normal;
          mesh_.points[point] = row + gridCoordinate(v, m_[c], box_.half[c]) * box_.axes.col(c);
        }
      }
    }
  }

  static Vec3 signsOf(int octant)
  {
    return Vec3((octant & 1) ? -1.0 : 1.0, (octant & 2) ? -1.0 : 1.0, (octant & 4) ? -1.0 : 1.0);
  }

  void add(int a, int b, int c, bool flip)
  {
    *next_++ = flip != mirrored_ ? Triangle{ a, c, b } : Triangle{ a, b, c };
  }

  // Cells between two rows of points that run alike: cut from a to c or from b to d, towards the
  // middle of the whole, so that mirror images agree.
  void addCells(const int* row, const int* nextRow, int count, bool firstHalf, bool flip)
  {
    for (int k = 0; k < count; ++k)
    {
      const int a = row[k];
      const int b = row[k + 1];
      const int c = nextRow[k + 1];
      const int d = nextRow[k];
      if ((2 * k + 1 < count) == firstHalf)
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
  }

  void addOctants()
  {
    // The points with i steps towards the first axis, in order of j; only the ends of a row are
    // shared with other parts.
    std::vector<int> row(static_cast<std::size_t>(n_) + 1);
    std::vector<int> nextRow(row.size());
    for (int octant = 0; octant < 8; ++octant)
    {
      const Index3 sign = { (octant & 1) ? -1 : 1, (octant & 2) ? -1 : 1, (octant & 4) ? -1 : 1 };
      const bool flip = sign[0] * sign[1] * sign[2] < 0;
      Index3 corner;
      for (int a = 0; a < 3; ++a)
      {
        corner[a] = sign[a] > 0 ? m_[a] : 0;
      }
      const auto fill = [&](int i, std::vector<int>& ids)
      {
        for (int j = 0; j <= n_ - i; ++j)
        {
          ids[static_cast<std::size_t>(j)] =
            this->id({ sign[0] * i, sign[1] * j, sign[2] * (n_ - i - j) }, corner);
        }
      };
      fill(0, row);
      for (int i = 0; i < n_; ++i)
      {
        fill(i + 1, nextRow);
        const int* low = row.data();
        const int* high = nextRow.data();
        const int last = n_ - 1 - i;
        for (int j = 0; j < last; ++j)
        {
          this->add(high[j], low[j + 1], low[j], flip);
          this->add(low[j + 1], high[j], high[j + 1], flip);
        }
        this->add(high[last], low[last + 1], low[last], flip);
        row.swap(nextRow);
      }
    }
  }

  // The four quarter cylinders along axis a.
  void addQuadrants(int a)
  {
    const int b = (a + 1) % 3;
    const int c = (a + 2) % 3;
    std::vector<int> row(static_cast<std::size_t>(m_[a]) + 1);
    std::vector<int> nextRow(row.size());
    for (int quadrant = 0; quadrant < 4; ++quadrant)
    {
      const int signB = (quadrant & 1) ? -1 : 1;
      const int signC = (quadrant & 2) ? -1 : 1;
      const auto fill = [&](int t, std::vector<int>& ids)
      {
        Index3 d{};
        d[b] = signB * t;
        d[c] = signC * (n_ - t);
        Index3 u;
        u[b] = signB > 0 ? m_[b] : 0;
        u[c] = signC > 0 ? m_[c] : 0;
        for (u[a] = 0; u[a] <= m_[a]; ++u[a])
        {
          ids[static_cast<std::size_t>(u[a])] = this->id(d, u);
        }
      };
      fill(0, row);
      for (int t = 0; t < n_; ++t)
      {
        fill(t + 1, nextRow);
        this->addCells(row.data(), nextRow.data(), m_[a], 2 * t + 1 < n_, signB * signC < 0);
        row.swap(nextRow);
      }
    }
  }

  // The two faces across axis a.
  void addFaces(int a)
  {
    const int b = (a + 1) % 3;
    const int c = (a + 2) % 3;
    std::vector<int> row(static_cast<std::size_t>(m_[c]) + 1);
    std::vector<int> nextRow(row.size());
    for (const bool positive : { true, false })
    {
      std::iota(nextRow.begin(), nextRow.end(),
        firstOfFaces_[a] + (positive ? 0 : (m_[b] + 1) * (m_[c] + 1)));
      for (int u = 0; u < m_[b]; ++u)
      {
        row.swap(nextRow);
        std::iota(nextRow.begin(), nextRow.end(), row.front() + m_[c] + 1);
        // Rows run along c, the second axis: the outside is on the other side.
        this->addCells(row.data(), nextRow.data(), m_[c], 2 * u + 1 < m_[b], positive);
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
  Triangle* next_ = nullptr; // to be written
  bool mirrored_ = false;
};

} // namespace

TriangleMesh meshRoundedBox(const BoxShape& box, double radius, double edgeLength)
{
  return RoundedBox(box, radius, edgeLength).make();
}

} // namespace hybridtree
