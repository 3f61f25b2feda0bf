#pragma once
// Bytes as the pixels of a gray PNG, and back.

#include "base/bytes.h"

#include <string>

namespace imgeo::compact {

/// Bytes in an image: at most 4096^2. They are compressed already, so nothing is searched for.
inline constexpr std::size_t maxPayloadBytes = std::size_t{4096} * 4096;

/// At least one byte, at most maxPayloadBytes. Zeros fill the last row.
Bytes imageOfPayload(ByteSpan payload);

/// Safe for untrusted bytes. Throws Error naming `location`.
Bytes payloadOfImage(ByteSpan png, const std::string& location);

} // namespace imgeo::compact
