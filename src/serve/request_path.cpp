#include "serve/request_path.h"

#include <fmt/format.h>

namespace imgeo {

namespace {

int hexDigit(char c) {
  if (c >= '0' && c <= '9')
    return c - '0';
  if (c >= 'a' && c <= 'f')
    return c - 'a' + 10;
  if (c >= 'A' && c <= 'F')
    return c - 'A' + 10;
  return -1;
}

/// The path of an absolute target, "http://host/path", which proxies send.
std::string_view withoutOrigin(std::string_view target) {
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (!target.starts_with(scheme))
      continue;
    const std::size_t slash = target.find('/', scheme.size());
    return slash == std::string_view::npos ? "/" : target.substr(slash);
  }
  return target;
}

bool isUnreserved(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '.' ||
         c == '_' || c == '~';
}

} // namespace

std::optional<std::string> percentDecode(std::string_view text) {
  std::string decoded;
  decoded.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded += text[i];
      continue;
    }
    if (text.size() - i < 3)
      return std::nullopt;
    const int high = hexDigit(text[i + 1]), low = hexDigit(text[i + 2]);
    if (high < 0 || low < 0)
      return std::nullopt;
    decoded += static_cast<char>(high * 16 + low);
    i += 2;
  }
  return decoded;
}

std::optional<RequestPath> parseRequestTarget(std::string_view target) {
  target = withoutOrigin(target);
  target = target.substr(0, target.find_first_of("?#"));
  if (!target.starts_with('/'))
    return std::nullopt;

  RequestPath path;
  path.isDirectory = true;
  for (std::size_t at = 1; at < target.size();) {
    const std::size_t end = std::min(target.find('/', at), target.size());
    std::optional<std::string> name = percentDecode(target.substr(at, end - at));
    // Decoding comes after splitting: a name with an escaped slash is refused.
    if (!name || *name == ".." || name->find_first_of(std::string_view("/\0", 2)) != std::string::npos)
      return std::nullopt;
    const bool isSkipped = name->empty() || *name == ".";
    path.isDirectory = isSkipped || end < target.size();
    if (!isSkipped)
      path.names.push_back(std::move(*name));
    at = end + 1;
  }
  return path;
}

std::string formatRequestPath(const RequestPath& path) {
  std::string target;
  for (const std::string& name : path.names) {
    target += '/';
    for (const char c : name) {
      if (isUnreserved(c))
        target += c;
      else
        target += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
  }
  if (path.isDirectory)
    target += '/';
  return target;
}

} // namespace imgeo
