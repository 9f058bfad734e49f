// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/SkeletonShapes.h"

#include <cmath>

namespace hybridtree::test
{
namespace
{

const double kPi = std::acos(-1.0);

class Builder
{
public:
  std::int32_t point(const Vec3& at, double radius)
  {
    graph.points.push_back(at);
    graph.radii.push_back(radius);
    return std::int32_t(graph.points.size() - 1);
  }

  // n segments from a point that is there along a curve that sags by `bow`; returns the last point.
  std::int32_t limb(
    std::int32_t from, const Vec3& to, int n, double endRadius, const Vec3& bow = Vec3::Zero())
  {
    return bridge(from, point(to, endRadius), n, bow);
  }

  // The same between two points that are there.
  std::int32_t bridge(std::int32_t from, std::int32_t to, int n, const Vec3& bow = Vec3::Zero())
  {
    const Vec3 a = graph.points[from];
    const Vec3 b = graph.points[to];
    const double ra = graph.radii[from];
    const double rb = graph.radii[to];
    std::int32_t last = from;
    for (int k = 1; k <= n; ++k)
    {
      const double t = double(k) / n;
      const std::int32_t next =
        k == n ? to : point(a + t * (b - a) + 4.0 * t * (1.0 - t) * bow, ra + t * (rb - ra));
      graph.segments.push_back({ last, next });
      last = next;
    }
    return last;
  }

  void triangle(std::int32_t a, std::int32_t b, std::int32_t c)
  {
    graph.triangles.push_back({ a, b, c });
  }

