#include "transcode/encode/patch_files.h"

#include "base/parallel.h"

#include <algorithm>
#include <utility>

namespace imgeo {

namespace {

/// Number of full files that wait to be encoded together. Their patches are in memory until then.
constexpr std::size_t maxClosedFiles = 64;

} // namespace

void PatchFiles::add(std::unique_ptr<PreparedPatch> patch, std::size_t geometryIndex, std::size_t group) {
  File& file = open_[group];
  if (file.contents && !file.contents->hasRoomFor(*patch, sharing_->maxFileVertices)) {
    closed_.push_back(std::exchange(file, {}));
    if (closed_.size() == maxClosedFiles)
      encodeClosed();
  }
  if (!file.contents)
    file.contents = sharing_->makeFile();
  file.contents->add(std::move(patch));
  file.geometryIndices.push_back(geometryIndex);
}

void PatchFiles::close(std::size_t group) {
  const auto file = open_.find(group);
  if (file == open_.end())
    return;
  closed_.push_back(std::move(file->second));
  open_.erase(file);
  if (closed_.size() == maxClosedFiles)
    encodeClosed();
}

double PatchFiles::finish(std::vector<GeometryDescription>& geometries) {
  for (auto& [group, file] : open_)
    closed_.push_back(std::move(file));
  encodeClosed();
  double normalError = 0;
  for (WrittenPatch& written : written_) {
    geometries[written.geometryIndex].patches[0].data = std::move(written.data);
    normalError = std::max(normalError, written.normalError);
  }
  return normalError;
}

void PatchFiles::encodeClosed() {
  std::vector<std::vector<WrittenPatch>> written(closed_.size());
  parallelFor(closed_.size(), [&](std::size_t i) {
    const File file = std::exchange(closed_[i], {});
    const EncodedSharedFile encoded = file.contents->encode(effort_);
    const std::string url = files_.write(encoded.file.bytes, encoded.file.extension);
    for (std::size_t number = 0; number < file.geometryIndices.size(); ++number)
      written[i].push_back({file.geometryIndices[number],
                            {url, PatchLocation{static_cast<std::uint32_t>(number)}},
                            encoded.normalErrors[number]});
  });
  for (std::vector<WrittenPatch>& ofFile : written)
    std::ranges::move(ofFile, std::back_inserter(written_));
  closed_.clear();
}

} // namespace imgeo
