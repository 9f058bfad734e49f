// SPDX-License-Identifier: BSD-3-Clause
#include "core/polygonize/CreasePlanes.h"

#include <Eigen/Eigenvalues>

namespace hybridtree
{
namespace
{

constexpr double kEdgeRank = 0.004;  // least second and
constexpr double kCornerRank = 0.03; // third eigenvalue, to the first

} // namespace

TouchingPlane TouchingPlane::of(const Vec3& at, double value, const Vec3& gradient)
{
  const double slope = gradient.norm();
  return { gradient / -slope, at, (value - kThreshold) / slope, slope };
}

namespace
{

/// Of the sum of the squared distances to planes: axes by rising eigenvalues.
struct Axes
{
  Vec3 values;
  Mat3 vectors;
};

Axes axesOf(const TouchingPlanes& planes)
{
  Mat3 squares = Mat3::Zero();
  for (const TouchingPlane& plane : planes)
  {
    squares += plane.normal * plane.normal.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(squares);
  return { solver.eigenvalues(), solver.eigenvectors() };
}

/// Of two, by their halves: unit normals have their mean, and their difference, as axes.
Axes axesOf(const TouchingPlane& a, const TouchingPlane& b)
{
  const double cosine = a.normal.dot(b.normal);
  const Vec3 sum = a.normal + b.normal;
  const Vec3 difference = a.normal - b.normal;
  const Vec3& large = cosine >= 0.0 ? sum : difference;
  const Vec3& small = cosine >= 0.0 ? difference : sum;
  Axes axes;
  axes.values = { 0.0, 1.0 - std::abs(cosine), 1.0 + std::abs(cosine) };
  axes.vectors.col(2) = large.normalized();
  axes.vectors.col(1) = small.normalized();
  axes.vectors.col(0) = axes.vectors.col(1).cross(axes.vectors.col(2));
  return axes;
}

} // namespace

Meeting meetingOf(const TouchingPlanes& planes, const Vec3& near, double reach)
{
  Vec3 sum = Vec3::Zero();
  for (const TouchingPlane& plane : planes)
  {
    sum -= plane.normal * plane.distance(near);
  }
  const auto [value, axis] = planes.size() == 2 ? axesOf(planes[0], planes[1]) : axesOf(planes);
  if (!(value[1] > kEdgeRank * value[2]))
  {
    return {};
  }
  Vec3 move = axis.col(2) * (axis.col(2).dot(sum) / value[2]) +
    axis.col(1) * (axis.col(1).dot(sum) / value[1]);
  Vec3 edge = axis.col(0);
  if (value[0] > kCornerRank * value[2])
  {
    const Vec3 along = edge * (edge.dot(sum) / value[0]);
    if ((move + along).norm() <= reach)
    {
      move += along;
      edge.setZero();
    }
  }
  return { move.norm() <= reach, near + move, edge };
}

PlanePair widestPair(const TouchingPlanes& planes)
{
  PlanePair pair;
  double least = 2.0;
  for (std::size_t a = 0; a < planes.size(); ++a)
  {
    for (std::size_t b = a + 1; b < planes.size(); ++b)
    {
      const double cosine = planes[a].normal.dot(planes[b].normal);
      if (cosine < least)
      {
        least = cosine;
        pair.first = a;
        pair.second = b;
      }
    }
  }
  pair.angle = std::acos(std::clamp(least, -1.0, 1.0));
  return pair;
}

Vec3 middleNormal(const TouchingPlanes& planes, double leastAngle)
{
  const PlanePair widest = widestPair(planes);
  std::vector<Vec3> faces{ planes[widest.first].normal, planes[widest.second].normal };
  Vec3 sum = faces[0] + faces[1];
  for (const TouchingPlane& plane : planes)
  {
    const bool known = std::any_of(faces.begin(), faces.end(),
      [&](const Vec3& face) { return face.dot(plane.normal) > std::cos(leastAngle); });
    if (!known)
    {
      faces.push_back(plane.normal);
      sum += plane.normal;
    }
  }
  return sum;
}

void LinePart::clip(double height, double slope)
{
  begin = slope > 0.0 ? std::max(begin, -height / slope) : begin;
  end = slope < 0.0 ? std::min(end, -height / slope) : end;
  end = slope == 0.0 && height < 0.0 ? -std::numeric_limits<double>::infinity() : end;
}

} // namespace hybridtree
