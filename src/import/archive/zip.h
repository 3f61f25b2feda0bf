#pragma once
// ZIP archives (PKWARE's APPNOTE 6.3, section 4.3), as 3MF and ZAE are: what they would
// unpack to. Assimp unpacks them, one entry at a time into the bytes that its directory
// states, so that the directory is all there is to look at.

#include "base/bytes.h"

#include <string>

namespace imgeo {

/// Bytes that the entries of an archive's central directory unpack to, together; 0 where
/// there is no directory. Safe for untrusted bytes.
std::uint64_t unpackedZipBytes(ByteSpan bytes);

/// Throws Error{limit} naming `name` where the bytes are an archive that unpacks to more
/// than `unpackedLimit` has it.
void refuseZipBomb(ByteSpan bytes, const std::string& name);

} // namespace imgeo
