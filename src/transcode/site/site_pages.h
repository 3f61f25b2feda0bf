#pragma once
// The documents of a site: page, scene, stylesheet, inlined documents; and the runtime that the page loads.

#include "containers/container_reader.h"
#include "documents/documents.h"
#include "transcode/site/runtime.h"
#include "transcode/site/x3dom_release.h"

#include <filesystem>

namespace imgeo {

/// Writes the documents that the scene inlines, named by their content, and sets their urls in the graph.
void writeInlinedDocuments(SceneDocument& document, Target target, const std::filesystem::path& site);

/// Writes the page, the scene and the stylesheet of a site for X3DOM. The page loads X3DOM instead of our runtime.
void writeX3domPages(const SceneDocument& document, const X3domRelease& release, const PagePictures& pictures,
                     const std::filesystem::path& site);

/// Writes the runtime's files into the folder `runtimeFolder` of a site.
Runtime writeRuntime(const std::filesystem::path& site);

/// Writes the page, the scene and the stylesheet of a site for our runtime, and the runtime's files.
void writePages(const SceneDocument& document, const PagePictures& pictures, const std::filesystem::path& site);

} // namespace imgeo
