#pragma once
// Converts an Imported to bytes and back, for the pipe between a process and its child.

#include "import/import.h"

namespace imgeo {

Bytes serialized(const Imported& imported);

/// Trivially copyable types are copied as they lie in memory, since both processes run the same program. Throws
/// std::out_of_range for bytes that end too early; trusts the bytes otherwise.
Imported deserialized(ByteSpan bytes);

} // namespace imgeo
