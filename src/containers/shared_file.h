#pragma once
// Files that patches or base meshes of several geometries share.

#include "containers/patch_encoder.h"
#include "prepare/base_mesh.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace imgeo {

/// A patch or a base mesh in the form that its encoding writes.
class PreparedPatch {
public:
  virtual ~PreparedPatch() = default;
  virtual std::size_t elementCount() const = 0;
  /// The description of the patch in documents, without its reference.
  virtual PatchDescription describe(const GeometryDescription& geometry) const = 0;
};

struct EncodedSharedFile {
  EncodedFile file;
  std::vector<double> normalErrors; ///< per patch; see EncodedPatch::normalError
};

/// Collects patches, or base meshes, for one file. PatchLocation::patchIndex counts them in the order of add().
class SharedFile {
public:
  virtual ~SharedFile() = default;
  virtual std::size_t patchCount() const = 0;
  /// Whether the file has room for one more patch and then at most `maxVertices` vertices (wedges). An empty file has
  /// room for every patch.
  virtual bool hasRoomFor(const PreparedPatch& patch, std::size_t maxVertices) const = 0;
  virtual void add(std::unique_ptr<PreparedPatch> patch) = 0;
  /// Encodes the patches. Deterministic. Throws Error{limit} for more than an image holds.
  virtual EncodedSharedFile encode(int effort) const = 0;
  /// Encodes the base meshes in the same way.
  virtual EncodedFile encodeBases() const = 0;
};

/// How an encoding writes shared files.
struct FileSharing {
  std::unique_ptr<PreparedPatch> (*prepare)(Patch patch, const GeometryDescription& geometry,
                                            const EncodeOptions& options);
  std::unique_ptr<PreparedPatch> (*prepareBase)(const BaseMesh& base, const GeometryDescription& geometry,
                                                const EncodeOptions& options);
  std::unique_ptr<SharedFile> (*makeFile)();
  std::size_t maxFileVertices; ///< vertices (wedges) of a patch that shares its file, and of all patches of the file
  std::size_t maxBaseVertices; ///< vertices (wedges) of all base meshes of a file
};

} // namespace imgeo
