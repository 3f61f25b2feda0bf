#pragma once
// The heights of a raster file and what it states of the ground below them, read by GDAL.

#include "import/references.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace imgeo {

/// The largest number of cells that are read: 67 million triangles, about 5 GB of memory.
inline constexpr std::uint64_t maxHeightCells = std::uint64_t{1} << 25;

struct HeightGrid {
  std::uint32_t columns = 0, rows = 0;
  std::vector<float> heights;        ///< row by row, in heightUnit; NaN: no data
  std::string driver;                ///< GDAL's name of the format: "GTiff", "AAIGrid" ...
  std::string heightUnit;            ///< as the file states it; may be empty
  std::optional<double> noData;      ///< the number that stands for no data
  std::vector<std::string> warnings; ///< one sentence each

  /// Column and row, counted from the outer corner of the first cell, to coordinates of the reference system:
  /// x = t[0] + t[1] column + t[2] row, y = t[3] + t[4] column + t[5] row. Nothing: the file states no cell size.
  std::optional<std::array<double, 6>> transform;

  // The coordinate reference system; all empty where the file states none.
  std::string wkt;     ///< its definition, as OGC's well-known text
  std::string crsName; ///< "NAD83 / UTM zone 17N"
  std::string crsCode; ///< "EPSG:26917"
  bool isGeographic = false;
  double unit = 1; ///< metres or, of a geographic system, radians in a unit of its coordinates
  double semiMajor = 6378137, inverseFlattening = 298.257223563; ///< of its ellipsoid, in metres; 0: a sphere
};

/// Whether bytes are of a raster format that has a signature: TIFF, PNG, an ASCII grid.
bool hasRasterSignature(ByteSpan bytes);

/// Reads the first band of a raster in this process, which can open no further files afterwards. Files beside the
/// source that hold its georeference (.prj, .tfw, .hdr ...) are fetched from `references`. Throws Error{malformed,
/// unsupported, limit} with `name`.
HeightGrid readHeightGrid(ByteSpan bytes, const std::string& name, const References& references);

} // namespace imgeo
