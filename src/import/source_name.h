#pragma once
// The name of a source file: what scenes, formats and error locations take from it.

#include <cstddef>
#include <string>

namespace imgeo {

/// "bunny" of "models/bunny.ply.gz".
std::string stemOf(const std::string& name);

/// ".ply" of "models/bunny.PLY.gz": in lower case, empty where there is none.
std::string extensionOf(const std::string& name);

/// "bunny.ply, byte 1042": a location in a binary file.
std::string byteLocation(const std::string& name, std::size_t byte);

} // namespace imgeo
