#pragma once
// The interface of an encoding's reader.

#include "base/bytes.h"
#include "containers/geometry_description.h"
#include "prepare/base_mesh.h"

#include <functional>
#include <string>

namespace imgeo {

/// Gives the bytes of a url; throws Error{io} where there are none.
using FetchFile = std::function<Bytes(const std::string& url)>;

/// Bits of a component of each attribute; 0: a geometry lacks the attribute.
struct StoredPrecision {
  ByVertexRole<std::uint32_t> bits;
  NormalEncoding normalEncoding = NormalEncoding::rgb;
};

/// Reads geometries of one encoding. Safe to call from any thread, and for untrusted bytes: sizes and indices are
/// checked against the description, and limits (containers/limits.h) bound every allocation. Throws Error naming the
/// url.
class PatchReader {
public:
  virtual ~PatchReader() = default;

  /// The lattice to decode a geometry with: the node's own. X3DOM does not use the box of Float32 coordinates: where it
  /// is not about that of the coordinates, the lattice is one around them.
  virtual Lattice latticeOf(const GeometryDescription& geometry) { return geometry.lattice; }

  /// Decodes a patch. Normals have unit length.
  virtual IndexedPatch decode(const PatchDescription& patch, const GeometryDescription& geometry) = 0;

  /// Decodes the base mesh of a geometry that has one; called only for encodings with Capabilities::base.
  virtual BaseMesh decodeBase(const GeometryDescription& geometry);

  /// The precision of stored attributes.
  virtual StoredPrecision precisionOf(const GeometryDescription& geometry) = 0;
};

/// A reader of an encoding whose patches are decoded one at a time, and whose nodes state the precision of attributes.
class SinglePatchReader final : public PatchReader {
public:
  using Decode = IndexedPatch(const PatchDescription&, const GeometryDescription&, const FetchFile&);

  using FindLattice = Lattice(const GeometryDescription&, const FetchFile&);

  SinglePatchReader(FetchFile fetch, Decode& decode, FindLattice* findLattice = nullptr)
      : fetch_(std::move(fetch)), decode_(decode), findLattice_(findLattice) {}
  Lattice latticeOf(const GeometryDescription& geometry) override {
    return findLattice_ ? findLattice_(geometry, fetch_) : geometry.lattice;
  }
  IndexedPatch decode(const PatchDescription& patch, const GeometryDescription& geometry) override;
  StoredPrecision precisionOf(const GeometryDescription& geometry) override;

private:
  FetchFile fetch_;
  Decode& decode_;
  FindLattice* findLattice_;
};

} // namespace imgeo
