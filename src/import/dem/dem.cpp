#include "import/dem/dem.h"

#include "import/dem/library.h"
#include "import/dem/terrain.h"
#include "import/isolation/child_process.h"
#include "import/source_name.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace imgeo {

namespace {

Imported readInThisProcess(ByteSpan bytes, const std::string& name, const ImportOptions& options) {
  const References references(options, name);
  HeightGrid grid = readHeightGrid(bytes, name, references);
  Ground ground = groundOf(grid, name);
  Imported imported;
  imported.format = grid.driver == "GTiff" ? "GeoTIFF" : grid.driver;
  imported.warnings = std::move(grid.warnings);
  std::ranges::move(ground.notes, std::back_inserter(imported.warnings));
  imported.attributes = {heightName};
  imported.scene.meshes.push_back(terrainMesh(grid, ground, options.attributes.has(heightName), name));
  const std::size_t shape = addRoot(imported.scene.graph, {"", Shape{0, {}, false}, {}, ""});
  addGeoreference(imported.scene.graph, shape, grid, ground);
  return imported;
}

} // namespace

bool holdsRawNumbers(const std::string& name) {
  constexpr std::array<std::string_view, 5> extensions{".hgt", ".bil", ".flt", ".ace2", ".dat"};
  return std::ranges::find(extensions, extensionOf(name)) != extensions.end();
}

bool isDem(ByteSpan bytes) {
  return hasRasterSignature(bytes);
}

Imported readDem(ByteSpan bytes, const std::string& name, const ImportOptions& options) {
  gdal(); // in this process, so that it is loaded once for all children
  return readInChildProcess([&] { return readInThisProcess(bytes, name, options); }, name);
}

} // namespace imgeo
