#pragma once
// The payload of a file <-> the pixels of a gray PNG.

#include "base/bytes.h"

#include <string>

namespace imgeo::compact {

/// Maximum number of bytes in an image, 4096^2.
inline constexpr std::size_t maxPayloadBytes = std::size_t{4096} * 4096;

/// Writes 1 .. maxPayloadBytes bytes with encodePlainPng. Zeros fill the last row.
Bytes imageOfPayload(ByteSpan payload);

/// Reads them back, with the zeros. Safe for untrusted bytes. Throws Error naming `location`.
Bytes payloadOfImage(ByteSpan png, const std::string& location);

} // namespace imgeo::compact
