#include "import/vrml/tokens.h"

#include "import/text/text_scanner.h"
#include "import/x3d/elements.h"

#include <fmt/format.h>
#include <utility>

namespace imgeo::x3d {

namespace {

constexpr std::string_view space = " \t\r\n,"; // VRML treats commas as blanks
constexpr std::string_view wordEnds = " \t\r\n,#\"'[]{}";

bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

} // namespace

VrmlTokens::VrmlTokens(std::string_view text, const std::string& name) : text_(text), name_(name) {
  next_ = scan();
}

void VrmlTokens::skipSpace() {
  for (;;) {
    at_ = std::min(text_.find_first_not_of(space, at_), text_.size());
    if (at_ == text_.size() || text_[at_] != '#')
      return;
    const std::size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
    comments_.push_back(text_.substr(at_ + 1, end - at_ - 1));
    at_ = end;
  }
}

Token VrmlTokens::scan() {
  skipSpace();
  const std::size_t begin = at_;
  if (begin == text_.size())
    return {TokenKind::end, {}, begin};
  const auto single = [&](TokenKind kind) { return Token{kind, text_.substr(at_++, 1), begin}; };
  switch (text_[begin]) {
  case '{':
    return single(TokenKind::openNode);
  case '}':
    return single(TokenKind::closeNode);
  case '[':
    return single(TokenKind::openList);
  case ']':
    return single(TokenKind::closeList);
  case '"':
    for (++at_; at_ < text_.size() && text_[at_] != '"'; ++at_)
      at_ += text_[at_] == '\\';
    if (at_ >= text_.size())
      fail({TokenKind::string, {}, begin}, ErrorKind::truncated, "the string that begins here has no end");
    ++at_;
    return {TokenKind::string, text_.substr(begin + 1, at_ - begin - 2), begin};
  default:
    break;
  }
  at_ = std::min(text_.find_first_of(wordEnds, at_), text_.size());
  if (at_ == begin)
    fail({TokenKind::word, {}, begin}, ErrorKind::malformed, "a word of VRML cannot begin with an apostrophe");
  const std::string_view word = text_.substr(begin, at_ - begin);
  const char first = word[0] == '+' || word[0] == '-' || word[0] == '.' ? word[word.size() > 1] : word[0];
  const bool isNumber = isDigit(first) || (first == '.' && word.size() > 2 && isDigit(word[2]));
  return {isNumber ? TokenKind::number : TokenKind::word, word, begin};
}

Token VrmlTokens::take() {
  const Token token = next_;
  if (token.kind != TokenKind::end)
    next_ = scan();
  return token;
}

Token VrmlTokens::take(TokenKind kind, const char* what) {
  if (!nextIs(kind))
    failExpecting(what);
  return take();
}

std::string VrmlTokens::locationOf(const Token& token) const {
  return x3d::locationOf(text_, name_, token.offset);
}

void VrmlTokens::fail(const Token& token, ErrorKind kind, const std::string& message) const {
  throw Error(kind, locationOf(token), message);
}

void VrmlTokens::failExpecting(const std::string& what) const {
  if (nextIs(TokenKind::end))
    fail(next_, ErrorKind::truncated, "the file ends where " + what + " should stand");
  fail(next_, ErrorKind::malformed, fmt::format("\"{}\" stands where {} should", asPrintable(next_.text), what));
}

std::string unescaped(std::string_view text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    i += text[i] == '\\' && i + 1 < text.size();
    plain += text[i];
  }
  return plain;
}

} // namespace imgeo::x3d
