#pragma once
// Decodes geometry files into patches, in every encoding.

#include "containers/patch_encoder.h"
#include "containers/patch_reader.h"

#include <memory>
#include <string>
#include <vector>

namespace imgeo {

/// Reads the geometry files of one site, in every encoding. A file that several patches share is decoded once if they
/// are requested one after the other. Safe to call from any thread.
class ContainerReader {
public:
  explicit ContainerReader(const FetchFile& fetch);

  /// The lattice to decode a geometry of another program with: see PatchReader::latticeOf().
  Lattice latticeOf(const GeometryDescription& geometry) const;

  /// Decodes a patch. Safe for untrusted bytes: sizes and indices are checked against the description, and limits
  /// (containers/limits.h) bound every allocation. Throws Error naming the url. Decoded normals have unit length.
  IndexedPatch decode(const PatchDescription& patch, const GeometryDescription& geometry) const;

  /// Decodes the base mesh of a geometry that has one. Checks and errors are those of decode().
  BaseMesh decodeBase(const GeometryDescription& geometry) const;

  /// The precision of stored attributes, from the node or, in compact, from the file of the first patch. Safe for
  /// untrusted bytes.
  StoredPrecision precisionOf(const GeometryDescription& geometry) const;

  /// The function that gives the bytes of files.
  const FetchFile& fetch() const { return fetch_; }

private:
  PatchReader& readerOf(const GeometryDescription& geometry) const;

  FetchFile fetch_;
  std::vector<std::unique_ptr<PatchReader>> readers_; ///< by encoding
};

/// Decodes one patch.
IndexedPatch decodePatch(const PatchDescription& patch, const GeometryDescription& geometry, const FetchFile& fetch);

/// Decodes an encoded patch from its files in memory.
IndexedPatch decodePatch(const EncodedPatch& encoded, const GeometryDescription& geometry);

} // namespace imgeo
