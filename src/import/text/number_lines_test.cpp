#include "import/text/number_lines.h"

#include <gtest/gtest.h>
#include <string>

namespace imgeo {

namespace {

const std::string fileName = "a.txt";

/// The numbers of all lines, and where each line begins.
std::vector<std::vector<double>> allOf(const std::string& text, std::vector<std::size_t>* begins = nullptr) {
  std::vector<std::vector<double>> all;
  NumberLines lines(asBytes(text), fileName, 4);
  while (lines.next()) {
    const std::span<const double> numbers = lines.numbers();
    all.emplace_back(numbers.begin(), numbers.end());
    if (begins)
      begins->push_back(lines.begin());
    EXPECT_EQ(text.substr(lines.begin(), lines.end() - lines.begin()).find_first_of('\n'),
              text.at(lines.end() - 1) == '\n' ? lines.end() - lines.begin() - 1 : text.npos);
  }
  return all;
}

TEST(NumberLines, HaveNumbersBetweenBlanksCommasOrSemicolons) {
  EXPECT_EQ(allOf("1 2\t-3\r\n +1e3,.5 ; 7;\n\n8"),
            (std::vector<std::vector<double>>{{1, 2, -3}, {1000, 0.5, 7}, {8}}));
}

TEST(NumberLines, LeaveCommentsAndEmptyLinesOut) {
  std::vector<std::size_t> begins;
  EXPECT_EQ(allOf("# one\n//two\n1 2 # three\n\n \n#\n4#5\n6", &begins),
            (std::vector<std::vector<double>>{{1, 2}, {4}, {6}}));
  EXPECT_EQ(begins, (std::vector<std::size_t>{12, 29, 33}));
}

TEST(NumberLines, AreRefusedWithTheirNumber) {
  const auto refused = [](const std::string& text) -> std::string {
    try {
      allOf(text);
    } catch (const Error& error) {
      return error.location() + ": " + error.message();
    }
    return "";
  };
  EXPECT_EQ(refused("1\n\n1 two 3"), "a.txt:3: a number expected, not 'two'");
  EXPECT_EQ(refused("1 // two"), "a.txt:1: a number expected, not '//'");
  EXPECT_EQ(refused("1 2 3 4\n1 2 3 4 5"), "a.txt:2: a line has more than 4 numbers");
}

} // namespace

} // namespace imgeo
