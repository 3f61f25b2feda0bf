#pragma once
// Which attributes are read from the source.

#include "imgeo/convert.h"
#include "import/import.h"

namespace imgeo {

/// How a source is read. Fog needs depths, whatever else is kept.
ImportOptions importOptionsFor(const ConvertOptions& options, RecordingChoice recordings);

/// Throws Error{usage} where the source lacks an attribute that the options name.
void requireAttributes(const Imported& imported, const ConvertOptions& options);

} // namespace imgeo
