#include "import/x3d/node_images.h"

#include "base/data_url.h"
#include "base/error.h"
#include "import/source_images.h"
#include "scene/mf_string.h"

#include <algorithm>

namespace imgeo::x3d {

bool isRemote(const std::string& url) {
  return url.starts_with("http:") || url.starts_with("https:");
}

std::optional<std::size_t> NodeImages::read(const std::vector<std::string>& urls) {
  const bool mayBeRemote = std::ranges::any_of(urls, isRemote);
  for (std::size_t i = 0; i < urls.size(); ++i) {
    if (const auto found = read_.find(urls[i]); found != read_.end())
      return found->second;
    if (isRemote(urls[i]))
      continue;
    try {
      ImageFile file{isDataUrl(urls[i]) ? "" : urls[i], references_.fetch(urls[i])};
      requireImage(file.bytes, urls[i]);
      images_.push_back(std::move(file));
      return read_[urls[i]] = images_.size() - 1;
    } catch (const Error&) {
      if (i + 1 == urls.size() && !mayBeRemote)
        throw;
    }
  }
  return {};
}

std::size_t keepRemoteImageUrls(const GenericNode& node, std::vector<FieldText>& fields) {
  std::size_t remote = 0;
  for (const std::string_view name : imageFieldsOf(node.element)) {
    const auto field = std::ranges::find(fields, name, &FieldText::name);
    if (field == fields.end() || std::ranges::find(node.images, name, &FieldImage::field) != node.images.end())
      continue;
    std::vector<std::string> urls = parseStrings(field->value);
    std::erase_if(urls, [](const std::string& each) { return !isRemote(each); });
    if (urls.empty())
      continue;
    ++remote;
    field->value = quoteStrings(urls);
  }
  return remote;
}

} // namespace imgeo::x3d
