#pragma once
// Line ends of classic Mac OS, which some programs still write: carriage returns alone.

#include "base/bytes.h"

#include <optional>
#include <string>

namespace imgeo {

/// Whether carriage returns alone end the lines of a text: it has some, and no line feed.
bool endsLinesWithCarriageReturns(ByteSpan text);

/// A copy of such a text, with line feeds for its carriage returns; nothing for other texts.
std::optional<Bytes> withLineFeeds(ByteSpan text);
/// A copy of any bytes, with line feeds for their carriage returns.
Bytes withoutCarriageReturns(ByteSpan bytes);

/// Throws Error{unsupported} for such a text, which readers of files that memory does not hold do not read.
void requireLineFeeds(ByteSpan text, const std::string& name);
[[noreturn]] void failOfCarriageReturns(const std::string& name);

} // namespace imgeo
