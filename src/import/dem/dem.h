#pragma once
// Digital elevation models: GeoTIFF, grey PNG, ASCII grids, SRTM's .hgt and GDAL's other formats of one grid of heights
// become a surface in metres, with holes where there is no data. GDAL runs in a process of its own (import/isolation),
// which can open no file but the source and those beside it that hold its georeference.

#include "import/import.h"

#include <array>
#include <string_view>

namespace imgeo {

inline constexpr std::array<std::string_view, 31> demExtensions{
    ".tif", ".tiff",   ".png", ".asc", ".hgt", ".dem",  ".dt0", ".dt1",  ".dt2", ".img", ".bil",
    ".flt", ".grd",    ".bt",  ".hf2", ".nc",  ".xyz",  ".pgm", ".sdat", ".gxf", ".jp2", ".bag",
    ".gtx", ".sigdem", ".isg", ".rst", ".byn", ".ace2", ".dat", ".mtw",  ".ter"};

/// Whether files of this name hold numbers without a header, whose first bytes may look like the mark of any format.
bool holdsRawNumbers(const std::string& name);

/// Whether bytes are TIFF, PNG or an ASCII grid.
bool isDem(ByteSpan bytes);
Imported readDem(ByteSpan bytes, const std::string& name, const ImportOptions& options);

} // namespace imgeo
