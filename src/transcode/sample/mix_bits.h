#pragma once
// A hash of one number, for generated data that does not depend on the machine.

#include <cstdint>

namespace imgeo {

/// Mixes the bits of a number (the finaliser of splitmix64): another number for each number, without a pattern.
inline std::uint64_t mixBits(std::uint64_t value) {
  value = (value ^ value >> 30) * 0xbf58476d1ce4e5b9u;
  value = (value ^ value >> 27) * 0x94d049bb133111ebu;
  return value ^ value >> 31;
}

} // namespace imgeo
