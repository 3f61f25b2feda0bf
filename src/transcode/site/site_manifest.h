#pragma once
// imgeo.json: marks a directory as an imgeo site, and states those settings of the conversion that verify needs and
// that do not follow from the document.

#include "imgeo/convert.h"
#include "imgeo/source_axes.h"
#include "prepare/normals.h"
#include "prepare/weld.h"
#include "transcode/site/site_document.h"

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace imgeo {

struct SiteManifest {
  std::string generator; ///< "imgeo 0.1.0"
  std::string source;    ///< file name of the input; empty for standard input
  Encoding encoding = Encoding::classic;
  Primitives primitives = Primitives::triangles;
  bool normalsComputed = false;
  NormalWeighting normalWeighting = NormalWeighting::area; ///< where normals were computed
  std::optional<double> creaseDegrees{};                   ///< as in ConvertOptions
  /// Creases are as this version has them: where nothing states them, the shape decides, and triangles of glTF are
  /// flat. False in sites of earlier versions, whose edges are smooth there.
  bool guessesCreases = false;
  bool flatWithoutNormals = false; ///< as in PreparationOptions; false in sites of earlier versions
  ElementCounts elements;          ///< as drawn; for strips they do not follow from vertex counts
  /// Maximum error of normals, for palettes and compact; 0: see normalErrorBound.
  double normalErrorDegrees = 0;
  SourceAxes axes;         ///< the Transform at the top of the document
  DroppedElements dropped; ///< elements of the source that were dropped
  /// Bits of colours that were asked for. With at most 8, colours were rounded to 8 bits before they were encoded.
  std::uint32_t colorBits = 8;
  /// Names of the further attributes that were kept, and with them of sets of texture coordinates that no texture uses.
  std::vector<std::string> attributes;
  double sequenceRate = 0;         ///< frames a second to which animations of vertices were recorded; 0: they were not
  bool onlyLongSequences = false;  ///< only interpolators with long texts were recorded
  bool onlyFirstTexCoords = false; ///< further sets of texture coordinates were left out, with their textures
  /// Shapes show the meshes of others, moved and turned, whose vertices are at most so far from those of the source.
  std::optional<double> instanceDistance;
  std::uint64_t sourceTextureBytes = 0; ///< size of the source's texture images
  /// Content names (base/file.h) of the page's icon and picture, by file name. Nothing: the site is of a
  /// version that did not state them.
  std::optional<std::map<std::string, std::string>> pictures;
};

std::string writeManifest(const SiteManifest& manifest);

/// The imgeo.json of a site, or in its folder; nothing if another program wrote the site. Throws Error.
std::optional<SiteManifest> manifestOf(const SiteDocument& document);
std::optional<SiteManifest> manifestIn(const std::filesystem::path& root);

/// Safe for untrusted text. Throws Error{malformed}; `name` is its location.
SiteManifest readManifest(std::string_view text, const std::string& name);

} // namespace imgeo
