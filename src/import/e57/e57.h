#pragma once
// E57 point clouds (ASTM E2807): every scan with its pose, from Cartesian or spherical coordinates, with its colours;
// intensity, classification, row, column, return, time stamp and all other fields of numbers as further attributes. A
// file's scans are shapes of one scene. Points that are marked as invalid are left out. Coordinates far from zero are
// stored around an origin, which the document's metadata state (MetadataSet "georeference"), with the reference system.
// Pictures and texts of points are not read.

#include "import/e57/packets.h"
#include "import/import.h"

#include <optional>
#include <span>
#include <string>

namespace imgeo {

namespace e57 {

/// What the points of a file have in common, all of which are read in pieces.
struct PointSurvey {
  Box3d box{};                        ///< of the valid points, with the poses applied
  std::uint64_t points = 0;           ///< valid ones
  std::uint64_t invalid = 0;          ///< others
  std::uint64_t clampedColors = 0;    ///< channels that were out of their limits
  std::optional<double> timeOrigin{}; ///< of time stamps, if there are any
};

/// Adds a piece of a scan, behind all before it.
void survey(PointSurvey& survey, ByteSpan bytes, const std::string& name, const Description& description,
            const ScanPiece& piece);

/// Reads the points of pieces, each of another scan, as those of the whole file are read: a mesh each, of those that
/// have points. `survey`: of all pieces of the file.
Imported readPieces(ByteSpan bytes, const std::string& name, const ImportOptions& options,
                    const Description& description, const PointSurvey& survey, std::span<const ScanPiece> pieces);

} // namespace e57

/// Whether bytes begin with "ASTM-E57".
bool isE57(ByteSpan bytes);
Imported readE57(ByteSpan bytes, const std::string& name, const ImportOptions& options);

} // namespace imgeo
