#include "containers/choose_urls.h"

#include "base/first_readable.h"
#include "containers/encodings.h"
#include "containers/image_file.h"

#include <utility>

namespace imgeo {

std::vector<Error> chooseUrls(GeometryDescription& geometry, const FetchFile& fetch) {
  const bool holdsImages = rowOf(geometry).storage == PatchStorage::bytePlanes;
  std::vector<Error> errors;
  for (PatchDescription& patch : geometry.patches)
    visitReferences(patch, [&](Role, Reference& reference) {
      if (reference.furtherUrls.empty())
        return;
      std::vector<std::string> urls = std::exchange(reference.furtherUrls, {});
      urls.insert(urls.begin(), reference.url);
      try {
        reference.url = firstReadable(urls, [&](const std::string& url) {
          const Bytes bytes = fetch(url);
          if (holdsImages)
            decodeImageFile(bytes, url);
          return url;
        });
      } catch (const Error& error) {
        errors.push_back(error);
      }
    });
  return errors;
}

} // namespace imgeo
