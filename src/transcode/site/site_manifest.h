#pragma once
// `imgeo.json`: marks a directory as one of our sites and says what of its making
// cannot be read from the document.

#include "imgeo/convert.h"
#include "prepare/normals.h"
#include "prepare/weld.h"

#include <string>
#include <string_view>

namespace imgeo {

struct SiteManifest {
  std::string generator; ///< "imgeo 0.1.0"
  std::string source;    ///< the input's file name
  Encoding encoding = Encoding::classic;
  Primitives primitives = Primitives::triangles;
  bool normalsComputed = false;
  NormalWeighting normalWeighting = NormalWeighting::area; ///< where normals were computed
  ElementCounts elements;                                  ///< as drawn; a strip's length does not tell
  /// By which normals of a palette and of compact may be off; 0: see normalErrorBound.
  double normalErrorDegrees = 0;
  DroppedElements dropped;              ///< elements of the source that were left out
  std::vector<std::string> attributes;  ///< further ones that were kept
  std::uint64_t sourceTextureBytes = 0; ///< of the images of textures, as they were found
};

std::string writeManifest(const SiteManifest& manifest);

/// Safe for untrusted text. Throws Error{malformed} naming `name`.
SiteManifest readManifest(std::string_view text, const std::string& name);

} // namespace imgeo
