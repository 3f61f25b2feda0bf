#include "documents/field_messages.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace imgeo {

std::string shortened(const std::string& text) {
  constexpr std::size_t maxBytes = 40;
  std::size_t end = std::min(text.size(), maxBytes);
  while (end > 0 && end < text.size() &&
         (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) // inside of a character
    --end;
  return text.substr(0, end) + (end < text.size() ? "…" : "");
}

void failChoice(const FieldReader& fields, const char* name, std::span<const char* const> names) {
  fields.fail(ErrorKind::unsupported,
              fmt::format("{}=\"{}\" is none of {}", name, shortened(fields.text(name)), fmt::join(names, ", ")));
}

} // namespace imgeo
