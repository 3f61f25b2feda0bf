#include "import/text/number_lines.h"

#include "import/text/text_scanner.h"

#include <algorithm>
#include <fmt/format.h>

namespace imgeo {

namespace {

constexpr std::string_view blanks = " \t\r\v\f";
constexpr std::string_view separators = " \t\r\v\f,;";

std::string_view withoutComment(std::string_view line) {
  line = line.substr(0, line.find('#'));
  const std::size_t first = line.find_first_not_of(blanks);
  if (first == line.npos)
    return {};
  line = line.substr(first, line.find_last_not_of(blanks) - first + 1);
  return line.starts_with("//") ? std::string_view() : line;
}

/// Takes the next word of a line; empty at its end.
std::string_view takeWord(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(separators), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(separators));
  line.remove_prefix(word.size());
  return word;
}

} // namespace

std::vector<std::string_view> wordsOf(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::string_view word = takeWord(line); !word.empty(); word = takeWord(line))
    words.push_back(word);
  return words;
}

bool NumberLines::next() {
  while (end_ < text_.size()) {
    begin_ = end_;
    const std::size_t feed = std::min(text_.find('\n', begin_), text_.size());
    end_ = std::min(feed + 1, text_.size());
    line_ = withoutComment(text_.substr(begin_, feed - begin_));
    if (!line_.empty())
      return true;
  }
  return false;
}

std::optional<std::span<const double>> NumberLines::numbersIfAny() {
  numbers_.clear();
  std::string_view line = line_;
  for (std::string_view word = takeWord(line); !word.empty(); word = takeWord(line)) {
    const std::optional<double> number = doubleIn(word);
    if (!number)
      return std::nullopt;
    if (numbers_.size() == maxCount_)
      fail(fmt::format("a line has more than {} numbers", maxCount_));
    numbers_.push_back(*number);
  }
  return numbers_;
}

std::span<const double> NumberLines::numbers() {
  if (const std::optional<std::span<const double>> found = numbersIfAny())
    return *found;
  const std::vector<std::string_view> words = wordsOf(line_);
  const auto word = std::ranges::find_if(words, [](std::string_view each) { return !doubleIn(each); });
  fail(fmt::format("a number expected, not '{}'", asPrintable(*word)));
}

void NumberLines::fail(const std::string& message, ErrorKind kind) const {
  const auto line = 1 + std::ranges::count(text_.substr(0, begin_), '\n');
  throw Error(kind, fmt::format("{}:{}", name_, line), message);
}

} // namespace imgeo
