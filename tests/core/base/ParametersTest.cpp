// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/Parameters.h"

#include "core/base/Error.h"

#include <gtest/gtest.h>

#include <functional>

namespace hybridtree
{
namespace
{

TEST(Parameters, EveryTypeKeepsItsValue)
{
  Parameters parameters;
  parameters.set("real", 0.75);
  parameters.set("flag", true);
  parameters.set("count", 7);
  parameters.set("large", std::int64_t(1) << 40);
  parameters.set("text", "words");
  parameters.set("reals", std::vector<double>{ 0.5, -1.5 });
  parameters.set("vector", Vec3(0.1, 0.2, 0.3));
  EXPECT_EQ(parameters.getDouble("real"), 0.75);
  EXPECT_TRUE(parameters.getBool("flag"));
  EXPECT_EQ(parameters.getInt("count"), 7);
  EXPECT_EQ(parameters.getDouble("count"), 7.0);
  EXPECT_EQ(parameters.getDouble("large"), 1099511627776.0);
  EXPECT_EQ(parameters.getString("text"), "words");
  EXPECT_EQ(parameters.getDoubles("reals"), (std::vector<double>{ 0.5, -1.5 }));
  EXPECT_EQ(parameters.getVec3("vector"), Vec3(0.1, 0.2, 0.3));
}

TEST(Parameters, WrongTypeAndAbsentNameAreNamed)
{
  Parameters parameters;
  parameters.set("real", 0.75);
  for (const auto& read :
    std::vector<std::function<void()>>{
      [&] { parameters.getInt("real"); },
      [&] { parameters.getBool("real"); },
      [&] { parameters.getString("real"); },
      [&] { parameters.getVec3("real"); },
      [&] { parameters.getAffine("real"); },
    })
  {
    try
    {
      read();
      ADD_FAILURE() << "read as another type";
    }
    catch (const InvalidText& error)
    {
      EXPECT_NE(std::string(error.what()).find("\"real\""), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(parameters.getDouble("absent"), InvalidText);
}

TEST(Parameters, SettingANameAgainReplacesItsValue)
{
  Parameters parameters;
  parameters.set("a", 1);
  parameters.set("b", 2);
  parameters.set("a", 2.5);
  EXPECT_EQ(parameters.getDouble("a"), 2.5);
  ASSERT_EQ(parameters.entries().size(), 2u);
  EXPECT_EQ(parameters.entries().front().first, "a");
}

} // namespace
} // namespace hybridtree
