#pragma once
// Imported <-> bytes, for the pipe between a process and its child.

#include "import/import.h"

namespace imgeo {

Bytes serialized(const Imported& imported);

/// Both processes run the same program, so the layout of plain types is that of memory. Throws std::out_of_range for
/// bytes that end too early; the bytes are trusted otherwise.
Imported deserialized(ByteSpan bytes);

} // namespace imgeo
