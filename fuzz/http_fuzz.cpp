// Parses the target and header fields of a request, one a line: target, Range, Accept-Encoding, If-None-Match. Results
// must stay within their bounds for all inputs.
#include "base/bytes.h"
#include "content/content_coding.h"
#include "serve/range_header.h"
#include "serve/request_path.h"
#include "serve/respond.h"

#include <algorithm>
#include <cstdlib>

namespace {

using namespace imgeo;

void require(bool condition) {
  if (!condition)
    std::abort();
}

std::string_view takeLine(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

void checkTarget(std::string_view target) {
  const std::optional<RequestPath> path = parseRequestTarget(target);
  if (!path)
    return;
  for (const std::string& name : path->names) {
    require(!name.empty() && name != "." && name != "..");
    require(name.find('/') == std::string::npos && name.find('\0') == std::string::npos);
  }
  const std::string formatted = formatRequestPath(*path);
  require(std::all_of(formatted.begin(), formatted.end(), [](char c) { return c > ' ' && c < 127; }));
  if (!formatted.empty())
    require(parseRequestTarget(formatted) == path);
}

void checkRange(std::string_view header, std::uint64_t size) {
  const ByteRange range = parseRange(header, size);
  if (range.kind == ByteRange::Kind::whole)
    require(range.first == 0 && range.count == size);
  if (range.kind == ByteRange::Kind::partial)
    require(range.count > 0 && range.first < size && range.count <= size - range.first);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view text = asText({data, size});
  checkTarget(takeLine(text));
  const std::string_view range = takeLine(text);
  for (const std::uint64_t fileSize : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{1000}, ~std::uint64_t{0}})
    checkRange(range, fileSize);
  const std::string_view accepted = takeLine(text);
  // Without the name of a coding, the response is not compressed.
  if (accepted.find_first_of("bBgGxX*") == std::string_view::npos)
    require(chooseCoding(accepted) == ContentCoding::identity);
  const std::string_view tags = takeLine(text);
  if (matchesAnyTag(tags, "\"1-2-3\""))
    require(tags.find('*') != std::string_view::npos || tags.find("\"1-2-3\"") != std::string_view::npos);
  return 0;
}
