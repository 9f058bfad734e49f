// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{

/// The signs that Delaunay tetrahedralization and convection are made of, exact. A floating-point
/// filter, inline, decides nearly always; CGAL's kernel the rest. No threshold, no flat tetrahedra.

/// Of coordinates that differ by less or more than these, products may under- or overflow.
constexpr double kLeastDifference = 1e-30;
constexpr double kMostDifference = 1e30;

int exactSideOfPlane(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p);
int exactSideOfBall(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& p);
int exactSideOfLeastBall(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p);

/// 1 where p is on the side that the normal (b - a) x (c - a) points to, 0 in the plane.
inline int sideOfPlane(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p)
{
  const Vec3 u = b - a;
  const Vec3 v = c - a;
  const Vec3 w = p - a;
  const double det = w.x() * (u.y() * v.z() - u.z() * v.y()) +
    w.y() * (u.z() * v.x() - u.x() * v.z()) + w.z() * (u.x() * v.y() - u.y() * v.x());
  const Vec3 most = u.cwiseAbs().cwiseMax(v.cwiseAbs()).cwiseMax(w.cwiseAbs());
  // Shewchuk 1997: within (7 + 56 e) e of the sum of the products' sizes, here at most six.
  const double bound = 4.7e-15 * (most.x() * most.y() * most.z());
  if (std::abs(det) > bound && most.minCoeff() > kLeastDifference &&
    most.maxCoeff() < kMostDifference)
  {
    return det > 0.0 ? 1 : -1;
  }
  if (most.minCoeff() == 0.0) // all in one plane across an axis
  {
    return 0;
  }
  return exactSideOfPlane(a, b, c, p);
}

/// 1 where p is inside the ball through a, b, c, d, -1 outside, 0 on the sphere.
/// \pre d is on the side of a, b, c that the normal (b - a) x (c - a) points to.
inline int sideOfBall(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& p)
{
  const Vec3 A = a - p;
  const Vec3 B = b - p;
  const Vec3 C = c - p;
  const Vec3 D = d - p;
  const double ab = A.x() * B.y() - B.x() * A.y();
  const double bc = B.x() * C.y() - C.x() * B.y();
  const double cd = C.x() * D.y() - D.x() * C.y();
  const double da = D.x() * A.y() - A.x() * D.y();
  const double ac = A.x() * C.y() - C.x() * A.y();
  const double bd = B.x() * D.y() - D.x() * B.y();
  const double abc = A.z() * bc - B.z() * ac + C.z() * ab;
  const double bcd = B.z() * cd - C.z() * bd + D.z() * bc;
  const double cda = C.z() * da + D.z() * ac + A.z() * cd;
  const double dab = D.z() * ab + A.z() * bd + B.z() * da;
  const double liftA = A.squaredNorm();
  const double liftB = B.squaredNorm();
  const double liftC = C.squaredNorm();
  const double liftD = D.squaredNorm();
  const double det = (liftC * dab - liftD * abc) + (liftA * bcd - liftB * cda);
  const Vec3 most =
    A.cwiseAbs().cwiseMax(B.cwiseAbs()).cwiseMax(C.cwiseAbs().cwiseMax(D.cwiseAbs()));
  const double lift = std::max(std::max(liftA, liftB), std::max(liftC, liftD));
  // Shewchuk 1997: within (16 + 224 e) e of the sum of the products' sizes, here at most 24.
  const double bound = 4.3e-14 * (most.x() * most.y() * most.z() * lift);
  if (std::abs(det) > bound && most.minCoeff() > kLeastDifference &&
    most.maxCoeff() < kMostDifference)
  {
    return det > 0.0 ? 1 : -1;
  }
  return exactSideOfBall(a, b, c, d, p);
}

/// 1 where p is inside the smallest ball with a, b, c on its sphere, -1 outside, 0 on the sphere.
/// \pre a, b, c are not on one line.
inline int sideOfLeastBall(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p)
{
  const Vec3 u = b - a;
  const Vec3 v = c - a;
  const Vec3 w = p - a;
  const Vec3 n = u.cross(v);
  // Twice the centre, from a, times the square of n.
  const Vec3 center = u.squaredNorm() * v.cross(n) + v.squaredNorm() * n.cross(u);
  const double inside = w.dot(center) - w.squaredNorm() * n.squaredNorm();
  const double most = u.cwiseAbs().cwiseMax(v.cwiseAbs()).cwiseMax(w.cwiseAbs()).maxCoeff();
  // The sizes of all products add up to at most 108 times this power; none is the result of more
  // than 13 roundings.
  const double cube = most * most * most;
  const double bound = 1.6e-13 * (cube * cube);
  if (std::abs(inside) > bound && most > kLeastDifference && most < kMostDifference)
  {
    return inside > 0.0 ? 1 : -1;
  }
  return exactSideOfLeastBall(a, b, c, p);
}

} // namespace hybridtree
