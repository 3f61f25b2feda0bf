#pragma once
// Reads the bytes of a file into a Scene. One folder per input format, whose header NAME/NAME.h says what is read of
// it; format.h is the table of the formats. Other folders include this header, the table and warnings.h.
//
// All formats: polygons are cut into triangles; normals are brought to unit length, and (0, 0, 1) replaces those
// without a direction; everything that is not carried over is named in a warning. Limits: 2^32 - 1 vertices and
// corners; gzipped files: archive/gzip.h.

#include "base/bytes.h"
#include "imgeo/preparation.h"
#include "imgeo/source_axes.h"
#include "scene/scene.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace imgeo {

struct Imported {
  Scene scene;                          ///< meshes may have no normals: prepare/normals computes them
  std::vector<std::string> attributes;  ///< names of all further vertex attributes of the source, kept or not
  std::string format;                   ///< "PLY", "OBJ", "GLB" ...: for reports
  std::vector<std::string> warnings;    ///< one sentence per kind of content that is not carried over
  std::optional<AxisDirection> up = {}; ///< the direction that points up, where the format or the file says it
  std::optional<double> metres = {};    ///< length of a unit, where the format or the file says it
  Vec3d origin{0, 0, 0};                ///< what has been subtracted from the coordinates of the source
};

/// Which animations of vertices of an X3D document become meshes whose interpolator is a child of the Shape
/// (Interpolator::points), instead of staying text.
struct RecordingChoice {
  /// Interpolators with more bytes of keyValue, if there are at most three frames for each key.
  std::size_t minBytes = std::string::npos;
  double rate = 30;   ///< frames per second, above 0
  bool all = false;   ///< all interpolators
  bool files = false; ///< sequences that a document refers to: they become Interpolators with the paths of their files
};

struct ImportOptions {
  AttributeChoice attributes;     ///< by default none
  std::filesystem::path folder{}; ///< relative URLs are resolved against it; empty: they are refused
  bool outside = false;           ///< whether URLs may lead out of `within`
  /// Geometry of an X3D document stays in the document where its text is at most this long. Where the document has more
  /// than 64 KiB of such text, only geometry of at most 256 bytes stays.
  std::size_t inlineBytes = 0;
  /// Whether a Box, a Sphere and other nodes that state sizes and no vertices become meshes, as pages draw them.
  bool solids = false;
  RecordingChoice recordings{}; ///< by default none
  /// What is subtracted from the coordinates of PLY, OBJ and STL; by default farOriginOf() the first vertex where the
  /// file has more digits than single precision, and 0 in binary files of single precision.
  std::optional<Vec3d> origin{};
  /// Mesh::creaseDegrees of all meshes; default: as the format has it.
  std::optional<double> creaseDegrees{};
  /// Whether meshes are smooth of which the format states no creases, or has flat triangles, as in sites of earlier
  /// versions.
  bool smoothsUnstated = false;
  bool strict = false;            ///< whether damage is an Error even where the rest could be read
  std::filesystem::path within{}; ///< the folder that URLs may not lead out of; empty: `folder`
  /// The chain of files whose Inlines led to this one, outermost first. Detects a document that inlines itself.
  std::vector<std::filesystem::path> inlinedBy{};
};

/// Reads a file of any known format (format.h tells which). A gzipped file (magic 1f 8b) is unpacked first. Safe for
/// untrusted bytes: counts are checked against the remaining bytes before anything is allocated; NaN and infinite
/// coordinates are refused. Throws Error (io, truncated, malformed, unsupported, limit) with file and line (text) or
/// byte (binary).
Imported importFile(const std::filesystem::path& path, const ImportOptions& options = {});

/// Reads the bytes of a file. Relative URLs are resolved against options.folder; `name` stands for the file in
/// messages, and its extension helps to tell the format.
Imported importBytes(ByteSpan bytes, const std::string& name, const ImportOptions& options = {});

} // namespace imgeo
