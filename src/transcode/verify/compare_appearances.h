#pragma once
// Whether shapes of a site look as those of its input: their materials, and where
// textures lie on them. What pictures show is not compared.

#include "scene/scene.h"

#include <set>
#include <string>

namespace imgeo {

/// Appearances that the source has as plain data; those of an X3D source go into the
/// document as they are. A material may have become the Material that looks most
/// like it, for X3DOM; a texture whose file was of no use is missing on purpose.
bool haveEqualAppearances(const SceneGraph& siteGraph, const Shape& inSite, const SceneGraph& inputGraph,
                          const Shape& inInput);

/// The urls of textures that were not there for an X3D input either, so that convert
/// left them as they were.
std::set<std::string> texturesLeftIn(const SceneGraph& input);

} // namespace imgeo
