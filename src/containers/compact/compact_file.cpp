#include "containers/compact/base.h"
#include "containers/compact/compact.h"
#include "containers/compact/header.h"
#include "containers/shared_file.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace imgeo {

namespace {

/// A header has room for so many kinds of patches even if each has as many attributes as a patch may have.
constexpr std::size_t maxPatchKinds = compact::maxFileAttributes / compact::maxAttributes;

class PreparedCompactPatch final : public PreparedPatch {
public:
  explicit PreparedCompactPatch(compact::CompactPatch patch) : patch_(std::move(patch)) {}
  std::size_t elementCount() const override { return patch_.elementCount(); }
  PatchDescription describe(const GeometryDescription& geometry) const override {
    return imgeo::describe(patch_, geometry);
  }
  const compact::CompactPatch& patch() const { return patch_; }
  compact::CompactPatch take() { return std::move(patch_); }

private:
  compact::CompactPatch patch_;
};

/// What a header states once for all patches that have it in common.
struct PatchKind {
  Topology topology = Topology::triangles;
  std::uint32_t positionBits = 16;
  std::vector<compact::AttributeType> attributes;
  friend bool operator==(const PatchKind&, const PatchKind&) = default;
};

PatchKind kindOf(const compact::CompactPatch& patch) {
  PatchKind kind{patch.topology, patch.positionBits, {}};
  for (const compact::Attribute& attribute : patch.attributes)
    kind.attributes.push_back(attribute.type);
  return kind;
}

class CompactFile final : public SharedFile {
public:
  std::size_t patchCount() const override { return patches_.size(); }

  bool hasRoomFor(const PreparedPatch& prepared, std::size_t maxVertices) const override {
    if (patches_.empty())
      return true;
    const compact::CompactPatch& patch = static_cast<const PreparedCompactPatch&>(prepared).patch();
    const bool isKnown = std::ranges::find(kinds_, kindOf(patch)) != kinds_.end();
    return patches_.size() < compact::maxFilePatches && (isKnown || kinds_.size() < maxPatchKinds) &&
           wedgeCount_ + patch.wedgeCount() <= maxVertices && elementCount_ + patch.elementCount() <= compact::maxCount;
  }

  void add(std::unique_ptr<PreparedPatch> prepared) override {
    compact::CompactPatch patch = static_cast<PreparedCompactPatch&>(*prepared).take();
    if (PatchKind kind = kindOf(patch); std::ranges::find(kinds_, kind) == kinds_.end())
      kinds_.push_back(std::move(kind));
    wedgeCount_ += patch.wedgeCount();
    elementCount_ += patch.elementCount();
    patches_.push_back(std::move(patch));
  }

  EncodedSharedFile encode(int effort) const override { return encodeCompact(patches_, effort); }
  EncodedFile encodeBases() const override { return baseFile(patches_); }

private:
  std::vector<compact::CompactPatch> patches_;
  std::vector<PatchKind> kinds_;
  std::size_t wedgeCount_ = 0, elementCount_ = 0;
};

std::unique_ptr<PreparedPatch> prepareCompact(Patch patch, const GeometryDescription& geometry,
                                              const EncodeOptions& options) {
  if (options.primitives == Primitives::points)
    patch.topology = Topology::points;
  return std::make_unique<PreparedCompactPatch>(quantisePatch(std::move(patch), geometry, options));
}

std::unique_ptr<PreparedPatch> prepareCompactBase(const BaseMesh& base, const GeometryDescription& geometry,
                                                  const EncodeOptions& options) {
  return std::make_unique<PreparedCompactPatch>(quantiseBase(base, geometry, options.texCoordBits, options.colorBits));
}

std::unique_ptr<SharedFile> makeCompactFile() {
  return std::make_unique<CompactFile>();
}

} // namespace

constinit const FileSharing compactSharing{
    .prepare = prepareCompact,
    .prepareBase = prepareCompactBase,
    .makeFile = makeCompactFile,
    .maxFileVertices = 16384, // docs/decisions/compact.md has the measurement
    .maxBaseVertices = compact::maxCount,
};

} // namespace imgeo