  SkeletonGraph graph;
};

void addArm(Builder& alien, std::int32_t shoulder, double side)
{
  const std::int32_t hand =
    alien.limb(shoulder, { side * 2.6, 0.6, 2.6 }, 8, 0.16, { side * 0.3, -0.2, -0.5 });
  for (int finger = 0; finger < 4; ++finger)
  {
    const double turn = (finger - 1.5) * 0.45;
    const Vec3 tip =
      Vec3(side * 2.6, 0.6, 2.6) + 0.8 * Vec3(side * std::cos(turn), 0.3, std::sin(turn));
    alien.limb(hand, tip, 3, 0.07, { 0.0, 0.08, 0.0 });
  }
}

void addLeg(Builder& alien, std::int32_t hip, double side)
{
  const Vec3 ankle(side * 1.0, 0.3, -2.4);
  const std::int32_t foot = alien.limb(hip, ankle, 9, 0.2, { side * 0.4, 0.5, 0.0 });
  for (int toe = 0; toe < 3; ++toe)
  {
    const double turn = (toe - 1) * 0.6;
    alien.limb(foot, ankle + 0.6 * Vec3(std::sin(turn), std::cos(turn), -0.3), 2, 0.09);
  }
}

void addHead(Builder& alien, std::int32_t hub)
{
  const Vec3 center = alien.graph.points[hub];
  std::int32_t rim[5];
  for (int k = 0; k < 5; ++k)
  {
    const double turn = 0.4 * kPi * k + 0.5 * kPi;
    rim[k] = alien.point(center + 0.7 * Vec3(std::cos(turn), 0.6 * std::sin(turn), 0.15), 0.3);
  }
  for (int k = 0; k < 5; ++k)
  {
    alien.triangle(hub, rim[k], rim[(k + 1) % 5]);
  }
  for (const double side : { -1.0, 1.0 })
  {
    const std::int32_t cheek = rim[side < 0.0 ? 1 : 4];
    const Vec3 at = alien.graph.points[cheek] + Vec3(side * 0.3, 0.0, 0.1);
    const std::int32_t root = alien.limb(cheek, at, 1, 0.2);
    const std::int32_t a = alien.point(at + Vec3(side * 0.35, 0.1, 0.45), 0.2);
    const std::int32_t b = alien.point(at + Vec3(side * 0.55, -0.1, 0.0), 0.2);
    const std::int32_t c = alien.point(at + Vec3(side * 1.2, 0.1, 0.7), 0.08);
    const std::int32_t d = alien.point(at + Vec3(side * 1.4, -0.1, 0.2), 0.08);
    alien.triangle(root, b, a);
    alien.triangle(a, b, c);
    alien.triangle(c, b, d);
    alien.limb(
      rim[side < 0.0 ? 2 : 3], center + Vec3(side * 0.6, 0.8, 1.3), 5, 0.07, { 0.0, -0.2, 0.1 });
  }
}

} // namespace

SkeletonGraph bretzel()
{
  Builder shape;
  std::int32_t ring[16];
  for (int k = 0; k < 16; ++k)
  {
    const double turn = 2.0 * kPi * k / 16.0;
    ring[k] =
      shape.point({ 3.0 * std::cos(turn), 2.2 * std::sin(turn), 0.25 * std::sin(3.0 * turn) }, 0.4);
  }
  for (int k = 0; k < 16; ++k)
  {
    shape.graph.segments.push_back({ ring[k], ring[(k + 1) % 16] });
  }
  const std::int32_t middle = shape.point({ 0.0, 0.1, 0.3 }, 0.4);
  shape.bridge(middle, ring[2], 3, { 0.2, -0.1, 0.1 });
  shape.bridge(middle, ring[6], 3, { -0.2, -0.1, 0.1 });
  shape.bridge(middle, ring[12], 2, { 0.0, 0.0, 0.2 });
  return shape.graph;
}

SkeletonGraph alien()
{
  Builder shape;
  const std::int32_t hip = shape.point({ 0.0, 0.0, 0.0 }, 0.45);
  const std::int32_t waist = shape.limb(hip, { 0.0, -0.15, 1.2 }, 3, 0.5, { 0.0, -0.1, 0.0 });
  const std::int32_t chest = shape.limb(waist, { 0.0, 0.0, 2.6 }, 4, 0.45, { 0.0, -0.1, 0.0 });
  const std::int32_t head = shape.limb(chest, { 0.0, 0.1, 3.7 }, 3, 0.35);
  for (const double side : { -1.0, 1.0 })
  {
    addArm(shape, chest, side);
    addLeg(shape, hip, side);
  }
  shape.limb(hip, { 0.4, -3.0, 0.2 }, 10, 0.08, { 0.5, 0.0, -0.8 });
  addHead(shape, head);
  // The fin hangs at one point of the back.
  const std::int32_t a = shape.point({ 0.0, -0.9, 1.6 }, 0.1);
  const std::int32_t b = shape.point({ 0.0, -0.9, 1.0 }, 0.1);
  const std::int32_t c = shape.point({ 0.0, -1.4, 1.5 }, 0.08);
  const std::int32_t d = shape.point({ 0.0, -1.4, 0.8 }, 0.08);
  const std::int32_t e = shape.point({ 0.0, -1.9, 1.0 }, 0.08);
  shape.triangle(waist, a, b);
  shape.triangle(a, c, b);
  shape.triangle(b, c, d);
  shape.triangle(c, e, d);
  return shape.graph;
}

SkeletonGraph figure7()
{
  Builder shape;
  const std::int32_t hub = shape.point({ 0.0, 0.0, 0.2 }, 0.3);
  std::int32_t rim[6];
  for (int k = 0; k < 6; ++k)
  {
    const double turn = kPi * k / 3.0;
    rim[k] = shape.point({ 1.5 * std::cos(turn), 1.5 * std::sin(turn), 0.1 * k }, 0.25);
  }
  for (int k = 0; k < 6; ++k)
  {
    shape.triangle(hub, rim[k], rim[(k + 1) % 6]);
  }
  const std::int32_t junction = shape.point({ 4.0, 0.0, 0.5 }, 0.35);
  shape.bridge(rim[0], junction, 3, { 0.0, 0.0, 0.3 });
  shape.limb(junction, { 5.5, 1.5, 0.0 }, 2, 0.2);
  const std::int32_t corner = shape.limb(junction, { 5.5, -1.5, 0.5 }, 2, 0.25);
  const std::int32_t a = shape.point({ 6.5, -2.5, 0.5 }, 0.2);
  const std::int32_t b = shape.point({ 6.8, -1.2, 0.8 }, 0.2);
  const std::int32_t c = shape.point({ 8.0, -2.4, 0.6 }, 0.2);
  shape.triangle(corner, a, b);
  shape.triangle(a, c, b);
  shape.limb(hub, { 0.2, 0.3, 2.5 }, 3, 0.15);
  shape.limb(rim[3], { -3.5, 0.5, 0.0 }, 2, 0.2);
  return shape.graph;
}

SkeletonGraph chain(int n)
{
  Builder shape;
  for (int k = 0; k <= n; ++k)
  {
    shape.point({ double(k), std::sin(0.7 * k), 0.3 * std::cos(1.1 * k) }, 0.2 + 0.2 * k / n);
    if (k > 0)
    {
      shape.graph.segments.push_back({ k - 1, k });
    }
  }
  return shape.graph;
}

SkeletonGraph fan(int n, bool closed)
{
  Builder shape;
  shape.point({ 0.0, 0.0, 0.3 }, 0.3);
  const int neighbours = closed ? n : n + 1;
  for (int k = 0; k < neighbours; ++k)
  {
    const double turn = (closed ? 2.0 : 1.0) * kPi * k / n;
    shape.point({ std::cos(turn), std::sin(turn), 0.1 * std::sin(2.0 * turn) }, 0.2);
  }
  for (int k = 0; k < n; ++k)
  {
    shape.triangle(0, 1 + k, 1 + (k + 1) % neighbours);
  }
  return shape.graph;
}

} // namespace hybridtree::test
