#pragma once

namespace imgeo {

/// The name of the NamedAttribute with depths in fog: of one number, the share of the fog's colour, 0 to 1 (X3D's
/// FogCoordinate). Pages read it by this name.
inline constexpr const char* fogDepthName = "fogDepth";

} // namespace imgeo
