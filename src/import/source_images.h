#pragma once
// The image files that materials refer to.

#include "scene/scene.h"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace imgeo {

/// Throws Error{unsupported} at `location` for bytes that are no image of a type that browsers show or imgeo decodes.
void requireImage(ByteSpan bytes, const std::string& location);

/// Adds images to a scene graph, each once.
class SourceImages {
public:
  explicit SourceImages(SceneGraph& graph) : graph_(graph) {}

  /// Index of the image that the source calls `name`; calls `read` for the first request of a name. Where `read` throws
  /// an Error or its bytes are no image (an Error at `location`), returns empty and adds a warning to `omissions`.
  std::optional<std::size_t> index(const std::string& name, const std::string& location,
                                   const std::function<ImageFile()>& read);

  std::vector<std::string> omissions; ///< one warning for each image that is left out

private:
  SceneGraph& graph_;
  std::map<std::string, std::optional<std::size_t>> indices_;
};

} // namespace imgeo
