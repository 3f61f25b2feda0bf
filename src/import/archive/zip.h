#pragma once
// The unpacked size of ZIP archives (PKWARE APPNOTE 6.3, section 4.3) such as 3MF and ZAE. Assimp unpacks each entry to
// the size that the central directory states, so that checking the directory suffices.

#include "base/bytes.h"

#include <string>

namespace imgeo {

/// The sum of the unpacked sizes in an archive's central directory; 0 where there is no directory. Safe for untrusted
/// bytes.
std::uint64_t unpackedZipBytes(ByteSpan bytes);

/// Throws Error{limit} naming `name` where the bytes are an archive that unpacks to more than `unpackedLimit`.
void refuseZipBomb(ByteSpan bytes, const std::string& name);

} // namespace imgeo
