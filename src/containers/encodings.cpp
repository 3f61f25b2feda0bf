#include "containers/encodings.h"

#include "containers/bg/bg.h"
#include "containers/classic/classic.h"
#include "containers/compact/compact.h"

#include <array>

namespace imgeo {

namespace {

constexpr std::array encodingRows{&compactEncoding, &classicEncoding, &bgEncoding};

} // namespace

const char* nameOf(Encoding encoding) {
  return rowOf(encoding).name;
}

std::span<const EncodingRow* const> allEncodings() {
  return encodingRows;
}

const EncodingRow& rowOf(Encoding encoding) {
  return *encodingRows.at(static_cast<std::size_t>(encoding));
}

const EncodingRow* findEncoding(std::string_view container, std::string_view profile) {
  for (const EncodingRow* row : encodingRows)
    if (row->container == container && row->profile == profile)
      return row;
  return nullptr;
}

} // namespace imgeo
