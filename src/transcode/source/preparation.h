#pragma once
// Imports and prepares the input of convert and verify, which share these steps so that both get the same meshes.

#include "imgeo/convert.h"
#include "import/import.h"
#include "prepare/normals.h"
#include "prepare/weld.h"
#include "scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace imgeo {

/// Maximum length of geometry text that stays in an X3D document, see ImportOptions. A compromise between hosts that
/// compress documents and hosts that do not: docs/decisions/scenes.md has the measurements.
inline constexpr std::size_t inlineBytes = 1024;

/// Interpolators of the coordinates of X3D documents with a longer text in keyValue become sequences, see
/// RecordingChoice.
inline constexpr std::size_t longKeyValueBytes = 64 << 10;

/// Imports a file, or standard input for "-", and sets `bytes` to its size.
Imported importInput(const std::filesystem::path& input, const ImportOptions& options, std::uint64_t& bytes);

/// Name of the input in messages: the path, or "standard input".
std::string locationOf(const std::filesystem::path& input);

struct PreparationOptions {
  DroppedElements dropped{};
  NormalWeighting weighting = NormalWeighting::area;
  /// Leave meshes whose crease angle is 0 without normals: viewers draw their triangles flat.
  bool flatWithoutNormals = true;
  bool byteColors = true; ///< round colours to 8 bits, so that vertices whose colours differ by less are welded
};

/// How convert prepares meshes. X3DOM lights no triangles without normals, and surfaces that are sampled have other
/// triangles than their source.
PreparationOptions preparationFor(const ConvertOptions& options);

struct PreparationReport {
  WeldReport weld;              ///< summed over the meshes
  bool normalsComputed = false; ///< computed for at least one mesh
  EdgeReport edges;
  double colorError = 0; ///< the most by which rounding has changed a colour's channel, 0 .. 1
  std::vector<std::string> warnings;
};

/// Rounds colours, welds every mesh, drops the stated elements and unreferenced positions, computes normals for
/// triangle meshes without normals, with the creases that they state or guessCreases() finds, and removes shapes
/// without elements. Throws Error{malformed} with the location `location` if no shape is left, unless the scene is
/// complete (an X3D source).
PreparationReport prepareScene(Scene& scene, const PreparationOptions& options, const std::string& location);

/// The crease angle of meshes of which nothing states it, by isManMade() of sharp_edges.h, with the guess in `guessed`.
double guessCreases(bool isManMade, EdgeReport& guessed);

/// Meshes and textures of which something was left out.
struct LeftOutTexCoords {
  std::size_t meshes = 0, textures = 0;
};

/// Removes all sets of texture coordinates but the first, and the textures that use them, for programs that read one
/// set.
LeftOutTexCoords keepFirstTexCoords(Scene& scene);

/// Rounds colours to 8 bits a channel. Returns the largest change of a channel.
double roundColors(Mesh& mesh);

} // namespace imgeo
