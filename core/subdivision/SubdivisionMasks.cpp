// SPDX-License-Identifier: BSD-3-Clause
#include "core/subdivision/SubdivisionMasks.h"

#include <cmath>

namespace hybridtree
{
namespace
{

const double kPi = std::acos(-1.0);

double sectorAngle(SectorShape shape)
{
  return shape == SectorShape::Straight ? kPi : 0.5 * kPi;
}

void fillCenter(RingMask& mask)
{
  mask.center = 1.0;
  for (double weight : mask.ring)
  {
    mask.center -= weight;
  }
}

} // namespace

double loopNeighbourWeight(std::size_t n)
{
  const double c = 0.375 + 0.25 * std::cos(2.0 * kPi / double(n));
  return (0.625 - c * c) / double(n);
}

double loopSectorWeight(std::size_t k, SectorShape shape)
{
  return 0.5 - 0.25 * std::cos(sectorAngle(shape) / double(k));
}

RingMask butterflyRingMask(std::size_t n)
{
  RingMask mask;
  if (n == 3)
  {
    mask.ring = { 5.0 / 12.0, -1.0 / 12.0, -1.0 / 12.0 };
  }
  else if (n == 4)
  {
    mask.ring = { 0.375, 0.0, -0.125, 0.0 };
  }
  else
  {
    for (std::size_t j = 0; j < n; ++j)
    {
      const double angle = 2.0 * kPi * double(j) / double(n);
      mask.ring.push_back((0.25 + std::cos(angle) + 0.5 * std::cos(2.0 * angle)) / double(n));
    }
  }
  fillCenter(mask);
  return mask;
}

RingMask butterflySectorMask(std::size_t k, std::size_t i, SectorShape shape)
{
  RingMask mask;
  mask.ring.assign(k + 1, 0.0);
  const double step = kPi / double(k);
  const double linear = shape == SectorShape::Straight ? 1.0 : 0.0;
  // Sines vanish on both sharp edges. The first is linear when these are one line.
  for (std::size_t j = 1; j < k; ++j)
  {
    const double first = std::sin(double(i) * step) * std::sin(double(j) * step);
    const double second = std::sin(2.0 * double(i) * step) * std::sin(2.0 * double(j) * step);
    mask.ring[j] = (linear * (first + 0.5 * second) + (1.0 - linear) * 0.5 * first) / double(k);
  }
  // What a linear function has at j for a unit at the first and at the last neighbour.
  const auto linearPart = [&](std::size_t j, double& first, double& last)
  {
    if (shape == SectorShape::Straight)
    {
      first = 0.5 * std::cos(double(j) * step);
      last = -first;
    }
    else
    {
      first = std::sin(0.5 * double(k - j) * step);
      last = std::sin(0.5 * double(j) * step);
    }
  };
  double atFirst = 0.0;
  double atLast = 0.0;
  linearPart(i, atFirst, atLast);
  mask.ring[0] = 0.5 * atFirst;
  mask.ring[k] = 0.5 * atLast;
  for (std::size_t j = 1; j < k; ++j)
  {
    linearPart(j, atFirst, atLast);
    mask.ring[0] -= mask.ring[j] * atFirst;
    mask.ring[k] -= mask.ring[j] * atLast;
  }
  fillCenter(mask);
  return mask;
}

} // namespace hybridtree
