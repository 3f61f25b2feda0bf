#pragma once
// Sizes of memory on the command line.

#include <cstdint>
#include <string>

namespace imgeo::cli {

/// The bytes of "1G" or "800M": powers of 1024, as ulimit and cgroups have them. Throws Error{usage} for other texts.
std::uint64_t memoryFrom(const std::string& text);

} // namespace imgeo::cli
