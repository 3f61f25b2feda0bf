#pragma once
// What encoding a mesh adds to the report of a conversion.

#include "imgeo/convert.h"
#include "transcode/encode/encode_mesh.h"

namespace imgeo {

/// Adds the counts of a mesh to those of the report, and raises the report's maxima of bits, steps and errors to the
/// mesh's.
void addToReport(ConvertReport& report, const EncodedMesh& encoded);

} // namespace imgeo
