// SPDX-License-Identifier: BSD-3-Clause
#include "tests/core/skeletons/PlateCases.h"

namespace hybridtree::test
{
namespace
{

Affine3 anywhere(Random& random)
{
  Affine3 map = Affine3::Identity();
  map.linear() = random.rotation();
  map.translation() = random.direction();
  return map;
}

PlateCase polygon(const char* name, std::vector<Vec3> corners, const Affine3& map)
{
  for (Vec3& corner : corners)
  {
    corner = map * corner;
  }
  return { name, std::make_shared<PolygonSkeleton>(corners), corners };
}

PlateCase rectangle(const Vec3& origin, const Vec3& a, const Vec3& b)
{
  return { "rectangle", std::make_shared<RectangleSkeleton>(origin, origin + a, origin + b),
    { origin, origin + a, origin + a + b, origin + b } };
}

PlateCase triangle(const Vec3& a, const Vec3& b, const Vec3& c)
{
  return { "triangle", std::make_shared<TriangleSkeleton>(a, b, c), { a, b, c } };
}

// A star-shaped outline with random radii: convex by luck only.
std::vector<Vec3> randomOutline(Random& random, int corners)
{
  std::vector<Vec3> points;
  for (int k = 0; k < corners; ++k)
  {
    const double turn = 2.0 * EIGEN_PI * (k + random.uniform(0.0, 0.6)) / corners;
    points.push_back(random.uniform(0.3, 1.2) * Vec3(std::cos(turn), std::sin(turn), 0.0));
  }
  return points;
}

Vec3 normalOf(const std::vector<Vec3>& corners)
{
  Vec3 normal = Vec3::Zero();
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    normal += (corners[k] - corners[0]).cross(corners[(k + 1) % corners.size()] - corners[0]);
  }
  return normal.normalized();
}

SkeletonCase ellipsoid(const Vec3& center, const Vec3& radii, const Mat3& rotation)
{
  constexpr int kSide = 150;
  SkeletonCase result{ "ellipsoid", std::make_shared<EllipsoidSkeleton>(center, radii, rotation),
    {}, 0.0, nullptr };
  for (int i = 0; i <= kSide; ++i)
  {
    for (int j = 0; j < 2 * kSide; ++j)
    {
      const double polar = EIGEN_PI * i / kSide;
      const double turn = EIGEN_PI * j / kSide;
      const Vec3 unit(
        std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar));
      result.samples.push_back(center + rotation * unit.cwiseProduct(radii));
    }
  }
  result.cover = EIGEN_PI / kSide * radii.maxCoeff();
  result.inside = [=](const Vec3& p)
  { return (rotation.transpose() * (p - center)).cwiseQuotient(radii).squaredNorm() < 1.0; };
  return result;
}

} // namespace

std::vector<Vec3> letterL()
{
  return { Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(2, 1, 0), Vec3(1, 1, 0), Vec3(1, 2, 0),
    Vec3(0, 2, 0) };
}

std::vector<Vec3> star(int points, double inner, double outer)
{
  std::vector<Vec3> corners;
  for (int k = 0; k < 2 * points; ++k)
  {
    const double turn = EIGEN_PI * k / points;
    corners.push_back((k % 2 ? inner : outer) * Vec3(std::cos(turn), std::sin(turn), 0.0));
  }
  return corners;
}

bool isInside(const std::vector<Vec3>& corners, const Vec3& p)
{
  const Vec3 normal = normalOf(corners);
  double turned = 0.0;
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    const Vec3 a = corners[k] - p;
    const Vec3 b = corners[(k + 1) % corners.size()] - p;
    turned += std::atan2(a.cross(b).dot(normal), a.dot(b));
  }
  return turned > EIGEN_PI;
}

std::vector<PlateCase> plateCases()
{
  Random random(41);
  std::vector<PlateCase> cases;
  for (int round = 0; round < 2; ++round)
  {
    cases.push_back(rectangle(random.direction(), random.direction(), random.direction()));
    cases.push_back(triangle(random.direction(), random.direction(), random.direction()));
    cases.push_back(polygon("polygon", randomOutline(random, 9), anywhere(random)));
  }
  cases.push_back(polygon("letter L", letterL(), anywhere(random)));
  cases.push_back(polygon("star", star(5, 0.5, 1.2), anywhere(random)));
  cases.push_back(polygon("convex polygon", star(6, 1.0, 1.0), anywhere(random)));
  cases.push_back(polygon("corners on a line",
    { Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(2, 1, 0), Vec3(0, 1, 0), Vec3(0, 0.5, 0) },
    Affine3::Identity()));
  std::vector<Vec3> clockwise = letterL();
  std::reverse(clockwise.begin(), clockwise.end());
  cases.push_back(polygon("clockwise", clockwise, anywhere(random)));
  cases.push_back(triangle(Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(1, 1e-3, 0)));
  cases.push_back(rectangle(Vec3(1, 2, 3), Vec3(2, 0, 0), Vec3(0, 1e-4, 1e-4)));
  return cases;
}

SkeletonCase withSamples(const PlateCase& plate)
{
  SkeletonCase result{ plate.name, plate.skeleton, {}, 0.0, nullptr };
  Box3 box;
  for (const Vec3& corner : plate.corners)
  {
    box.extend(corner);
  }
  // The outline, and a grid over the plane where it is inside.
  const double step = box.diagonal().norm() / 80.0;
  const Vec3 normal = normalOf(plate.corners);
  const Vec3 u = (plate.corners[1] - plate.corners[0]).normalized();
  const Vec3 v = normal.cross(u);
  for (std::size_t k = 0; k < plate.corners.size(); ++k)
  {
    const Vec3& a = plate.corners[k];
    const Vec3& b = plate.corners[(k + 1) % plate.corners.size()];
    const int count = static_cast<int>(std::ceil((b - a).norm() / step));
    for (int part = 0; part < count; ++part)
    {
      result.samples.push_back(a + (b - a) * (double(part) / count));
    }
  }
  for (int i = -80; i <= 80; ++i)
  {
    for (int j = -80; j <= 80; ++j)
    {
      const Vec3 p = plate.corners[0] + step * (i * u + j * v);
      if (isInside(plate.corners, p))
      {
        result.samples.push_back(p);
      }
    }
  }
  result.cover = 1.1 * step;
  return result;
}

std::vector<SkeletonCase> ellipsoidCases()
{
  Random random(42);
  std::vector<SkeletonCase> cases;
  for (const Vec3& radii : { Vec3(0.5, 1.1, 0.8), Vec3(1.2, 0.3, 0.7), Vec3(1, 1, 1),
         Vec3(0.9, 0.9, 0.1), Vec3(0.2, 1.3, 0.2), Vec3(1.2, 0.7, 0.01) })
  {
    cases.push_back(ellipsoid(random.direction(), radii, random.rotation()));
  }
  Mat3 mirror = random.rotation();
  mirror.col(0) *= -1.0;
  cases.push_back(ellipsoid(random.direction(), Vec3(0.6, 0.4, 0.9), mirror));
  return cases;
}

} // namespace hybridtree::test
