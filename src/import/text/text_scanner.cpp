#include "import/text/text_scanner.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <fmt/format.h>
#include <limits>

namespace imgeo {

namespace {

/// The value of a decimal outside the range of double: zero or infinite.
double beyondDouble(std::string_view word) {
  const bool isNegative = word.front() == '-';
  const std::string_view digits = word.substr(isNegative || word.front() == '+');
  const std::size_t exponent = digits.find_first_of("eE");
  const bool isTiny = exponent == digits.npos ? digits.front() == '0' || digits.front() == '.'
                                              : digits.substr(exponent + 1).starts_with('-');
  const double magnitude = isTiny ? 0 : std::numeric_limits<double>::infinity();
  return isNegative ? -magnitude : magnitude;
}

/// Skips a plus sign, which std::from_chars does not accept.
const char* afterPlus(const char* at, const char* end) {
  return end - at > 1 && at[0] == '+' && at[1] != '-' ? at + 1 : at;
}

} // namespace

std::string asPrintable(std::string_view word) {
  std::string text(word.substr(0, 40));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7f)
      c = '?';
  return word.size() > 40 ? text + "…" : text;
}

std::optional<double> doubleIn(std::string_view word) {
  const char* const end = word.data() + word.size();
  double value = 0;
  const auto [to, error] = std::from_chars(afterPlus(word.data(), end), end, value);
  if (to != end || error == std::errc::invalid_argument)
    return std::nullopt;
  return error == std::errc::result_out_of_range ? beyondDouble(word) : value;
}

TextScanner::TextScanner(ByteSpan text, const std::string& name, std::size_t from)
    : begin_(asText(text).data()), at_(begin_ + from), end_(begin_ + text.size()), name_(name) {}

bool TextScanner::skipBlank() {
  if (*at_ == '\\') {
    const std::string_view rest(at_ + 1, static_cast<std::size_t>(end_ - at_ - 1));
    const std::size_t length = rest.starts_with("\r\n") ? 3 : rest.starts_with('\n') ? 2 : 0;
    at_ += length;
    return length > 0;
  }
  ++at_;
  return true;
}

void TextScanner::skipLine() {
  const void* found = at_ == end_ ? nullptr : std::memchr(at_, '\n', bytesLeft());
  at_ = found ? static_cast<const char*>(found) + 1 : end_;
}

std::string_view TextScanner::peekWord() const {
  const char* to = at_;
  while (to != end_ && !isSpace(*to))
    ++to;
  return {at_, static_cast<std::size_t>(to - at_)};
}

std::string_view TextScanner::word() {
  const std::string_view result = peekWord();
  at_ += result.size();
  return result;
}

std::string_view TextScanner::restOfLine() {
  while (at_ != end_ && isBlank(*at_))
    ++at_;
  const char* to = std::find(at_, end_, '\n');
  const char* from = at_;
  at_ = to;
  while (to != from && isBlank(to[-1]))
    --to;
  return {from, static_cast<std::size_t>(to - from)};
}

std::int64_t TextScanner::integer(const char* what) {
  const char* from = afterPlus(at_, end_);
  std::int64_t value = 0;
  const auto [to, error] = std::from_chars(from, end_, value);
  if (error != std::errc())
    failNumber(what);
  at_ = to;
  return value;
}

std::int64_t TextScanner::integerWord(const char* what) {
  const char* from = at_;
  const std::int64_t value = integer(what);
  if (atWordEnd())
    return value;
  at_ = from;
  failNumber(what);
}

template <typename T> T TextScanner::number(const char* what) {
  const char* from = afterPlus(at_, end_);
  T value = 0;
  auto [to, error] = std::from_chars(from, end_, value);
  if (error == std::errc::result_out_of_range) {
    double wide = 0;
    if (std::from_chars(from, end_, wide).ec != std::errc())
      wide = beyondDouble(peekWord());
    value = static_cast<T>(wide);
  } else if (error != std::errc()) {
    failNumber(what);
  }
  if (to != end_ && !isSpace(*to))
    failNumber(what);
  at_ = to;
  return value;
}

float TextScanner::float32(const char* what) {
  return number<float>(what);
}
double TextScanner::float64(const char* what) {
  return number<double>(what);
}

void TextScanner::failNumber(const char* what) const {
  if (atEnd())
    fail(ErrorKind::truncated, fmt::format("the file ends where {} should stand", what));
  if (atLineEnd())
    fail(ErrorKind::malformed, fmt::format("the line ends where {} should stand", what));
  fail(ErrorKind::malformed, fmt::format("{} expected, not '{}'", what, asPrintable(peekWord())));
}

std::string TextScanner::location() const {
  return fmt::format("{}:{}", name_, 1 + std::count(begin_, at_, '\n'));
}

void TextScanner::fail(ErrorKind kind, const std::string& message) const {
  throw Error(kind, location(), message);
}

} // namespace imgeo
