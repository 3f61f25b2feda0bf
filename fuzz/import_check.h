#pragma once
// The check of all fuzz targets of input formats: every input gives an Error with a message, or a scene that keeps the
// promises of import.h. Aborts otherwise. This header includes nothing of the library, as most targets need no more,
// and headers would take most of the time of compiling them.

#include <cstddef>
#include <cstdint>

namespace imgeo::fuzz {

/// Runs the check on the bytes of an input file `name`. Returns 0, as fuzz targets do.
int importOrRefuse(const std::uint8_t* data, std::size_t size, const char* name);

} // namespace imgeo::fuzz
