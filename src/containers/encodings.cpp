#include "containers/encodings.h"

#include "containers/bg/bg.h"
#include "containers/classic/classic.h"
#include "containers/compact/compact.h"

#include <array>

namespace imgeo {

namespace {

constexpr std::array rows{&compactEncoding, &classicEncoding, &bgEncoding};

} // namespace

const char* nameOf(Encoding encoding) {
  return rowOf(encoding).name;
}

std::span<const EncodingRow* const> allEncodings() {
  return rows;
}

const EncodingRow& rowOf(Encoding encoding) {
  return *rows.at(static_cast<std::size_t>(encoding));
}

const EncodingRow* findEncoding(std::string_view container, std::string_view profile) {
  for (const EncodingRow* row : rows)
    if (row->container == container && row->profile == profile)
      return row;
  return nullptr;
}

} // namespace imgeo
