#pragma once
// How the patches of a geometry are stored. containers/encodings.h has a row for each encoding.

#include <cstdint>

namespace imgeo {

/// compact and classic are SIG (images), bg is typed arrays; the order is that of the registry.
enum class Encoding : std::uint8_t { compact, classic, bg };

/// "compact", "classic", "bg".
const char* nameOf(Encoding encoding);

} // namespace imgeo
