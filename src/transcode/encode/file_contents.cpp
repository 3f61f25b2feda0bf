#include "transcode/encode/file_contents.h"

#include "containers/compact/header.h"

#include <algorithm>
#include <utility>

namespace imgeo {

namespace {

/// A header can store this many kinds, even if each has the maximum number of attributes.
constexpr std::size_t maxKinds = compact::maxFileAttributes / compact::maxAttributes;

} // namespace

FileContents::Kind FileContents::kindOf(const compact::CompactPatch& patch) {
  Kind kind{patch.topology, patch.positionBits, {}};
  for (const compact::Attribute& attribute : patch.attributes)
    kind.attributes.push_back(attribute.type);
  return kind;
}

bool FileContents::fits(const compact::CompactPatch& patch, std::size_t maxWedges) const {
  if (patches_.empty())
    return true;
  const bool isKnown = std::ranges::find(kinds_, kindOf(patch)) != kinds_.end();
  return patches_.size() < compact::maxFilePatches && (isKnown || kinds_.size() < maxKinds) &&
         wedges_ + patch.wedgeCount() <= maxWedges && elements_ + patch.elementCount() <= compact::maxPatchCount;
}

void FileContents::add(compact::CompactPatch patch) {
  if (Kind kind = kindOf(patch); std::ranges::find(kinds_, kind) == kinds_.end())
    kinds_.push_back(std::move(kind));
  wedges_ += patch.wedgeCount();
  elements_ += patch.elementCount();
  patches_.push_back(std::move(patch));
}

} // namespace imgeo
