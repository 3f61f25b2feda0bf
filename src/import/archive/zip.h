#pragma once
// ZIP archives (PKWARE APPNOTE 6.3, section 4.3): the unpacked size of those that Assimp unpacks, such as 3MF and ZAE,
// and the file in those that have only one, such as packed AMF. Assimp unpacks each entry to the size that the central
// directory states, so that checking the directory suffices.

#include "base/bytes.h"

#include <string>

namespace imgeo {

/// Whether bytes begin as an archive does.
bool isZip(ByteSpan bytes);

/// The sum of the unpacked sizes in an archive's central directory; 0 where there is no directory. Safe for untrusted
/// bytes.
std::uint64_t unpackedZipBytes(ByteSpan bytes);

/// Throws Error{limit} naming `name` where the bytes are an archive that unpacks to more than `unpackedLimit`.
void refuseZipBomb(ByteSpan bytes, const std::string& name);

/// The first file of an archive. Safe for untrusted bytes. Throws Error naming `name`: {malformed} where the archive is
/// damaged, {unsupported} where the file is neither stored nor deflated, or has 4 GiB or more, {limit} as
/// refuseZipBomb() does.
Bytes unpackZip(ByteSpan bytes, const std::string& name);

} // namespace imgeo
