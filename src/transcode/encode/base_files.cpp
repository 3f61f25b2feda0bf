#include "transcode/encode/base_files.h"

#include "containers/compact/base.h"

namespace imgeo {

void BaseFiles::add(compact::CompactPatch base, std::size_t geometryIndex) {
  if (!contents_.fits(base, compact::maxPatchCount))
    writeContents();
  contents_.add(std::move(base));
  geometryIndices_.push_back(geometryIndex);
}

void BaseFiles::finish(std::vector<GeometryDescription>& geometries) {
  writeContents();
  for (auto& [geometry, reference] : references_)
    geometries[geometry].base = std::move(reference);
}

void BaseFiles::writeContents() {
  const FileContents contents = std::exchange(contents_, {});
  if (contents.patches().empty())
    return;
  const EncodedFile file = baseFile(contents.patches());
  const std::string url = files_.write(file.bytes, file.extension);
  for (std::size_t number = 0; number < geometryIndices_.size(); ++number)
    references_.push_back({geometryIndices_[number], {url, PatchLocation{static_cast<std::uint32_t>(number)}}});
  geometryIndices_.clear();
}

} // namespace imgeo
