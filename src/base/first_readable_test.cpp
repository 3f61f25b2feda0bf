#include "base/first_readable.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

const std::vector<std::string> urls{"a", "b", "c"};

[[noreturn]] void refuse(const std::string& url) {
  throw Error(url == "a" ? ErrorKind::io : ErrorKind::malformed, url, "cannot be read");
}

TEST(FirstReadable, GivesTheFirstThatCanBeReadAndReadsNoFurther) {
  std::vector<std::string> tried;
  const auto read = [&](const std::string& url) {
    tried.push_back(url);
    if (url == "a")
      refuse(url);
    return url;
  };
  EXPECT_EQ(firstReadable(urls, read), "b");
  EXPECT_EQ(tried, (std::vector<std::string>{"a", "b"}));
}

TEST(FirstReadable, NamesAllWhereNoneCanBeRead) {
  const auto read = [](const std::string& url) -> int { refuse(url); };
  try {
    firstReadable(urls, read);
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "a: cannot be read; b: cannot be read; c: cannot be read");
    EXPECT_EQ(error.kind(), ErrorKind::io);
    EXPECT_EQ(error.location(), "a");
  }
}

} // namespace
} // namespace imgeo
