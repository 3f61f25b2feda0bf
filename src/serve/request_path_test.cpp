#include "serve/request_path.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

std::vector<std::string> namesOf(std::string_view target) {
  const auto path = parseRequestTarget(target);
  EXPECT_TRUE(path) << target;
  return path ? path->names : std::vector<std::string>{"(malformed)"};
}

using Names = std::vector<std::string>;

TEST(RequestPath, ATargetIsSplitBeforeItIsDecoded) {
  EXPECT_EQ(namesOf("/a/b%20c.png"), (Names{"a", "b c.png"}));
  EXPECT_EQ(namesOf("/%C3%A4.html?x=/y"), (Names{"\xC3\xA4.html"}));
  EXPECT_EQ(namesOf("/a%3Fb"), (Names{"a?b"}));
  EXPECT_EQ(namesOf("/"), Names{});
}

TEST(RequestPath, AnAbsoluteTargetLosesItsOrigin) {
  EXPECT_EQ(namesOf("http://example.org/a/b"), (Names{"a", "b"}));
  EXPECT_EQ(namesOf("https://example.org:1"), Names{});
}

TEST(RequestPath, ASlashAtTheEndMeansADirectory) {
  EXPECT_TRUE(parseRequestTarget("/")->isDirectory);
  EXPECT_TRUE(parseRequestTarget("/a/")->isDirectory);
  EXPECT_TRUE(parseRequestTarget("/a/.")->isDirectory);
  EXPECT_FALSE(parseRequestTarget("/a")->isDirectory);
  EXPECT_FALSE(parseRequestTarget("/a?/")->isDirectory);
}

TEST(RequestPath, EmptyNamesAndSingleDotsAreSkipped) {
  EXPECT_EQ(namesOf("//a/./b//c"), (Names{"a", "b", "c"}));
}

TEST(RequestPath, ParentDirectoriesAreRefusedInEveryEscapedForm) {
  for (const char* target :
       {"/..", "/../etc/passwd", "/a/../../b", "/%2e%2e/x", "/%2E./x", "/.%2e", "/a/..", "/a/..?x"})
    EXPECT_FALSE(parseRequestTarget(target)) << target;
}

TEST(RequestPath, NamesHoldNeitherSlashNorNul) {
  for (const char* target : {"/a%2Fb", "/%2f..%2f", "/a%00.png"})
    EXPECT_FALSE(parseRequestTarget(target)) << target;
}

TEST(RequestPath, MalformedEscapesAndOtherTargetFormsAreRefused) {
  for (const char* target : {"", "a", "*", "/%", "/%4", "/%zz", "/%-1", "http:/a", "ftp://h/a", "?a", "host:80"})
    EXPECT_FALSE(parseRequestTarget(target)) << target;
}

TEST(RequestPath, AFormattedPathParsesToTheSamePath) {
  for (const char* target : {"/", "/a", "/a/", "/b%20c/%25%3F%23/%C3%A4%5C", "//x"}) {
    const auto path = parseRequestTarget(target);
    EXPECT_EQ(parseRequestTarget(formatRequestPath(*path)), path) << target;
  }
  EXPECT_EQ(formatRequestPath({{"a b", "\xFF"}, true}), "/a%20b/%FF/");
}

} // namespace
} // namespace imgeo
