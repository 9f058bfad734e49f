// SPDX-License-Identifier: BSD-3-Clause
#include "core/subdivision/SkeletonGraph.h"

#include "core/base/Error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

namespace hybridtree
{
namespace
{

SkeletonGraph kite()
{
  return { { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 }, { 3, 1, 0 } }, { 1, 1, 1, 2, 1 },
    { { 3, 4 } }, { { 0, 1, 2 }, { 1, 3, 2 } } };
}

TEST(SkeletonGraph, AcceptsCurvesAndSurfacesThatShareAPoint)
{
  EXPECT_NO_THROW(validate(kite()));
}

TEST(SkeletonGraph, RefusesWhatNoSkeletonCanBeAndNamesIt)
{
  using Graph = SkeletonGraph;
  const std::pair<std::function<void(Graph&)>, const char*> cases[] = {
    { [](Graph& g) { g.segments.clear(), g.triangles.clear(); }, "no segment and no triangle" },
    { [](Graph& g) { g.points[2].x() = std::nan(""); }, "point 2 has a coordinate" },
    { [](Graph& g) { g.radii[3] = 0.0; }, "point 3 has the radius" },
    { [](Graph& g) { g.radii[1] = INFINITY; }, "point 1 has the radius" },
    { [](Graph& g) { g.radii.pop_back(); }, "5 points and 4 radii" },
    { [](Graph& g) { g.segments[0][1] = 5; }, "segment 0 uses point 5, which is not there" },
    { [](Graph& g) { g.triangles[1][0] = -1; }, "triangle 1 uses point -1, which is not there" },
    { [](Graph& g) { g.segments[0][1] = 3; }, "segment 0 uses a point twice" },
    { [](Graph& g) {
       g.segments.push_back({ 4, 3 });
     },
      "segment 1 is the same as 0" },
    { [](Graph& g) {
       g.triangles.push_back({ 2, 0, 1 });
     },
      "triangle 2 is the same as 0" },
    { [](Graph& g) { g.points[4] = g.points[3]; }, "segment 0 has no length" },
    { [](Graph& g) {
       g.points[3] = { 2, -1, 0 };
     },
      "triangle 1 has no area" },
    { [](Graph& g) {
       g.triangles.push_back({ 1, 2, 4 });
     },
      "triangle 2 is the third one" },
  };
  for (const auto& [spoil, message] : cases)
  {
    SkeletonGraph graph = kite();
    spoil(graph);
    try
    {
      validate(graph);
      ADD_FAILURE() << "accepted, expected: " << message;
    }
    catch (const InvalidGeometry& error)
    {
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
  }
}

} // namespace
} // namespace hybridtree
