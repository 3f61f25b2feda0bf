#pragma once
// E57 point clouds (ASTM E2807): every scan with its pose, from Cartesian or spherical coordinates, with its colours;
// intensity, classification, row, column, return, time stamp and all other fields of numbers as further attributes. A
// file's scans are shapes of one scene. Points that are marked as invalid are left out. Coordinates far from zero are
// stored around an origin, which the document's metadata state (MetadataSet "georeference"), with the reference system.
// Pictures and texts of points are not read.

#include "import/import.h"

namespace imgeo {

/// Whether bytes begin with "ASTM-E57".
bool isE57(ByteSpan bytes);
Imported readE57(ByteSpan bytes, const std::string& name, const ImportOptions& options);

} // namespace imgeo
