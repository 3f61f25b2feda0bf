#include "transcode/sample/sample_frames.h"

#include "base/error.h"
#include "base/file.h"
#include "export/export.h"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>

namespace imgeo {

namespace {

/// Two triangles for each cell of the grid.
std::vector<std::uint32_t> trianglesOf(std::uint32_t columns, std::uint32_t vertices) {
  std::vector<std::uint32_t> corners;
  for (std::uint32_t row = 0; row + columns < vertices; row += columns)
    for (std::uint32_t i = row; i + 1 < row + columns; ++i)
      corners.insert(corners.end(), {i, i + columns, i + 1, i + 1, i + columns, i + columns + 1});
  return corners;
}

Scene sceneOf(const Motion& motion) {
  Mesh mesh;
  mesh.positions.assign(motion.positions().begin(), motion.positions().end());
  mesh.wedgePositions.resize(mesh.positions.size());
  std::iota(mesh.wedgePositions.begin(), mesh.wedgePositions.end(), 0u);
  if (motion.columns() > 0) {
    mesh.corners = trianglesOf(motion.columns(), static_cast<std::uint32_t>(mesh.positions.size()));
  } else {
    mesh.topology = Topology::points;
    mesh.corners = mesh.wedgePositions;
  }
  Scene scene;
  scene.meshes.push_back(std::move(mesh));
  addRoot(scene.graph, {"", Shape{}, {}, ""});
  return scene;
}

} // namespace

FramesReport writeSampleFrames(Motion& motion, const std::string& name, std::uint32_t count, double rate,
                               const std::filesystem::path& folder, const std::function<void()>& done) {
  std::error_code ignored;
  if (std::filesystem::exists(folder, ignored) && !std::filesystem::is_empty(folder, ignored))
    throw Error(ErrorKind::usage, folder.string(), "is there already, and is not empty");
  std::filesystem::create_directories(folder, ignored);
  FramesReport report;
  for (std::uint32_t frame = 1; frame <= count; ++frame) {
    motion.advance(std::min(0.1, 1 / rate));
    const Bytes bytes = writePly(sceneOf(motion), AxisDirection::y);
    writeFile(folder / fmt::format("{}-{:04}.ply", name, frame), bytes);
    report.bytes += bytes.size();
    done();
  }
  return report;
}

} // namespace imgeo
