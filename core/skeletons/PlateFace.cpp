// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/PlateFace.h"

#include "core/mesh/AddTriangle.h"
#include "core/skeletons/PlateFill.h"
#include "core/skeletons/PlateLattice.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace hybridtree
{
namespace
{

using Corners = std::vector<Vec2>;

bool isParallelogram(const Corners& c)
{
  if (c.size() != 4)
  {
    return false;
  }
  const double size = (c[2] - c[0]).norm() + (c[3] - c[1]).norm();
  return (c[0] - c[1] + c[2] - c[3]).norm() <= 1e-12 * size;
}

// Cosine of the angle between the sides of a parallelogram.
double skew(const Corners& c)
{
  return (c[1] - c[0]).normalized().dot((c[3] - c[0]).normalized());
}

// Sides too different, or too skew, for triangles of a grid to be good ones.
bool isEvenParallelogram(const Corners& c)
{
  return isParallelogram(c) && std::abs(skew(c)) <= std::cos(EIGEN_PI * 50.0 / 180.0);
}

bool isEvenTriangle(const Corners& c)
{
  if (c.size() != 3)
  {
    return false;
  }
  const Vec3 lengths((c[1] - c[0]).norm(), (c[2] - c[1]).norm(), (c[0] - c[2]).norm());
  return lengths.minCoeff() >= 0.8 * lengths.maxCoeff();
}

// A mirror of the outline that swaps corners k and sum - k, counted around.
struct Mirror
{
  int sum;
  Vec2 start; // where the axis meets the outline: corner sum / 2, or the middle of the side there
  Vec2 end;   // the same half way around
};

// One whose axis meets the outline nowhere else, so that either half is simple.
std::optional<Mirror> mirrorOf(const Corners& c)
{
  const int n = static_cast<int>(c.size());
  Eigen::AlignedBox2d box;
  for (const Vec2& corner : c)
  {
    box.extend(corner);
  }
  const double rounding = 1e-11 * box.sizes().norm();
  const auto at = [&](int k) { return c[static_cast<std::size_t>((k + n) % n)]; };
  const auto middle = [&](int sum) { return Vec2(0.5 * (at(sum / 2) + at((sum + 1) / 2))); };
  for (int sum = 0; sum < n; ++sum)
  {
    const Mirror mirror{ sum, middle(sum), middle(sum + n) };
    const Vec2 along = (mirror.end - mirror.start).normalized();
    bool fits = true;
    // Corners on the way from start to end are on the right of the axis.
    for (int k = sum / 2 + 1; fits && 2 * k < sum + n; ++k)
    {
      const Vec2 p = at(k) - mirror.start;
      const double right = p.x() * along.y() - p.y() * along.x();
      const Vec2 image = at(k) + 2.0 * right * Vec2(-along.y(), along.x());
      fits = right > rounding && (image - at(sum - k)).norm() <= rounding;
    }
    if (fits)
    {
      return mirror;
    }
  }
  return std::nullopt;
}

// The points of the outline, in order.
std::vector<Vec2> outlineOf(const Corners& corners, const std::vector<int>& counts)
{
  std::vector<Vec2> points;
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    const Vec2& a = corners[k];
    const Vec2& b = corners[(k + 1) % corners.size()];
    for (int step = 0; step < counts[k]; ++step)
    {
      // Weights from either end alike, for symmetry.
      points.push_back((double(counts[k] - step) * a + double(step) * b) / double(counts[k]));
    }
  }
  return points;
}

PlateFace gridOfParallelogram(const Corners& corners, const std::vector<int>& counts)
{
  PlateFace face;
  face.points = outlineOf(corners, counts);
  const int m = counts[0];
  const int n = counts[1];
  const Vec2 middle = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
  const Vec2 x = 0.5 * (corners[1] - corners[0]);
  const Vec2 y = 0.5 * (corners[3] - corners[0]);
  const int firstInner = 2 * (m + n);
  for (int j = 1; j < n; ++j)
  {
    for (int i = 1; i < m; ++i)
    {
      face.points.push_back(
        middle + x * (double(2 * i - m) / double(m)) + y * (double(2 * j - n) / double(n)));
    }
  }
  const auto id = [&](int i, int j)
  {
    return j == 0 ? i
      : i == m    ? m + j
      : j == n    ? m + n + (m - i)
      : i == 0    ? 2 * m + n + (n - j)
                  : firstInner + (j - 1) * (m - 1) + i - 1;
  };
  const double lean = skew(corners);
  // Right angles have their diagonals either way.
  const double diagonal = std::abs(lean) < 0.02
    ? std::max((x / m + y / n).norm(), (x / m - y / n).norm())
    : lean < 0.0 ? (x / m + y / n).norm()
                 : (x / m - y / n).norm();
  face.longest = 2.0 * std::max({ x.norm() / m, y.norm() / n, diagonal });
  face.triangles.reserve(static_cast<std::size_t>(2 * m * n));
  for (int j = 0; j < n; ++j)
  {
    for (int i = 0; i < m; ++i)
    {
      const int a = id(i, j);
      const int b = id(i + 1, j);
      const int c = id(i + 1, j + 1);
      const int d = id(i, j + 1);
      // The shorter diagonal; of right angles the one towards the middle, so that all mirror
      // images of the grid are the grid.
      const bool upright = std::abs(lean) < 0.02;
      const bool fromA = upright ? (2 * i + 1 < m) == (2 * j + 1 < n) : lean < 0.0;
      addTriangle(face.triangles, a, b, fromA ? c : d);
      addTriangle(face.triangles, fromA ? a : b, c, d);
    }
  }
  return face;
}

// Triangles similar to the whole.
PlateFace gridOfTriangle(const Corners& corners, int n)
{
  PlateFace face;
  face.points = outlineOf(corners, { n, n, n });
  const int firstInner = 3 * n;
  std::vector<int> firstOfRow(static_cast<std::size_t>(n) + 1, firstInner);
  // Point (i, j) is i steps from corner 0 towards corner 1, and j towards corner 2.
  for (int j = 1; j < n; ++j)
  {
    firstOfRow[static_cast<std::size_t>(j)] = static_cast<int>(face.points.size());
    for (int i = 1; i + j < n; ++i)
    {
      face.points.push_back(
        (double(n - i - j) * corners[0] + double(i) * corners[1] + double(j) * corners[2]) /
        double(n));
    }
  }
  face.longest = std::max({ (corners[1] - corners[0]).norm(), (corners[2] - corners[1]).norm(),
                   (corners[0] - corners[2]).norm() }) /
    n;
  const auto id = [&](int i, int j)
  {
    return j == 0  ? i
      : i + j == n ? n + j
      : i == 0     ? 3 * n - j
                   : firstOfRow[static_cast<std::size_t>(j)] + i - 1;
  };
  for (int j = 0; j < n; ++j)
  {
    for (int i = 0; i + j < n; ++i)
    {
      addTriangle(face.triangles, id(i, j), id(i + 1, j), id(i, j + 1));
      if (i + j + 1 < n)
      {
        addTriangle(face.triangles, id(i + 1, j), id(i + 1, j + 1), id(i, j + 1));
      }
    }
  }
  return face;
}

void insertLattice(const Corners& corners, double spacing, PlanarTriangulation& triangulation)
{
  const PlateLattice lattice(corners, spacing, 0.6 * spacing);
  for (const PlateLattice::Run& run : lattice.runs())
  {
    for (int x = run.first; x <= run.last; x += 2)
    {
      // There and back, to start where the last row ended.
      triangulation.insert(lattice.place(run.y & 1 ? run.first + run.last - x : x, run.y));
    }
  }
}

PlateFace filledOutline(
  const Corners& corners, const std::vector<int>& counts, double spacing, double longest)
{
  const std::vector<Vec2> outline = outlineOf(corners, counts);
  if (auto face = fillOutline(corners, outline, spacing, longest))
  {
    return std::move(*face);
  }
  // Narrow ones, point by point.
  PlanarTriangulation triangulation(corners);
  std::vector<int> order; // numbers of the outline's points in the triangulation
  int next = 0;
  for (std::size_t corner = 0; corner < corners.size(); ++corner)
  {
    int at = static_cast<int>(corner);
    order.push_back(at);
    ++next;
    for (int step = 1; step < counts[corner]; ++step)
    {
      at = triangulation.splitOutline(at, outline[static_cast<std::size_t>(next++)]);
      order.push_back(at);
    }
  }
  insertLattice(corners, spacing, triangulation);
  triangulation.smooth(6);
  triangulation.splitLongEdges(longest);
  triangulation.smooth(3);

  // The outline first, then what is inside.
  std::vector<int> number(triangulation.points().size(), -1);
  PlateFace face;
  face.longest = triangulation.longestEdge();
  for (const int point : order)
  {
    number[static_cast<std::size_t>(point)] = static_cast<int>(face.points.size());
    face.points.push_back(triangulation.points()[static_cast<std::size_t>(point)]);
  }
  for (std::size_t k = 0; k < number.size(); ++k)
  {
    if (number[k] < 0)
    {
      number[k] = static_cast<int>(face.points.size());
      face.points.push_back(triangulation.points()[k]);
    }
  }
  for (const auto& [a, b, c] : triangulation.triangles())
  {
    face.triangles.push_back({ number[static_cast<std::size_t>(a)],
      number[static_cast<std::size_t>(b)], number[static_cast<std::size_t>(c)] });
  }
  return face;
}

// One half filled, the other its image.
PlateFace mirroredOutline(const Corners& corners, const Mirror& mirror,
  const std::vector<int>& counts, double spacing, double longest)
{
  const int n = static_cast<int>(corners.size());
  Corners half = { mirror.start };
  std::vector<int> halfCounts;
  int firstPoint = 0; // number of the outline's point at the start
  for (int k = 0; k < mirror.sum / 2; ++k)
  {
    firstPoint += counts[static_cast<std::size_t>(k)];
  }
  // Sides from start to end: the first and the last may be halves.
  const int firstSide = mirror.sum / 2;
  const int lastSide = (mirror.sum + n - 1) / 2;
  for (int k = firstSide; k <= lastSide; ++k)
  {
    const int count = counts[static_cast<std::size_t>(k % n)];
    const bool isHalf = 2 * k + 1 == mirror.sum || 2 * k + 1 == mirror.sum + n;
    firstPoint += 2 * k + 1 == mirror.sum ? count / 2 : 0;
    halfCounts.push_back(isHalf ? count / 2 : count);
    half.push_back(k == lastSide ? mirror.end : corners[static_cast<std::size_t>((k + 1) % n)]);
  }
  const int across = std::accumulate(halfCounts.begin(), halfCounts.end(), 0);
  const double axis = (mirror.end - mirror.start).norm();
  halfCounts.push_back(std::max(1, static_cast<int>(std::ceil(axis / spacing - 1e-9))));
  const int onAxis = halfCounts.back() - 1;
  const PlateFace filled = filledOutline(half, halfCounts, spacing, longest);

  PlateFace face;
  face.longest = filled.longest;
  face.points = outlineOf(corners, counts);
  const int total = static_cast<int>(face.points.size());
  const int inner = static_cast<int>(filled.points.size()) - across - 1;
  const auto id = [&](int p, int side)
  {
    return p <= across       ? (firstPoint + side * p + total) % total
      : p <= across + onAxis ? total + p - across - 1
                             : total + p - across - 1 + (side < 0 ? inner - onAxis : 0);
  };
  face.points.insert(face.points.end(), filled.points.begin() + across + 1, filled.points.end());
  const Vec2 along = (mirror.end - mirror.start).normalized();
  const Vec2 left(-along.y(), along.x());
  for (std::size_t k = static_cast<std::size_t>(across + 1 + onAxis); k < filled.points.size(); ++k)
  {
    const Vec2& p = filled.points[k];
    face.points.push_back(p - 2.0 * left.dot(p - mirror.start) * left);
  }
  face.triangles.reserve(2 * filled.triangles.size());
  for (const auto& [a, b, c] : filled.triangles)
  {
    addTriangle(face.triangles, id(a, 1), id(b, 1), id(c, 1));
    addTriangle(face.triangles, id(a, -1), id(c, -1), id(b, -1));
  }
  return face;
}

} // namespace

