#pragma once
// The path of a request: percent-decoding and validation.
// RFC 9112 (request target), RFC 3986 (percent-encoding).

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace imgeo {

struct RequestPath {
  std::vector<std::string> names; ///< decoded, from the root; none is empty, "." or "..", or contains '/' or NUL
  bool isDirectory = false;       ///< ends in a slash (the root does)

  friend bool operator==(const RequestPath&, const RequestPath&) = default;
};

/// Decodes %XX; nothing where two hexadecimal digits are missing behind a %.
std::optional<std::string> percentDecode(std::string_view text);

/// Parses a request target, "/a%20b/c?query" or "http://host/a". Returns nothing for a target without a path, a
/// malformed escape, an escaped slash or NUL, or "..", which browsers resolve before they send. Safe for untrusted
/// bytes.
std::optional<RequestPath> parseRequestTarget(std::string_view target);

/// The path as a request target: it begins with a slash, a directory ends in one, and every character that is not
/// unreserved is percent-encoded.
std::string formatRequestPath(const RequestPath& path);

} // namespace imgeo
