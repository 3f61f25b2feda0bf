#include "import_check.h"

#include <string_view>

/// Scenes with animations of nodes and of morph targets, and with skins, of three formats of Assimp.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view beginning(reinterpret_cast<const char*>(data), size < 64 ? size : 64);
  const char* name = beginning.starts_with('<') ? "fuzz.dae" : beginning.starts_with("xof") ? "fuzz.x" : "fuzz.fbx";
  return imgeo::fuzz::importOrRefuse(data, size, name);
}
