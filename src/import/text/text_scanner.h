#pragma once
// The scanner of the text formats: words, numbers and lines. It counts lines only when an error needs a location.

#include "base/bytes.h"
#include "base/error.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace imgeo {

/// A word of a file for a message: its first 40 characters, with ? for each that is not printable ASCII.
std::string asPrintable(std::string_view word);

/// The number that a whole word is, as TextScanner::float64 takes it; nothing for other words.
std::optional<double> doubleIn(std::string_view word);

class TextScanner {
public:
  /// `text` and `name` must outlive the scanner.
  TextScanner(ByteSpan text, const std::string& name, std::size_t from = 0);

  bool atEnd() const { return at_ == end_; }
  /// True at a line feed and at the end.
  bool atLineEnd() const { return at_ == end_ || *at_ == '\n'; }
  bool atWordEnd() const { return at_ == end_ || isSpace(*at_); }
  std::size_t bytesLeft() const { return static_cast<std::size_t>(end_ - at_); }
  std::size_t byteOffset() const { return static_cast<std::size_t>(at_ - begin_); }
  /// Moves to a byte of the text or to its end.
  void goTo(std::size_t byteOffset) { at_ = begin_ + byteOffset; }

  /// Skips white space within a line; a backslash at the end of a line continues it (OBJ).
  void skipBlanks() {
    while (at_ != end_ && (isBlank(*at_) || *at_ == '\\'))
      if (!skipBlank())
        return;
  }
  /// Skips blanks and line ends.
  void skipSpace() {
    while (at_ != end_ && isSpace(*at_))
      ++at_;
  }
  /// Moves to the beginning of the next line.
  void skipLine();

  /// Takes the word at the cursor, empty at a line's end; does not skip blanks before it.
  std::string_view word();
  /// Takes the rest of the line without surrounding blanks; the cursor stays at the line's end.
  std::string_view restOfLine();
  /// Skips `c` if it is the next character.
  bool skipChar(char c) {
    const bool found = at_ != end_ && *at_ == c;
    at_ += found;
    return found;
  }

  /// Takes a decimal integer, which ends where its digits end; `what` names it in errors.
  std::int64_t integer(const char* what);
  /// Takes a decimal integer that must be the whole word.
  std::int64_t integerWord(const char* what);
  /// Takes a number, which must be the whole word, as the nearest float. "nan" and "inf" are numbers; too large numbers
  /// become infinite, too small ones zero.
  float float32(const char* what);
  double float64(const char* what);

  [[noreturn]] void fail(ErrorKind kind, const std::string& message) const;
  /// "bunny.obj:12": the line of the cursor.
  std::string location() const;

private:
  static bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }
  static bool isSpace(char c) { return isBlank(c) || c == '\n'; }
  /// Skips a blank, or a backslash with the line end after it; false at any other backslash.
  bool skipBlank();
  std::string_view peekWord() const;
  template <typename T> T number(const char* what);
  [[noreturn]] void failNumber(const char* what) const;

  const char *begin_, *at_, *end_;
  const std::string& name_;
};

} // namespace imgeo
