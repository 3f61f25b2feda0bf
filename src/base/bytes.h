#pragma once
// Bytes in memory: owned as `Bytes`, passed as `ByteSpan`, read and appended with an explicit byte order.

#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace imgeo {

static_assert(std::endian::native == std::endian::little || std::endian::native == std::endian::big);

using Bytes = std::vector<std::uint8_t>;
using ByteSpan = std::span<const std::uint8_t>;

inline ByteSpan asBytes(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}
inline std::string_view asText(ByteSpan bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Reverses the bytes of a scalar.
template <typename T> T byteSwap(T value) {
  std::uint8_t raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  for (std::size_t i = 0; i < sizeof(T) / 2; ++i)
    std::swap(raw[i], raw[sizeof(T) - 1 - i]);
  std::memcpy(&value, raw, sizeof(T));
  return value;
}

/// Reads a scalar from unaligned bytes of the stated order. The caller checks that sizeof(T) bytes are available.
template <typename T> T loadLittle(const std::uint8_t* at) {
  T value;
  std::memcpy(&value, at, sizeof(T));
  return std::endian::native == std::endian::little ? value : byteSwap(value);
}
template <typename T> T loadBig(const std::uint8_t* at) {
  return byteSwap(loadLittle<T>(at));
}

/// Appends a scalar in the stated order.
template <typename T> void appendLittle(Bytes& out, T value) {
  if (std::endian::native != std::endian::little)
    value = byteSwap(value);
  const std::size_t at = out.size();
  out.resize(at + sizeof(T));
  std::memcpy(out.data() + at, &value, sizeof(T));
}
template <typename T> void appendBig(Bytes& out, T value) {
  appendLittle(out, byteSwap(value));
}

} // namespace imgeo
