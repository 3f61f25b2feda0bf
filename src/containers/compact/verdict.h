#pragma once
// For tests: states the outcome of decoding a file in one word, so that readers in several languages can be compared.
// web/src/decode/compact/verdict.testing.ts is the counterpart of the runtime.

#include "base/bytes.h"
#include "base/error.h"
#include "base/error_testing.h"
#include "containers/compact/patch_coding.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace imgeo::compact::testing {

/// Calls `visit(name, number)` for all numbers of a patch except its attributes. The names are keys of vectors/.
template <typename Visit> void visitNumbers(const CompactPatch& patch, Visit visit) {
  for (const Vec3u& position : patch.positions)
    for (int axis = 0; axis < 3; ++axis)
      visit("positions", std::int64_t{position[axis]});
  for (const std::uint32_t position : patch.wedgePositions)
    visit("wedgePositions", std::int64_t{position});
  for (const std::uint32_t wedge : patch.corners)
    visit("corners", std::int64_t{wedge});
  for (const std::uint32_t segment : patch.segments)
    visit("parts", std::int64_t{segment});
}

/// FNV-1a over every number that decodes, as four little-endian bytes each.
inline std::uint32_t sumOf(const std::vector<CompactPatch>& patches) {
  std::uint32_t hash = 2166136261u;
  const auto add = [&](std::int64_t number) {
    for (int shift = 0; shift < 32; shift += 8)
      hash = (hash ^ (static_cast<std::uint32_t>(number) >> shift & 255)) * 16777619u;
  };
  for (const CompactPatch& patch : patches) {
    visitNumbers(patch, [&](const char*, std::int64_t number) { add(number); });
    for (const Attribute& attribute : patch.attributes)
      for (const Value& value : attribute.values)
        for (std::uint32_t i = 0; i < attribute.type.components; ++i)
          add(value[i]);
  }
  return hash;
}

/// The sum of the patches that `decode` returns, or the kind of the Error that it throws.
template <typename Decode> std::string verdictOf(Decode decode) {
  try {
    return std::to_string(sumOf(decode()));
  } catch (const Error& error) {
    return imgeo::testing::nameOf(error.kind());
  }
}

/// The verdict of a payload.
inline std::string verdictOn(ByteSpan payload) {
  return verdictOf([&] { return decodePatches(payload, "x.png"); });
}

} // namespace imgeo::compact::testing
