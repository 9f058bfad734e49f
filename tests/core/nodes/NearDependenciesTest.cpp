// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/NearDependencies.h"

#include "core/nodes/Boolean.h"
#include "core/nodes/LocalBlend.h"
#include "core/nodes/Primitive.h"
#include "core/skeletons/Point.h"

#include "tests/support/Random.h"
#include "tests/support/RandomTree.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace hybridtree::test
{
namespace
{

NodePtr ball(const Vec3& center, double radius, bool negative = false)
{
  return makePrimitive(std::make_shared<PointSkeleton>(center),
    Potential::bySurfaceRadius(radius, 2.0 * radius, 2, negative));
}

NodePtr randomBall(Random& random)
{
  return ball(random.inBox(Box3(Vec3::Zero(), Vec3::Constant(2.0))), random.uniform(0.1, 0.4),
    random.chance(0.2));
}

/// How nodes are put together from leaves, with some of them in several places.
class Plan
{
public:
  Plan(Random& random, int leaves, int operators)
  {
    for (int k = 0; k < operators; ++k)
    {
      Step step{ random.integer(0, 2), random.integer(0, 2), {} };
      for (int n = step.kind == 0 ? random.integer(2, 5) : 3; n > 0; --n)
      {
        // The nodes made last are not yet in use.
        const int last = leaves + k - 1;
        step.children.push_back(random.chance(0.5) ? random.integer(std::max(0, last - 2), last)
                                                   : random.integer(0, last));
      }
      steps_.push_back(step);
    }
  }

  NodePtr build(const std::vector<NodePtr>& leaves) const
  {
    std::vector<NodePtr> nodes = leaves;
    for (const Step& step : steps_)
    {
      std::vector<NodePtr> children;
      for (const int child : step.children)
      {
        children.push_back(nodes[static_cast<std::size_t>(child)]);
      }
      nodes.push_back(step.kind == 0 ? makeBlend(children)
          : step.kind == 1
          ? makeLocalBlend(children[0], children[1], children[2])
          : makeBoolean(static_cast<BooleanOperation>(step.operation), children[0], children[1]));
    }
    return nodes.back()->underBlend();
  }

private:
  struct Step
  {
    int kind;
    int operation;
    std::vector<int> children;
  };

  std::vector<Step> steps_;
};

std::vector<Dependency> dependenciesOf(const Node& node, const std::vector<Box3>& boxes)
{
  NearDependencies near(boxes, NearDependencies::Leaves::Numbered);
  near.add(node, 0);
  return near.take();
}

/// All that is told of some points and of the boxes around them.
struct Answers
{
  std::vector<double> numbers;
  std::vector<std::int32_t> leaves;

  bool operator==(const Answers& other) const
  {
    return numbers == other.numbers && leaves == other.leaves;
  }
};

Answers answersOf(const Node& node, const std::vector<Box3>& boxes, std::uint64_t seed)
{
  Answers answers;
  const auto ask = [&](const FieldSource& source, const PointList& points)
  {
    std::vector<double> value(points.size());
    VectorList gradient(points.size());
    source.fieldAndGradient(points, value.data(), gradient);
    answers.numbers.insert(answers.numbers.end(), value.begin(), value.end());
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      const Vec3 vector = gradient[k];
      answers.numbers.insert(answers.numbers.end(), vector.data(), vector.data() + 3);
    }
    source.field(points, value.data());
    answers.numbers.insert(answers.numbers.end(), value.begin(), value.end());
  };
  Random random(seed);
  PointList all;
  for (const Box3& box : boxes)
  {
    Box3 part(random.inBox(box));
    part.extend(random.inBox(box));
    const PointList points = randomPoints(random, part, 40);
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      all.add(points[k]);
    }
    const Interval range = node.range(part);
    const FieldSourcePtr restricted = node.restrictedTo(part);
    answers.numbers.insert(answers.numbers.end(), { range.min, range.max, restricted ? 1.0 : 0.0 });
    if (restricted)
    {
      const Interval own = restricted->range(part);
      answers.numbers.insert(answers.numbers.end(), { own.min, own.max });
      ask(*restricted, points);
    }
  }
  ask(node, all);
  answers.leaves.resize(all.size());
  node.sourceLeaf(all, answers.leaves.data());
  return answers;
}

std::vector<Box3> randomBoxes(Random& random)
{
  std::vector<Box3> boxes;
  const Vec3 corner = random.inBox(Box3(Vec3::Zero(), Vec3::Constant(2.0)));
  for (int k = random.integer(1, 4); k > 0; --k)
  {
    const Vec3 low = corner + 0.3 * random.direction();
    boxes.emplace_back(low, Vec3(low + Vec3::Constant(0.2)));
  }
  return boxes;
}

