#pragma once
// The tokens of VRML (ISO/IEC 14772-1, annex A; ISO/IEC 19776-2).

#include "base/error.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace imgeo::x3d {

enum class TokenKind : std::uint8_t { end, word, number, string, openNode, closeNode, openList, closeList };

struct Token {
  TokenKind kind = TokenKind::end;
  std::string_view text; ///< of a string: the text between its quotes, with escapes
  std::size_t offset = 0;
};

class VrmlTokens {
public:
  /// `text` and `name` must outlive the tokens.
  VrmlTokens(std::string_view text, const std::string& name);

  const Token& next() const { return next_; }
  bool nextIs(TokenKind kind) const { return next_.kind == kind; }
  bool nextIs(std::string_view word) const { return next_.kind == TokenKind::word && next_.text == word; }
  /// Takes the next token. Throws Error{malformed, truncated} where the token after it is invalid.
  Token take();
  /// Takes the next token, which must be of this kind; `what` names it in errors.
  Token take(TokenKind kind, const char* what);

  /// The comments that were skipped since the last call, without their #.
  std::vector<std::string_view> takeComments() { return std::exchange(comments_, {}); }

  /// "hall.wrl:12:3"
  std::string locationOf(const Token& token) const;
  [[noreturn]] void fail(const Token& token, ErrorKind kind, const std::string& message) const;
  /// Throws an Error that names the expected token.
  [[noreturn]] void failExpecting(const std::string& what) const;

private:
  Token scan();
  void skipSpace();

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
  Token next_;
  std::vector<std::string_view> comments_;
};

/// "say \"hello\"" -> say "hello"
std::string unescaped(std::string_view text);

} // namespace imgeo::x3d
