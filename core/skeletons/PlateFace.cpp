// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/PlateFace.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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
      face.triangles.push_back(fromA ? Triangle{ a, b, c } : Triangle{ a, b, d });
      face.triangles.push_back(fromA ? Triangle{ a, c, d } : Triangle{ b, c, d });
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
      face.triangles.push_back({ id(i, j), id(i + 1, j), id(i, j + 1) });
      if (i + j + 1 < n)
      {
        face.triangles.push_back({ id(i + 1, j), id(i + 1, j + 1), id(i, j + 1) });
      }
    }
  }
  return face;
}

// Rows of a triangular lattice, as far inside the outline as `margin`.
class LatticeFill
{
public:
  LatticeFill(const Corners& corners, double spacing)
    : corners_(corners), spacing_(spacing), margin_(0.6 * spacing)
  {
    for (const Vec2& corner : corners)
    {
      box_.extend(corner);
    }
  }

  void fill(PlanarTriangulation& triangulation)
  {
    const double height = std::sqrt(0.75) * spacing_;
    const int rows = static_cast<int>(std::ceil(box_.sizes().y() / height)) / 2 + 1;
    for (int row = -rows; row <= rows; ++row)
    {
      const double y = box_.center().y() + row * height;
      this->chooseSides(y);
      std::vector<Vec2> points = this->row(y, (row & 1) ? 0.5 : 0.0);
      if (row & 1)
      {
        std::reverse(points.begin(), points.end()); // to start where the last row ended
      }
      for (const Vec2& p : points)
      {
        triangulation.insert(p);
      }
    }
  }

private:
  Vec2 end(std::size_t side) const { return corners_[(side + 1) % corners_.size()]; }

  void chooseSides(double y)
  {
    near_.clear();
    for (std::size_t side = 0; side < corners_.size(); ++side)
    {
      const auto [low, high] = std::minmax(corners_[side].y(), this->end(side).y());
      if (low <= y + margin_ && high >= y - margin_)
      {
        near_.push_back(side);
      }
    }
  }

  std::vector<Vec2> row(double y, double shift) const
  {
    const int columns = static_cast<int>(std::ceil(box_.sizes().x() / spacing_)) / 2 + 1;
    std::vector<Vec2> points;
    for (int column = -columns; column <= columns; ++column)
    {
      const Vec2 p(box_.center().x() + (column + shift) * spacing_, y);
      if (this->isWellInside(p))
      {
        points.push_back(p);
      }
    }
    return points;
  }

  bool isWellInside(const Vec2& p) const
  {
    bool inside = false;
    for (const std::size_t side : near_)
    {
      const Vec2& a = corners_[side];
      const Vec2 b = this->end(side);
      const Vec2 edge = b - a;
      const double foot = std::clamp((p - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
      if ((p - a - foot * edge).squaredNorm() < margin_ * margin_)
      {
        return false;
      }
      if ((a.y() > p.y()) != (b.y() > p.y()))
      {
        inside ^= p.x() < a.x() + (p.y() - a.y()) * edge.x() / edge.y();
      }
    }
    return inside;
  }

  const Corners& corners_;
  double spacing_;
  double margin_;
  Eigen::AlignedBox2d box_;
  std::vector<std::size_t> near_;
};

PlateFace filledOutline(
  const Corners& corners, const std::vector<int>& counts, double spacing, double longest)
{
  PlanarTriangulation triangulation(corners);
  const std::vector<Vec2> outline = outlineOf(corners, counts);
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
  LatticeFill(corners, spacing).fill(triangulation);
  triangulation.smooth(6);
  triangulation.splitLongEdges(longest);
  triangulation.smooth(3);

  // The outline first, then what is inside.
  std::vector<int> number(triangulation.points().size(), -1);
  PlateFace face;
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
  return filledOutline(corners, counts, spacing, longest);
}

} // namespace hybridtree
