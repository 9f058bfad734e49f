// SPDX-License-Identifier: BSD-3-Clause
#include "tests/core/skeletons/RoundCases.h"

namespace hybridtree::test
{
namespace
{

using Vec2 = Eigen::Vector2d;

std::function<Vec2(double)> line(const Vec2& a, const Vec2& b)
{
  return [=](double t) { return Vec2(a + t * (b - a)); };
}

std::function<Vec2(double)> arc(const Vec2& center, double radius, double from, double to)
{
  return [=](double t)
  {
    const double angle = from + t * (to - from);
    return Vec2(center + radius * Vec2(std::cos(angle), std::sin(angle)));
  };
}

struct Axis
{
  Vec3 point1;
  Vec3 point2;
  double length() const { return (point2 - point1).norm(); }
};

RoundCase disc(const Vec3& center, const Vec3& normal, double radius)
{
  return { "disc", std::make_shared<DiscSkeleton>(center, normal, radius), center,
    normal.normalized(), { line(Vec2(0, 0), Vec2(radius, 0)) }, nullptr };
}

RoundCase along(const char* name, SkeletonPtr skeleton, const Axis& axis)
{
  return { name, std::move(skeleton), axis.point1, (axis.point2 - axis.point1).normalized(), {},
    nullptr };
}

RoundCase cone(const Axis& axis, double r1, double r2)
{
  const double h = axis.length();
  RoundCase result =
    along("cone", std::make_shared<ConeSkeleton>(axis.point1, axis.point2, r1, r2), axis);
  result.pieces = { line(Vec2(0, 0), Vec2(r1, 0)), line(Vec2(r1, 0), Vec2(r2, h)),
    line(Vec2(r2, h), Vec2(0, h)) };
  result.inside = [=](double radial, double height)
  { return 0.0 < height && height < h && radial * h < r1 * (h - height) + r2 * height; };
  return result;
}

RoundCase cylinder(const Axis& axis, double radius)
{
  RoundCase result = cone(axis, radius, radius);
  result.name = "cylinder";
  result.skeleton = std::make_shared<CylinderSkeleton>(axis.point1, axis.point2, radius);
  return result;
}

RoundCase hollowCylinder(const Axis& axis, double outer, double inner)
{
  const double h = axis.length();
  RoundCase result = along("hollow cylinder",
    std::make_shared<HollowCylinderSkeleton>(axis.point1, axis.point2, outer, inner), axis);
  result.pieces = { line(Vec2(inner, 0), Vec2(outer, 0)), line(Vec2(outer, 0), Vec2(outer, h)),
    line(Vec2(outer, h), Vec2(inner, h)) };
  if (inner > 0.0)
  {
    result.pieces.push_back(line(Vec2(inner, h), Vec2(inner, 0)));
  }
  result.inside = [=](double radial, double height)
  { return 0.0 < height && height < h && radial < outer && (radial > inner || inner == 0.0); };
  return result;
}

RoundCase coneSphere(const Axis& axis, double r1, double r2)
{
  RoundCase result = along(
    "cone sphere", std::make_shared<ConeSphereSkeleton>(axis.point1, axis.point2, r1, r2), axis);
  const double h = axis.length();
  const double right = 0.5 * double(EIGEN_PI);
  if (h <= std::abs(r1 - r2))
  {
    const double height = r1 > r2 ? 0.0 : h;
    const double radius = std::max(r1, r2);
    result.axis = h > 0.0 ? result.axis : Vec3(Vec3::UnitX());
    result.pieces = { arc(Vec2(0, height), radius, -right, right) };
    result.inside = [=](double x, double y) { return std::hypot(x, y - height) < radius; };
    return result;
  }
  const double tilt = std::asin((r1 - r2) / h);
  const Vec2 normal(std::cos(tilt), std::sin(tilt));
  result.pieces = { arc(Vec2(0, 0), r1, -right, tilt), line(r1 * normal, Vec2(0, h) + r2 * normal),
    arc(Vec2(0, h), r2, tilt, right) };
  // In one of the balls on the way.
  result.inside = [=](double x, double y)
  {
    const double t =
      std::clamp((y + x * (r2 - r1) / std::sqrt(h * h - (r2 - r1) * (r2 - r1))) / h, 0.0, 1.0);
    return std::hypot(x, y - t * h) < r1 + t * (r2 - r1);
  };
  return result;
}

} // namespace

std::vector<RoundCase> roundCases()
{
  Random random(31);
  std::vector<RoundCase> cases;
  const auto axis = [&]
  {
    const Vec3 start = random.direction();
    return Axis{ start, start + random.uniform(0.3, 2.0) * random.direction() };
  };
  const auto radius = [&] { return random.uniform(0.1, 1.2); };
  for (int round = 0; round < 3; ++round)
  {
    cases.push_back(disc(random.direction(), 3.0 * random.direction(), radius()));
    cases.push_back(cylinder(axis(), radius()));
    const double outer = radius();
    cases.push_back(hollowCylinder(axis(), outer, random.uniform(0.1, 0.9) * outer));
    cases.push_back(cone(axis(), radius(), radius()));
    const Axis between = axis();
    const double r1 = radius();
    cases.push_back(
      coneSphere(between, r1, std::abs(r1 + random.uniform(-0.9, 0.9) * between.length())));
  }
  const auto named = [&](RoundCase item, const char* name)
  {
    item.name = name;
    cases.push_back(std::move(item));
  };
  const Axis any = axis();
  named(disc(Vec3(1, 0, 0), Vec3(0, 1, 0), 0.0), "disc without radius");
  named(cylinder(any, 0.0), "cylinder without radius");
  named(cylinder({ Vec3(0, 0, 0), Vec3(0, 0, 1e-3) }, 1.0), "flat cylinder");
  named(hollowCylinder(any, 0.7, 0.0), "hollow cylinder without bore");
  named(hollowCylinder(any, 0.7, 0.7), "hollow cylinder without wall");
  named(cone(any, 0.6, 0.0), "pointed cone");
  named(cone(any, 0.0, 0.6), "pointed cone upside down");
  named(cone({ Vec3(0, 0, 0), Vec3(0, 0, 0.1) }, 1.5, 0.0), "flat cone");
  named(cone(any, 0.0, 0.0), "cone as segment");
  named(coneSphere(any, 0.3, 0.0), "cone sphere with a point");
  named(coneSphere(any, 0.4, 0.4), "cone sphere of equal balls");
  named(coneSphere({ Vec3(0, 0, 0), Vec3(0.1, 0.1, 0) }, 0.3, 0.7), "ball in a ball");
  named(coneSphere({ Vec3(0, 0, 0), Vec3(0.1, 0.1, 0) }, 0.7, 0.3), "ball that holds a ball");
  named(coneSphere({ Vec3(1, 2, 3), Vec3(1, 2, 3) }, 0.5, 0.5), "two equal balls in one place");
  named(coneSphere({ Vec3(1, 2, 3), Vec3(1, 2, 3) }, 0.0, 0.0), "cone sphere as point");
  return cases;
}

SkeletonCase withSamples(const RoundCase& round)
{
  constexpr int kSteps = 60;
  constexpr int kAround = 160;
  SkeletonCase result{ round.name, round.skeleton, {}, 0.0, nullptr };
  const Vec3 u = round.axis.unitOrthogonal();
  const Vec3 v = round.axis.cross(u);
  for (const auto& piece : round.pieces)
  {
    for (int step = 0; step <= kSteps; ++step)
    {
      const Vec2 place = piece(double(step) / kSteps);
      const int around = place.x() > 0.0 ? kAround : 1;
      for (int k = 0; k < around; ++k)
      {
        const double turn = 2.0 * double(EIGEN_PI) * k / around;
        result.samples.push_back(round.origin + place.y() * round.axis +
          place.x() * (std::cos(turn) * u + std::sin(turn) * v));
      }
      const double across =
        step > 0 ? 0.51 * (place - piece(double(step - 1) / kSteps)).norm() : 0.0;
      const double apart = double(EIGEN_PI) * place.x() / around;
      result.cover = std::max(result.cover, std::hypot(across, apart));
    }
  }
  if (round.inside)
  {
    result.inside = [round](const Vec3& p)
    {
      const Vec3 q = p - round.origin;
      const double height = round.axis.dot(q);
      return round.inside((q - height * round.axis).norm(), height);
    };
  }
  return result;
}

} // namespace hybridtree::test
