#include "base/bytes.h"
#include "base/error.h"
#include "documents/documents.h"

#include <cstdlib>

/// A scene that is read can be written, in both forms, and read again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace imgeo;
  const auto require = [](bool condition) {
    if (!condition)
      std::abort();
  };
  SceneDocument read;
  try {
    read = readScene(asText({data, size}), "fuzz.x3d");
  } catch (const Error& error) {
    require(!error.message().empty() && error.place().starts_with("fuzz.x3d"));
    return 0;
  }
  for (const std::string& text : {writeX3d(read), writeHtml(read, {"runtime.js", "style.css"})}) {
    const SceneDocument again = readScene(text, "again");
    require(again.title == read.title && again.headlight == read.headlight);
    require(again.shapes.size() == read.shapes.size() && again.viewpoints.size() == read.viewpoints.size());
    for (std::size_t i = 0; i < read.shapes.size(); ++i) {
      require(again.shapes[i].material == read.shapes[i].material);
      require(again.geometries[again.shapes[i].mesh].patches.size() ==
              read.geometries[read.shapes[i].mesh].patches.size());
    }
  }
  return 0;
}
