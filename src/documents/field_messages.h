#pragma once
// Sentences about fields of elements. Pages say the same: web/src/document/geometryChecks.ts.

#include "documents/field_reader.h"

#include <span>
#include <string>

namespace imgeo {

/// The beginning of an attribute's text, for messages: at most 40 bytes, and "…" where there are more.
std::string shortened(const std::string& text);

/// Throws Error{unsupported} for a field whose text is none of these names.
[[noreturn]] void failChoice(const FieldReader& fields, const char* name, std::span<const char* const> names);

} // namespace imgeo
