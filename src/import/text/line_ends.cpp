#include "import/text/line_ends.h"

#include "base/error.h"

#include <algorithm>

namespace imgeo {

bool endsLinesWithCarriageReturns(ByteSpan text) {
  const std::string_view characters = asText(text);
  return characters.find('\n') == characters.npos && characters.find('\r') != characters.npos;
}

std::optional<Bytes> withLineFeeds(ByteSpan text) {
  if (!endsLinesWithCarriageReturns(text))
    return {};
  return withoutCarriageReturns(text);
}

Bytes withoutCarriageReturns(ByteSpan bytes) {
  Bytes changed(bytes.begin(), bytes.end());
  std::ranges::replace(changed, std::uint8_t{'\r'}, std::uint8_t{'\n'});
  return changed;
}

void requireLineFeeds(ByteSpan text, const std::string& name) {
  if (endsLinesWithCarriageReturns(text))
    failOfCarriageReturns(name);
}

void failOfCarriageReturns(const std::string& name) {
  throw Error(ErrorKind::unsupported, name,
              "its lines end with carriage returns alone, as on classic Mac OS, which is not read piece by piece or "
              "from a stream: tr '\\r' '\\n' < FILE > COPY writes a copy with line feeds");
}

} // namespace imgeo