std::vector<int> sideCounts(const std::vector<Vec2>& corners, double spacing)
{
  std::vector<int> counts;
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    const double length = (corners[(k + 1) % corners.size()] - corners[k]).norm();
    counts.push_back(std::max(1, static_cast<int>(std::ceil(length / spacing - 1e-9))));
  }
  // Grids have as many on opposite sides, whatever rounding says of their lengths.
  if (isParallelogram(corners))
  {
    counts[2] = counts[0];
    counts[3] = counts[1];
  }
  if (isEvenTriangle(corners))
  {
    counts.assign(3, *std::max_element(counts.begin(), counts.end()));
  }
  else if (const auto mirror = mirrorOf(corners))
  {
    const int n = static_cast<int>(corners.size());
    for (int k = 0; k < n; ++k)
    {
      // From corner k to the next, and back from the image of the next to that of k.
      const int image = (mirror->sum - k - 1 + n) % n;
      int& count = counts[static_cast<std::size_t>(k)];
      count = std::max(count, counts[static_cast<std::size_t>(image)]);
      count += k == image ? count % 2 : 0; // a point on the axis
      counts[static_cast<std::size_t>(image)] = count;
    }
  }
  return counts;
}

PlateFace meshFace(
  const std::vector<Vec2>& corners, const std::vector<int>& counts, double spacing, double longest)
{
  if (isEvenParallelogram(corners))
  {
    return gridOfParallelogram(corners, counts);
  }
  if (isEvenTriangle(corners))
  {
    return gridOfTriangle(corners, counts[0]);
  }
  if (const auto mirror = mirrorOf(corners))
  {
    return mirroredOutline(corners, *mirror, counts, spacing, longest);
  }
  return filledOutline(corners, counts, spacing, longest);
}

} // namespace hybridtree
