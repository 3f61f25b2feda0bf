#pragma once

#include <cstdint>

namespace imgeo {

/// The most memory this process has held so far, in bytes; 0 where the system
/// does not tell.
std::uint64_t peakMemoryBytes();

} // namespace imgeo
