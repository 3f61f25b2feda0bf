#pragma once
// The pictures of a site's page: its icon, and the picture that previews of links show.

#include "documents/documents.h"
#include "transcode/picture/picture_samples.h"

#include <filesystem>

namespace imgeo {

/// Writes the icon, and the picture unless a part of the scene would be missing in it. `graph` has the viewpoint and
/// the background. Returns the pictures' urls, relative to the page.
PagePictures writePictures(const SceneGraph& graph, const PictureSamples& samples, const std::filesystem::path& site);

} // namespace imgeo
