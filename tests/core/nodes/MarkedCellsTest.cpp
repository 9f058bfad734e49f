// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/MarkedCells.h"

#include "core/base/Parallel.h"
#include "core/nodes/BlendMesh.h"
#include "core/nodes/Primitive.h"
#include "core/skeletons/Point.h"
#include "core/skeletons/Segment.h"

#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace hybridtree::test
{
namespace
{

constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
constexpr std::size_t kThreads = 4;

/// Two that meet.
class Meeting final : public Interaction
{
public:
  int kind() const override { return 0; }
  bool marks(const std::vector<MarkTerm>&, const std::vector<int>& present) const override
  {
    return present.size() > 1;
  }
  Interval range(const std::vector<int>&, const std::vector<Interval>& ranges) const override
  {
    Interval sum;
    for (const Interval& range : ranges)
    {
      sum = sum + range;
    }
    return sum;
  }
};

/// A ball and limbs around it, some of which meet.
struct Shape
{
  explicit Shape(std::uint64_t seed)
  {
    Random random(seed);
    for (int k = 0; k < 4; ++k)
    {
      const Vec3 place = random.uniform(0.0, 0.8) * random.direction();
      const double radius = random.uniform(0.15, 0.35);
      nodes.push_back(makePrimitive(std::make_shared<SegmentSkeleton>(
                                      place, place + random.uniform(0.1, 0.8) * random.direction()),
        Potential::bySurfaceRadius(radius, 1.5 * radius, 2)));
      terms.push_back({ nodes.back().get(), true });
    }
  }

  CellMarker marker() const { return { terms, meeting, grid, budget }; }

  std::vector<NodePtr> nodes;
  std::vector<MarkTerm> terms;
  Meeting meeting;
  CellGrid grid = CellGrid::ofLevel(0.02, 1);
  MemoryBudget budget{ std::size_t(1) << 30, 0.02 };
};

TEST(MarkedCells, ASampleBeforehandChangesNoMark)
{
  for (std::uint64_t seed = 1; seed <= 12; ++seed)
  {
    const Shape shape(seed);
    forgetMarks();
    const std::optional<CellSet> all = shape.marker().mark(kAll);
    ASSERT_TRUE(all);
    for (const std::size_t count : { std::size_t(10), all->size(), 20 * all->size() + 100000 })
    {
      forgetMarks();
      CellMarker marker = shape.marker();
      marker.seemMoreThan(count);
      const std::optional<CellSet> cells = marker.mark(kAll);
      ASSERT_TRUE(cells);
      EXPECT_EQ(cells->bricks(), all->bricks()) << "seed " << seed << ", sampled for " << count;
    }
  }
}

TEST(MarkedCells, ASampleTellsManyFromFew)
{
  int many = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed)
  {
    const Shape shape(seed);
    forgetMarks();
    const std::size_t count = shape.marker().mark(kAll)->size();
    if (count > 1000)
    {
      ++many;
      EXPECT_TRUE(shape.marker().seemMoreThan(count / 2)) << "seed " << seed;
    }
    EXPECT_FALSE(shape.marker().seemMoreThan(2 * count + 100)) << "seed " << seed;
  }
  EXPECT_GT(many, 10);
}

TEST(MarkedCells, AnswersAreTheSameForAnyThreadsAndWhateverIsRemembered)
{
  for (std::uint64_t seed = 1; seed <= 12; ++seed)
  {
    const Shape shape(seed);
    forgetMarks();
    const std::size_t count = shape.marker().mark(kAll)->size();
    for (const double factor : { 0.5, 0.8, 0.95, 1.05, 1.2, 2.0 })
    {
      const auto asked = static_cast<std::size_t>(factor * static_cast<double>(count));
      setThreadCount(1);
      forgetMarks();
      const bool cold = shape.marker().seemMoreThan(asked);
      EXPECT_EQ(shape.marker().seemMoreThan(asked), cold) << "remembered, seed " << seed;
      setThreadCount(kThreads);
      EXPECT_EQ(shape.marker().seemMoreThan(asked), cold) << "remembered, seed " << seed;
      forgetMarks();
      EXPECT_EQ(shape.marker().seemMoreThan(asked), cold) << "threads, seed " << seed;
      // What is left behind by a search that ended early is not taken for the whole.
      forgetMarks();
      CellMarker marker = shape.marker();
      EXPECT_EQ(marker.mark(asked).has_value(), count <= asked);
      EXPECT_EQ(marker.seemMoreThan(asked), cold) << "after marking, seed " << seed;
      EXPECT_EQ(marker.mark(kAll)->size(), count);
      setThreadCount(0);
    }
  }
}

} // namespace
} // namespace hybridtree::test
