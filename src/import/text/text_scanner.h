#pragma once
// One scanner for the text formats: words, numbers and lines, and the line to
// name when something is wrong. Lines are counted only when they are asked for.

#include "base/bytes.h"
#include "base/error.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace imgeo {

/// A word of a file as a message shows it: short, and in printable ASCII.
std::string asPrintable(std::string_view word);

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
  /// Goes to a byte of the text, or its end.
  void goTo(std::size_t byteOffset) { at_ = begin_ + byteOffset; }

  /// Skips what separates words within a line; a backslash at the end of a line
  /// continues it (OBJ).
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
  /// Goes to the beginning of the next line.
  void skipLine();

  /// The word here, empty at a line's end; does not skip blanks before it.
  std::string_view word();
  /// What is left of this line without blanks at its ends; stays on the line.
  std::string_view restOfLine();
  /// Skips `c` where it stands here.
  bool skipChar(char c) {
    const bool found = at_ != end_ && *at_ == c;
    at_ += found;
    return found;
  }

  /// The decimal integer here, which ends where its digits end; `what` names it
  /// where there is none.
  std::int64_t integer(const char* what);
  /// The same where the word must end with it.
  std::int64_t integerWord(const char* what);
  /// The number here as the nearest float; the word must end with it. "nan" and
  /// "inf" are numbers; what is too large becomes infinite, too small, zero.
  float float32(const char* what);
  double float64(const char* what);

  [[noreturn]] void fail(ErrorKind kind, const std::string& message) const;
  /// "bunny.obj:12", the line of this character.
  std::string location() const;

private:
  static bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }
  static bool isSpace(char c) { return isBlank(c) || c == '\n'; }
  bool skipBlank();
  std::string_view peekWord() const;
  template <typename T> T number(const char* what);
  [[noreturn]] void failNumber(const char* what) const;

  const char *begin_, *at_, *end_;
  const std::string& name_;
};

} // namespace imgeo
