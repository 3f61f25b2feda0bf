#include "serve/coding_cache.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

TEST(CodingCache, EachContentIsEncodedOnce) {
  CodingCache cache(100);
  int calls = 0;
  const auto encode = [&] { return ++calls, Bytes(10, 1); };
  EXPECT_EQ(cache.get("a", encode)->size(), 10u);
  EXPECT_EQ(cache.get("a", encode)->size(), 10u);
  EXPECT_EQ(calls, 1);
}

TEST(CodingCache, TheEntryUnusedForLongestIsEvictedFirst) {
  CodingCache cache(100);
  int calls = 0;
  const auto encode = [&] { return ++calls, Bytes(40, 1); };
  cache.get("a", encode);
  cache.get("b", encode);
  cache.get("a", encode);
  cache.get("c", encode); // evicts b
  EXPECT_EQ(cache.heldBytes(), 80u);
  EXPECT_EQ(calls, 3);
  cache.get("a", encode);
  EXPECT_EQ(calls, 3);
  cache.get("b", encode);
  EXPECT_EQ(calls, 4);
}

TEST(CodingCache, ContentLargerThanTheLimitIsReturnedButNotKept) {
  CodingCache cache(100);
  EXPECT_EQ(cache.get("a", [] { return Bytes(101, 1); })->size(), 101u);
  EXPECT_EQ(cache.heldBytes(), 0u);
}

} // namespace
} // namespace imgeo
