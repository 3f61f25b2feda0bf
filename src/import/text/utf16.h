#pragma once
// Text in UTF-16, as Windows programs save it.

#include "base/bytes.h"

#include <optional>

namespace imgeo {

/// The bytes of a text in UTF-16 as UTF-8, without its byte order mark; empty if the bytes begin with none. Unpaired
/// surrogates become U+FFFD, and an odd last byte is dropped.
std::optional<Bytes> utf8OfUtf16(ByteSpan bytes);

} // namespace imgeo
