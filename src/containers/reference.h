#pragma once
// References of documents to geometry files: the file, and where in it the data begins.

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace imgeo {

/// The first texel of an image (classic).
struct TexelLocation {
  std::uint32_t firstTexel = 0;
  friend bool operator==(const TexelLocation&, const TexelLocation&) = default;
};

/// A patch or base of a file that several share (compact), counted from 0 in the order of the file.
struct PatchLocation {
  std::uint32_t patchIndex = 0;
  friend bool operator==(const PatchLocation&, const PatchLocation&) = default;
};

/// The records of an array (bg).
struct ByteLocation {
  std::uint32_t byteOffset = 0; ///< of the first record
  std::uint32_t byteStride = 0; ///< from one record to the next; 0: tightly packed
  friend bool operator==(const ByteLocation&, const ByteLocation&) = default;
};

/// The encoding of a geometry determines which of these its references have: EncodingRow::location.
using FileLocation = std::variant<TexelLocation, PatchLocation, ByteLocation>;

struct Reference {
  std::string url; ///< relative to the document
  FileLocation location;
  std::vector<std::string> furtherUrls{}; ///< tried in order where `url` cannot be read: see chooseUrls()
  friend bool operator==(const Reference&, const Reference&) = default;
};

} // namespace imgeo
