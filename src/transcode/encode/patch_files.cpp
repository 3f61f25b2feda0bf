#include "transcode/encode/patch_files.h"

#include "base/parallel.h"
#include "containers/compact/header.h"

#include <algorithm>
#include <utility>

namespace imgeo {

namespace {

/// So many files are encoded at a time: their patches are in memory until then.
constexpr std::size_t filesAtOnce = 64;

/// With as many attributes each as a patch may have, a header still holds them.
constexpr std::size_t mostKinds = compact::maxFileAttributes / compact::maxAttributes;

} // namespace

FileContents::Kind FileContents::kindOf(const compact::CompactPatch& patch) {
  Kind kind{patch.topology, patch.positionBits, {}};
  for (const compact::Attribute& attribute : patch.attributes)
    kind.attributes.push_back(attribute.type);
  return kind;
}

bool FileContents::fits(const compact::CompactPatch& patch, std::size_t mostVertices) const {
  if (patches_.empty())
    return true;
  const bool isKnown = std::ranges::find(kinds_, kindOf(patch)) != kinds_.end();
  return patches_.size() < compact::maxFilePatches && (isKnown || kinds_.size() < mostKinds) &&
         wedges_ + patch.wedgeCount() <= mostVertices && elements_ + patch.elementCount() <= compact::maxPatchCount;
}

void FileContents::add(compact::CompactPatch patch) {
  if (Kind kind = kindOf(patch); std::ranges::find(kinds_, kind) == kinds_.end())
    kinds_.push_back(std::move(kind));
  wedges_ += patch.wedgeCount();
  elements_ += patch.elementCount();
  patches_.push_back(std::move(patch));
}

void PatchFiles::add(compact::CompactPatch patch, std::size_t geometry, std::size_t group) {
  File& file = open_[group];
  if (!file.contents.fits(patch, sharedFileVertices)) {
    closed_.push_back(std::exchange(file, {}));
    if (closed_.size() == filesAtOnce)
      encodeClosed();
  }
  file.contents.add(std::move(patch));
  file.geometries.push_back(geometry);
}

std::vector<PatchFiles::Placed> PatchFiles::finish() {
  for (auto& [group, file] : open_)
    closed_.push_back(std::move(file));
  encodeClosed();
  return std::move(placed_);
}

void PatchFiles::encodeClosed() {
  std::vector<std::vector<Placed>> placed(closed_.size());
  parallelFor(closed_.size(), [&](std::size_t i) {
    const File file = std::exchange(closed_[i], {});
    const EncodedCompact encoded = encodeCompact(file.contents.patches(), effort_);
    const std::string url = files_.write(encoded.file.bytes, encoded.file.extension);
    for (std::size_t number = 0; number < file.geometries.size(); ++number)
      placed[i].push_back({file.geometries[number],
                           {url, PatchLocation{static_cast<std::uint32_t>(number)}},
                           encoded.normalErrors[number]});
  });
  for (std::vector<Placed>& ofFile : placed)
    std::ranges::move(ofFile, std::back_inserter(placed_));
  closed_.clear();
}

} // namespace imgeo
