#include "import/x3d/node_images.h"

#include "base/data_url.h"
#include "base/first_readable.h"
#include "images/decode_image.h"
#include "images/image_type.h"
#include "import/source_images.h"
#include "scene/mf_string.h"

#include <algorithm>

namespace imgeo::x3d {

bool isRemote(const std::string& url) {
  return url.starts_with("http:") || url.starts_with("https:");
}

std::size_t NodeImages::imageOf(const std::string& url) {
  if (const auto found = read_.find(url); found != read_.end())
    return found->second;
  ImageFile file{isDataUrl(url) ? "" : url, references_.fetch(url)};
  requireImage(file.bytes, url);
  images_.push_back(std::move(file));
  return read_[url] = images_.size() - 1;
}

std::optional<std::size_t> NodeImages::read(const std::vector<std::string>& urls) {
  std::vector<Error> errors;
  for (const std::string& url : urls) {
    if (isRemote(url))
      continue;
    try {
      if (&url != &urls.back() && !whole_.contains(url)) { // a browser goes on to the next URL where one is damaged
        const Bytes bytes = references_.fetch(url);
        requireImage(bytes, url);
        if (isDecodable(imageType(bytes)))
          decodeRaster(bytes, url);
        whole_.insert(url);
      }
      return imageOf(url);
    } catch (const Error& error) {
      errors.push_back(error);
    }
  }
  if (!errors.empty() && std::ranges::none_of(urls, isRemote))
    throw joined(errors);
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
