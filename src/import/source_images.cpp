#include "import/source_images.h"

#include "base/error.h"
#include "images/image_type.h"

#include <fmt/format.h>

namespace imgeo {

void requireImage(ByteSpan bytes, const std::string& location) {
  if (imageType(bytes).empty())
    throw Error(ErrorKind::unsupported, location, "is an image of a kind that browsers do not show");
}

std::optional<std::size_t> SourceImages::index(const std::string& name, const std::string& location,
                                               const std::function<ImageFile()>& read) {
  const auto [found, isNew] = indices_.try_emplace(name);
  if (!isNew)
    return found->second;
  try {
    ImageFile image = read();
    requireImage(image.bytes, location);
    graph_.images.push_back(std::move(image));
    found->second = graph_.images.size() - 1;
  } catch (const Error& error) {
    omissions.push_back(fmt::format("A texture is left out: {}.", error.what()));
  }
  return found->second;
}

} // namespace imgeo
