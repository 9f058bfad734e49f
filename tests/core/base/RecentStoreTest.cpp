// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/RecentStore.h"
#include "core/base/Dependency.h"

#include <gtest/gtest.h>

#include <string>

namespace hybridtree
{
namespace
{

struct Key
{
  std::vector<Dependency> dependencies;

  bool operator==(const Key& other) const { return dependencies == other.dependencies; }
  bool isExpired() const { return anyExpired(dependencies); }
  std::uint64_t hash() const
  {
    HashSum sum;
    for (const Dependency& dependency : dependencies)
    {
      dependency.addTo(sum);
    }
    return sum.value();
  }
};

using Store = RecentStore<Key, std::string>;

std::shared_ptr<const std::string> text(const char* words)
{
  return std::make_shared<const std::string>(words);
}

TEST(RecentStore, FindsWhatTheSameObjectsMade)
{
  Store store(1000);
  const auto a = std::make_shared<const int>(1);
  const auto b = std::make_shared<const int>(1);
  store.keep({ { { a, 1.0, 2 }, { b, 0.5, 0 } } }, text("ab"), 10);
  ASSERT_TRUE(store.find({ { { a, 1.0, 2 }, { b, 0.5, 0 } } }));
  EXPECT_EQ(*store.find({ { { a, 1.0, 2 }, { b, 0.5, 0 } } }), "ab");
  EXPECT_FALSE(store.find({ { { b, 1.0, 2 }, { b, 0.5, 0 } } })); // equal, but another
  EXPECT_FALSE(store.find({ { { a, 1.0, 2 } } }));
  EXPECT_FALSE(store.find({ { { a, 1.0, 3 }, { b, 0.5, 0 } } }));
  EXPECT_FALSE(store.find({ { { a, 1.5, 2 }, { b, 0.5, 0 } } }));
}

TEST(RecentStore, ForgetsWhatWasNotAskedForTheLongest)
{
  Store store(100);
  const auto object = std::make_shared<const int>(0);
  const auto key = [&](int k) { return Key{ { { object, 0.0, k } } }; };
  for (int k = 0; k < 10; ++k)
  {
    store.keep(key(k), text("x"), 10);
  }
  EXPECT_TRUE(store.find(key(0)));
  store.keep(key(10), text("x"), 10);
  EXPECT_TRUE(store.find(key(0)));
  EXPECT_FALSE(store.find(key(1)));
  EXPECT_TRUE(store.find(key(2)));
  EXPECT_EQ(store.bytes(), 100u);
  store.keep(key(11), text("too much"), 60);
  EXPECT_FALSE(store.find(key(11)));
  EXPECT_EQ(store.bytes(), 100u);
  store.clear();
  EXPECT_FALSE(store.find(key(2)));
}

TEST(RecentStore, ForgetsWhatIsMadeFromObjectsThatAreGone)
{
  Store store(1000);
  const auto last = std::make_shared<const int>(0);
  for (int k = 0; k < 50; ++k)
  {
    const auto passing = std::make_shared<const int>(k); // often at the same address
    EXPECT_FALSE(store.find({ { { passing, 0.0, 0 } } }));
    store.keep({ { { passing, 0.0, 0 } } }, text("x"), 10);
    EXPECT_TRUE(store.find({ { { passing, 0.0, 0 } } }));
  }
  EXPECT_LT(store.bytes(), 100u);
}

} // namespace
} // namespace hybridtree
