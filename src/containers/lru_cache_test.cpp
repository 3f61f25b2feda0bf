#include "containers/lru_cache.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

TEST(LruCache, MakesEachValueOnceAndTriesWhatFailedOnce) {
  LruCache<int> cache;
  int calls = 0;
  const auto make = [&](const std::string& url) -> int {
    ++calls;
    if (url == "broken")
      throw Error(ErrorKind::malformed, url, "is broken");
    return calls;
  };
  EXPECT_EQ(*cache.get("whole", make), 1);
  EXPECT_EQ(*cache.get("whole", make), 1);
  for (int n = 0; n < 3; ++n)
    EXPECT_THROW(cache.get("broken", make), Error);
  EXPECT_EQ(calls, 2);
  for (const char* url : {"a", "b", "c", "d"}) // as many as the cache keeps
    cache.get(url, make);
  EXPECT_THROW(cache.get("broken", make), Error);
  EXPECT_EQ(calls, 7);
}

} // namespace
} // namespace imgeo
