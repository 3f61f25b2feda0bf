#include "import/references.h"

#include "base/error.h"
#include "base/file.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>

namespace imgeo {

namespace fs = std::filesystem;

namespace {

/// Whether a URL has a scheme (RFC 3986): a letter, then alphabet, digits and "+-.", then a colon. One letter is a
/// drive of Windows.
bool hasScheme(std::string_view url) {
  const std::size_t colon = url.find(':');
  return colon != url.npos && colon > 1 && std::isalpha(static_cast<unsigned char>(url[0])) &&
         std::ranges::all_of(url.substr(0, colon),
                             [](unsigned char c) { return std::isalnum(c) || c == '+' || c == '-' || c == '.'; });
}

/// The first 60 characters of a URL, for messages.
std::string shortened(std::string_view url) {
  return std::string(url.substr(0, 60)) + (url.size() > 60 ? "..." : "");
}

} // namespace

fs::path References::fileOf(std::string_view url) const {
  const auto refuse = [&](const char* why) {
    throw Error(ErrorKind::unsupported, sourceName_, fmt::format("refers to \"{}\", {}", shortened(url), why));
  };
  if (hasScheme(url) || url.starts_with("//"))
    refuse("which is on another host; imgeo reads only local files");
  if (folder_.empty())
    refuse("which can only be found beside a file, not beside standard input");
  const std::string name = percentDecoded(url.substr(0, url.find_first_of("?#")));
  if (name.empty() || name.find('\0') != name.npos)
    refuse("which names no file");
  fs::path file = folder_ / name;
  std::error_code ignored;
  if (!fs::exists(file, ignored)) // some exporters write % and # without escapes
    if (const fs::path asWritten = folder_ / std::string(url); fs::exists(asWritten, ignored))
      file = asWritten;
  const fs::path folder = fs::weakly_canonical(within_, ignored), real = fs::weakly_canonical(file, ignored);
  const bool isInside = std::mismatch(folder.begin(), folder.end(), real.begin(), real.end()).first == folder.end();
  if (!isInside && !allowsOutside_)
    refuse("which lies outside of the folder of the source; --outside allows that");
  return file;
}

Bytes References::fetch(std::string_view url) const {
  if (isDataUrl(url))
    return bytesOfDataUrl(url, sourceName_);
  const fs::path file = fileOf(url);
  std::error_code ignored;
  if (fs::exists(file, ignored) && !fs::is_regular_file(file, ignored))
    throw Error(ErrorKind::io, file.string(), "is no file");
  return readFile(file);
}

Error faultOfSource(const Error& error) {
  return error.kind() == ErrorKind::io ? Error(ErrorKind::malformed, error.location(), error.message()) : error;
}

} // namespace imgeo
