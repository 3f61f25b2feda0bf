#pragma once
// LAS point clouds (ASPRS, "LAS Specification" 1.0 to 1.4): points of all formats with their colours; intensity,
// classification, returns, scan angle, user data, source, GPS time, near infrared and extra bytes as further
// attributes. Points that are marked as withheld are left out. Coordinates far from zero are stored around an origin,
// which the document's metadata state (MetadataSet "georeference"), with the reference system. Waveforms are not read;
// LAZ, compressed LAS, is refused.

#include "import/import.h"

namespace imgeo {

/// Whether bytes begin with "LASF".
bool isLas(ByteSpan bytes);
Imported readLas(ByteSpan bytes, const std::string& name, const ImportOptions& options);

} // namespace imgeo
