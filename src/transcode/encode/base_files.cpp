#include "transcode/encode/base_files.h"

#include <utility>

namespace imgeo {

void BaseFiles::add(std::unique_ptr<PreparedPatch> base, std::size_t geometryIndex) {
  if (file_ && !file_->hasRoomFor(*base, sharing_->maxBaseVertices))
    writeContents();
  if (!file_)
    file_ = sharing_->makeFile();
  file_->add(std::move(base));
  geometryIndices_.push_back(geometryIndex);
}

void BaseFiles::finish(std::vector<GeometryDescription>& geometries) {
  writeContents();
  for (auto& [geometry, reference] : references_)
    geometries[geometry].base = std::move(reference);
}

void BaseFiles::writeContents() {
  if (!file_)
    return;
  const EncodedFile file = std::exchange(file_, nullptr)->encodeBases();
  const std::string url = files_.write(file.bytes, file.extension);
  for (std::size_t number = 0; number < geometryIndices_.size(); ++number)
    references_.push_back({geometryIndices_[number], {url, PatchLocation{static_cast<std::uint32_t>(number)}}});
  geometryIndices_.clear();
}

} // namespace imgeo
