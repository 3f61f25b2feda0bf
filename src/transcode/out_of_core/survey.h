#pragma once
// The first pass over a source that is read in pieces: its box, attributes, warnings, and the triangles or points by
// which regions are chosen.

#include "import/chunks/chunked_source.h"
#include "prepare/sharp_edges.h"
#include "transcode/out_of_core/element_records.h"
#include "transcode/out_of_core/work_folder.h"

#include "imgeo/convert.h"

#include <optional>
#include <string>
#include <vector>

namespace imgeo {

/// What is known of a source, or of a piece of it.
struct Survey {
  std::uint64_t elements = 0; ///< triangles or points
  Box3d box;
  RecordLayout layout;
  std::vector<float> low, high; ///< by number of a corner's attributes: the least and the largest
  double colorError = 0;        ///< by rounding colours
  std::vector<std::string> warnings, attributes;
  std::string format, meshName;
  std::optional<AxisDirection> up;
  std::vector<Vec3f> sample;                                 ///< corners of the sampled elements
  std::optional<double> statedCreaseDegrees = smoothDegrees; ///< Mesh::creaseDegrees
  std::vector<CornerTriangle> cornerTriangles;               ///< sampledCorners(), where creases are not stated

  /// Adds a piece that follows.
  void add(Survey&& next);
  /// Whether normals are computed for its triangles: it has none, and they are not flat without, as PreparationOptions
  /// have it.
  bool lacksNormals(bool flatWithoutNormals) const;
  /// The crease angle of the mesh, with the guess, if it is one, in `guessed`.
  double creaseDegrees(EdgeReport& guessed) const;
};

/// Reads a piece: a mesh of triangles or points, colours rounded as in meshes that are read whole.
Imported readPiece(const ChunkedMesh& source, std::size_t chunk, const ImportOptions& importOptions,
                   const ConvertOptions& options, double* colorError = nullptr);

Survey surveyPiece(const ChunkedMesh& source, std::size_t chunk, const ImportOptions& importOptions,
                   const ConvertOptions& options);

Bytes writeSurvey(const Survey& survey);
Survey readSurvey(ByteSpan bytes, const std::string& path);

/// A mesh of two vertices that have the least and the largest of all values.
Mesh extremesOf(const Survey& survey);

} // namespace imgeo