// The promise that islands and marks are kept by: in trees of any shape, whatever else is edited.
TEST(NearDependencies, EqualOnesTellThatAllAnswersAreTheSame)
{
  int same = 0;
  int changed = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed)
  {
    SCOPED_TRACE(seed);
    Random random(4000 + seed);
    std::vector<NodePtr> leaves{ randomTree(seed, 1), randomTree(seed + 100, 2) };
    for (int k = 0; k < 20; ++k)
    {
      leaves.push_back(randomBall(random));
    }
    const Plan plan(random, static_cast<int>(leaves.size()), 14);
    for (int edit = 0; edit < 4; ++edit)
    {
      const NodePtr before = plan.build(leaves);
      const std::vector<NodePtr> held = leaves;
      const int moved = random.integer(0, static_cast<int>(leaves.size()) - 1);
      NodePtr& leaf = leaves[static_cast<std::size_t>(moved)];
      // Of as many leaves: those behind keep their numbers.
      leaf =
        moved < 2 ? leaf->affine(Affine3(Eigen::Translation3d(0.1, 0.0, 0.0))) : randomBall(random);
      const NodePtr after = plan.build(leaves);
      for (int k = 0; k < 10; ++k)
      {
        const std::vector<Box3> boxes = randomBoxes(random);
        if (!(dependenciesOf(*before, boxes) == dependenciesOf(*after, boxes)))
        {
          ++changed;
          continue;
        }
        const std::uint64_t points = random.bits();
        ASSERT_TRUE(answersOf(*before, boxes, points) == answersOf(*after, boxes, points));
        ++same;
      }
    }
  }
  EXPECT_GT(same, 500);
  EXPECT_GT(changed, 100);
}

TEST(NearDependencies, TellWhatIsNearAndHowItIsPutTogether)
{
  const NodePtr a = ball(Vec3(0, 0, 0), 0.5);
  const NodePtr b = ball(Vec3(0.5, 0, 0), 0.5);
  const NodePtr region = ball(Vec3(0.2, 0.3, 0), 0.3);
  const NodePtr far = ball(Vec3(9, 0, 0), 0.5);
  const std::vector<Box3> boxes{ Box3(Vec3(0, 0, 0), Vec3(0.3, 0.3, 0.3)) };
  const auto of = [&](const NodePtr& node) { return dependenciesOf(*node, boxes); };

  EXPECT_EQ(of(makeBlend({ a, b })), of(makeBlend({ a, b, far })));
  EXPECT_EQ(of(makeLocalBlend(a, b, region)), of(makeLocalBlend(a, b, makeBlend({ region }))));
  EXPECT_EQ(of(makeLocalBlend(a, makeBlend({ b, ball(Vec3(7, 0, 0), 0.1) }), region)),
    of(makeLocalBlend(a, makeBlend({ b, ball(Vec3(8, 0, 0), 0.1) }), region)));
  EXPECT_EQ(of(makeLocalBlend(a, b, makeBlend({ region, far }))),
    of(makeLocalBlend(a, b, makeBlend({ region, ball(Vec3(8, 0, 0), 0.1) }))));

  const std::vector<NodePtr> unlike{ makeBlend({ a, b }), makeBlend({ b, a }),
    makeBlend({ a, b, b }), makeBlend({ a, ball(Vec3(0.5, 0, 0), 0.5) }),
    makeLocalBlend(a, b, region), makeLocalBlend(a, b, far), makeLocalBlend(far, b, a),
    makeLocalBlend(b, far, a), makeBoolean(BooleanOperation::Union, a, b),
    makeBoolean(BooleanOperation::Difference, a, b),
    makeBoolean(BooleanOperation::Union, a, b, BooleanForm::Smooth),
    makeBoolean(BooleanOperation::Difference, a, far),
    makeBoolean(BooleanOperation::Difference, far, a),
    makeBlend({ a, b })->affine(Affine3(Eigen::Translation3d(0.01, 0.0, 0.0))) };
  for (std::size_t k = 0; k < unlike.size(); ++k)
  {
    for (std::size_t n = 0; n < k; ++n)
    {
      EXPECT_NE(of(unlike[k]), of(unlike[n])) << n << " and " << k;
    }
  }
}

// Of a region only the field counts; elsewhere the same node's leaves have numbers.
TEST(NearDependencies, TellNumbersOfLeavesOfWhatIsARegionAsWell)
{
  const NodePtr small = ball(Vec3(0, 0, 0), 0.1);
  const NodePtr large = ball(Vec3(0.2, 0.2, 0.2), 1.0);
  const NodePtr far = ball(Vec3(9, 0, 0), 0.5);
  const std::vector<Box3> boxes{ Box3(Vec3(0, 0, 0), Vec3(0.3, 0.3, 0.3)) };
  const auto twice = [&](const NodePtr& node)
  { return makeLocalBlend(makeLocalBlend(small, small, node), node, far); };
  const NodePtr before = twice(makeBlend({ far, large }));
  const NodePtr after = twice(makeBlend({ large, far }));
  ASSERT_FALSE(answersOf(*before, boxes, 1) == answersOf(*after, boxes, 1));
  EXPECT_NE(dependenciesOf(*before, boxes), dependenciesOf(*after, boxes));
}

// 2^18 ways down to the leaf.
TEST(NearDependencies, NodesInManyPlacesAreToldOnce)
{
  NodePtr node = ball(Vec3::Zero(), 0.5);
  for (int k = 0; k < 18; ++k)
  {
    node = makeLocalBlend(node, node, ball(Vec3::Zero(), 0.5));
  }
  const std::vector<Box3> boxes{ Box3(Vec3::Zero(), Vec3::Ones()) };
  EXPECT_LT(dependenciesOf(*node, boxes).size(), 200u);
}

} // namespace
} // namespace hybridtree::test
