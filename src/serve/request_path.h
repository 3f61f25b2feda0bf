#pragma once
// The path of a request: percent-decoding, and the names it may contain.
// RFC 9112 (request target), RFC 3986 (percent-encoding).

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace imgeo {

struct RequestPath {
  std::vector<std::string> names; ///< decoded, from the root; never empty, "." , ".." or with '/' or NUL
  bool isDirectory = false;       ///< ends in a slash (the root does)

  friend bool operator==(const RequestPath&, const RequestPath&) = default;
};

/// Reads a request target, "/a%20b/c?query" or "http://host/a". Nothing comes back
/// for what is no path, for a broken escape, and for "..", which no browser sends.
/// Safe for untrusted bytes.
std::optional<RequestPath> parseRequestTarget(std::string_view target);

/// The path as a target again: a slash in front, one behind if it is a directory,
/// everything but unreserved characters escaped.
std::string formatRequestPath(const RequestPath& path);

} // namespace imgeo
