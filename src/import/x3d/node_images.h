#pragma once
// Reads the images that the URLs of texture and background nodes name.

#include "import/references.h"
#include "scene/scene.h"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace imgeo::x3d {

/// Whether a URL is one of another host.
bool isRemote(const std::string& url);

class NodeImages {
public:
  /// Images are added to `images`.
  NodeImages(const References& references, std::vector<ImageFile>& images) : references_(references), images_(images) {}

  /// The index of the image of the first URL that can be read and decoded, or of the last if it can be read; empty
  /// where none can and other hosts may have it. Throws the joined Errors of all where none can and all URLs are local.
  std::optional<std::size_t> read(const std::vector<std::string>& urls);

private:
  std::size_t imageOf(const std::string& url);

  const References& references_;
  std::vector<ImageFile>& images_;
  std::map<std::string, std::size_t> read_; ///< by URL
  std::set<std::string> whole_;             ///< URLs of images that can be decoded
};

/// Keeps, of fields for images without an image, only the URLs of other hosts: pages request the first URL, and the
/// local ones name no readable file. Returns the number of fields with URLs of other hosts.
std::size_t keepRemoteImageUrls(const GenericNode& node, std::vector<FieldText>& fields);

} // namespace imgeo::x3d
