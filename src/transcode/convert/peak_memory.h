#pragma once

#include <cstdint>

namespace imgeo {

/// Maximum of the resident memory of this process so far, in bytes; 0 if the system does not tell.
std::uint64_t peakMemoryBytes();

} // namespace imgeo
