// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/SweepMesh.h"

#include "core/skeletons/OffsetMesh.h"
#include "core/skeletons/RingPlan.h"
#include "core/skeletons/Tube.h"
#include "core/skeletons/TubeClearance.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

constexpr double kPi = 3.14159265358979323846;

std::vector<Ring> openRings(const Tube& tube, double edgeLength)
{
  Meridian meridian(Meridian::Kind::AxisToAxis);
  const Tube::End first = tube.end(false);
  const Tube::End last = tube.end(true);
  meridian.addArc(Vec2(0.0, first.center), first.radius, -0.5 * kPi, first.angle);
  meridian.addCurve(
    tube.to() - tube.from(), [&tube](double s) { return tube.place(tube.from() + s); });
  meridian.addArc(Vec2(0.0, last.center), last.radius, last.angle, 0.5 * kPi);
  return RingPlan(meridian, edgeLength).rings();
}

std::vector<Ring> closedRings(const Tube& tube, double edgeLength)
{
  const double length = tube.to() - tube.from();
  const int count =
    std::max(6, 2 * static_cast<int>(std::ceil(kPi * tube.largestRadius() / edgeLength)));
  const double row = std::sqrt(0.75) *
    std::min(edgeLength, 2.0 * tube.largestRadius() * std::sin(kPi / count) * 2.0);
  const int rows = std::max(6, 2 * static_cast<int>(std::ceil(0.5 * length / row)));
  std::vector<Ring> rings;
  for (int k = 0; k < rows; ++k)
  {
    rings.push_back({ tube.place(tube.from() + length * k / rows), count, k % 2 });
  }
  return rings;
}

std::optional<TriangleMesh> ball(const CubicSpan& span, double radius, double edgeLength)
{
  return meshRoundedBox({ span.control[0].at, Mat3::Identity(), Vec3::Zero() },
    radius + span.control[0].radius, edgeLength);
}

} // namespace

std::optional<TriangleMesh> meshSweep(
  const std::vector<CubicSpan>& spans, bool closed, double radius, double edgeLength)
{
  const CubicSpan& first = spans.front();
  if (spans.size() == 1 &&
    std::all_of(first.control.begin(), first.control.end(),
      [&](const ThickPoint& p) { return p.at == first.control[0].at; }))
  {
    return ball(first, radius, edgeLength);
  }
  const bool vanishes = std::any_of(spans.begin(), spans.end(),
    [&](const CubicSpan& span)
    {
      return std::any_of(span.control.begin(), span.control.end(),
        [&](const ThickPoint& p) { return radius + p.radius < 0.0; });
    });
  if (vanishes || !tubeIsClear(spans, closed, radius))
  {
    return std::nullopt;
  }
  double length = edgeLength;
  for (int round = 0; round < 20; ++round)
  {
    const Tube tube(spans, closed, radius, length);
    if (!tube.monotone())
    {
      return std::nullopt;
    }
    requireModestCount(std::max(2.0 * kPi * tube.largestRadius(), length) *
        (tube.curveLength() + 2.0 * tube.largestRadius()) / (0.3 * length * length),
      edgeLength);
    std::vector<Ring> rings = closed ? closedRings(tube, length) : openRings(tube, length);
    std::vector<RevolvedFrame> frames;
    frames.reserve(rings.size());
    for (Ring& ring : rings)
    {
      frames.push_back(tube.bend(ring));
    }
    TriangleMesh mesh = meshRings(rings, closed, frames);
    const double longest = longestEdge(mesh, rings);
    if (longest <= edgeLength)
    {
      return mesh;
    }
    length *= 0.999 * edgeLength / longest;
  }
  return std::nullopt;
}

} // namespace hybridtree
