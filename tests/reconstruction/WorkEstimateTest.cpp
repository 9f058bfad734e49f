// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/WorkEstimate.h"

#include "reconstruction/Convection.h"
#include "tests/reconstruction/Samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <vector>

// AddressSanitizer has an allocator of its own, which mallinfo2 does not see.
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
#include <malloc.h>

namespace
{

using namespace hybridtree;
using namespace hybridtree::test;

double allocated()
{
  const struct mallinfo2 now = mallinfo2();
  return double(now.uordblks) + double(now.hblkhd);
}

// Looks at the memory of the process whenever work looks at abort.
class PeakMemory final : public Progress
{
public:
  bool cancelled() const override
  {
    const double now = allocated() - before_;
    for (double peak = peak_; now > peak && !peak_.compare_exchange_weak(peak, now);)
    {
    }
    return false;
  }
  double peak() const { return peak_; }

private:
  const double before_ = allocated();
  mutable std::atomic<double> peak_{ 0.0 };
};

TEST(WorkEstimate, TellsTheMemoryOfAllPointsWithinAFactorOfThree)
{
  Random random(3);
  std::vector<Vec3> volume(30000);
  std::generate(
    volume.begin(), volume.end(), [&] { return random.inBox(Box3(Vec3::Zero(), Vec3::Ones())); });
  // Open, and with points that are left hidden: normals are estimated, or empty balls looked at.
  std::vector<Vec3> waves(30000);
  std::generate(waves.begin(), waves.end(),
    [&]
    {
      const Vec3 p = random.inBox(Box3(Vec3::Zero(), Vec3::Ones()));
      return Vec3(p.x(), p.y(), 0.05 * std::sin(20.0 * p.x()) * std::cos(17.0 * p.y()));
    });
  const auto expectNear = [](const std::vector<Vec3>& points, bool closeHoles)
  {
    SCOPED_TRACE(std::to_string(points.size()) + (closeHoles ? " closed" : " open"));
    ConvectionOptions options;
    options.closeHoles = closeHoles;
    const PeakMemory memory;
    reconstruct(points, options, memory);
    const double estimate = estimateWork(points.size()).bytes;
    EXPECT_LT(memory.peak(), 3.0 * estimate);
    EXPECT_GT(memory.peak(), estimate / 3.0);
  };
  expectNear(randomTorus(1.0, 0.4, 20000, 1), true);
  expectNear(randomSphere(60000, 2), true);
  expectNear(volume, true);
  expectNear(randomTorus(1.0, 0.4, 20000, 1), false);
  expectNear(waves, false);
}

TEST(WorkEstimate, TellsTheMemoryOfALevelOfDetailWithinAFactorOfThree)
{
  const std::vector<Vec3> points = randomTorus(1.0, 0.4, 60000, 4);
  Box3 bounds;
  for (const Vec3& point : points)
  {
    bounds.extend(point);
  }
  for (const LevelOfDetail& detail :
    { LevelOfDetail{ 0.0, 3000 }, LevelOfDetail{ 0.0, 20000 }, LevelOfDetail{ 0.002, 0 } })
  {
    SCOPED_TRACE(detail.vertices);
    const PeakMemory memory;
    reconstruct(points, detail, {}, memory);
    const double estimate = estimateWork(points.size(), bounds, detail).bytes;
    EXPECT_LT(memory.peak(), 3.0 * estimate);
    EXPECT_GT(memory.peak(), estimate / 3.0);
  }
}

} // namespace

#endif
