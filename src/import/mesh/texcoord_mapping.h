#pragma once
// Names of sets of texture coordinates in formats that number them.

#include <fmt/format.h>
#include <string>

namespace imgeo {

/// The `mapping` of a set: glTF's name of the attribute, and "" for the first.
inline std::string mappingOf(std::size_t texCoordSet) {
  return texCoordSet == 0 ? "" : fmt::format("TEXCOORD_{}", texCoordSet);
}

} // namespace imgeo
