#pragma once
// Opens the document of a site with the geometry that stays in nodes of it.

#include "transcode/site/site_document.h"

#include <filesystem>

namespace imgeo {

/// Opens a site as openDocument() does. Geometry nodes of its documents that importers can make meshes of are
/// geometries of the scene too: prepared as convert() prepared the meshes of the site, in Float32, in data: URLs.
/// `geometryElements` has those that cannot be read, such as a Text; the scene's warnings say why, where it is a fault.
SiteDocument openWholeDocument(const std::filesystem::path& site);

} // namespace imgeo
