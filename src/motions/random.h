#pragma once
// Random numbers that are the same on every machine: the standard library's engines are specified, its distributions
// are not.

#include <cstdint>
#include <random>

namespace imgeo {

class Random {
public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}

  /// 0 to 1, without 1.
  float unit() { return static_cast<float>(engine_() >> 8) / 16777216.0F; }
  /// -1 to 1, most often near 0: the mean of three uniform numbers.
  float centred() { return (unit() + unit() + unit()) * (2.0F / 3) - 1; }

private:
  std::mt19937 engine_;
};

} // namespace imgeo
