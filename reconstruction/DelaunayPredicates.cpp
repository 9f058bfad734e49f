// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/DelaunayPredicates.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace hybridtree
{
namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 toCgal(const Vec3& p)
{
  return { p.x(), p.y(), p.z() };
}

} // namespace

int exactSideOfPlane(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p)
{
  return static_cast<int>(
    Kernel().orientation_3_object()(toCgal(a), toCgal(b), toCgal(c), toCgal(p)));
}

int exactSideOfBall(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& p)
{
  return static_cast<int>(Kernel().side_of_oriented_sphere_3_object()(
    toCgal(a), toCgal(b), toCgal(c), toCgal(d), toCgal(p)));
}

int exactSideOfLeastBall(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p)
{
  return static_cast<int>(
    Kernel().side_of_bounded_sphere_3_object()(toCgal(a), toCgal(b), toCgal(c), toCgal(p)));
}

} // namespace hybridtree
