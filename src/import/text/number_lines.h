#pragma once
// Texts of lines of numbers, between which are blanks, commas or semicolons: points (XYZ), vertices and faces (OFF).

#include "base/bytes.h"
#include "base/error.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace imgeo {

/// The words of a line.
std::vector<std::string_view> wordsOf(std::string_view line);

class NumberLines {
public:
  /// `text` and `name` must outlive it. Lines of more than `maxCount` numbers are refused.
  NumberLines(ByteSpan text, const std::string& name, std::size_t maxCount, std::size_t from = 0)
      : text_(asText(text)), name_(name), maxCount_(maxCount), begin_(from), end_(from) {}

  /// Moves to the next line with more than a comment, which begins with # or, at a line's beginning, with //; false at
  /// the end of the text.
  bool next();
  std::size_t begin() const { return begin_; } ///< the byte of the line
  std::size_t end() const { return end_; }     ///< the byte behind it and its line feed
  /// The line without a comment and surrounding blanks.
  std::string_view text() const { return line_; }

  /// The numbers of the line, until the next call; nothing where it has another word.
  std::optional<std::span<const double>> numbersIfAny();
  /// The same. Throws Error{malformed} for another word.
  std::span<const double> numbers();

  /// Throws Error with the line's number.
  [[noreturn]] void fail(const std::string& message, ErrorKind kind = ErrorKind::malformed) const;

private:
  std::string_view text_;
  const std::string& name_;
  std::size_t maxCount_;
  std::size_t begin_, end_;
  std::string_view line_;
  std::vector<double> numbers_;
};

} // namespace imgeo
