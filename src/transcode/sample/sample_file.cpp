// Writes a generated scene to a mesh file.

#include "transcode/sample/sample_file.h"

#include "base/error.h"
#include "base/file.h"
#include "transcode/export/write_scene.h"
#include "transcode/sample/relief_surface.h"
#include "transcode/sample/sample_hall.h"

#include <algorithm>
#include <fmt/format.h>

namespace imgeo {

ExportReport writeSampleHall(std::uint32_t seats, const std::filesystem::path& output) {
  if (meshFormatOf(output) != MeshFormat::glb)
    throw Error(ErrorKind::usage, output.string(), "does not end in .glb, the format that keeps a hall's structure");
  return writeScene(hallScene(seats), MeshFormat::glb, output);
}

namespace {

/// Collects small writes.
class PieceWriter {
public:
  explicit PieceWriter(const AppendBytes& append) : append_(append) {}

  template <typename T> void add(T value) {
    appendLittle(piece_, value);
    if (piece_.size() >= pieceBytes)
      flush();
  }
  void flush() {
    append_(piece_);
    written_ += piece_.size();
    piece_.clear();
  }
  std::uint64_t written() const { return written_; }

private:
  static constexpr std::size_t pieceBytes = std::size_t{1} << 20;
  const AppendBytes& append_;
  Bytes piece_;
  std::uint64_t written_ = 0;
};

void writeRelief(const ReliefSurface& surface, bool shuffled, PieceWriter& writer) {
  const Scattering vertices(surface.vertexCount(), 1), triangles(surface.triangleCount(), 2);
  for (std::uint64_t i = 0; i < surface.vertexCount(); ++i) {
    const Vec3f vertex = surface.vertex(shuffled ? vertices.of(i) : i);
    for (int axis = 0; axis < 3; ++axis)
      writer.add(vertex[axis]);
  }
  for (std::uint64_t i = 0; i < surface.triangleCount(); ++i) {
    writer.add(std::uint8_t{3});
    for (const std::uint64_t vertex : surface.triangle(shuffled ? triangles.of(i) : i))
      writer.add(static_cast<std::uint32_t>(shuffled ? vertices.inverse(vertex) : vertex));
  }
}

void writeCloud(const ReliefSurface& surface, bool shuffled, PieceWriter& writer) {
  const Scattering order(surface.squareCount(), 1);
  for (std::uint64_t i = 0; i < surface.squareCount(); ++i) {
    const Vec3f point = surface.pointInSquare(shuffled ? order.of(i) : i);
    for (int axis = 0; axis < 3; ++axis)
      writer.add(point[axis]);
    const double height = std::clamp(5 * (length(Vec3d(point)) - 0.9), 0.0, 1.0); // of 0.9 .. 1.1
    for (const double channel : {90 + 150 * height, 130 + 60 * height, 70 + 160 * height * height})
      writer.add(static_cast<std::uint8_t>(channel));
    writer.add(static_cast<std::uint16_t>(65535 * height));
    writer.add(std::uint8_t{height < 0.5 ? std::uint8_t{2} : std::uint8_t{5}});
  }
}

void requirePly(const std::filesystem::path& output) {
  if (meshFormatOf(output) != MeshFormat::ply)
    throw Error(ErrorKind::usage, output.string(), "does not end in .ply, the format of a relief");
}

} // namespace

ExportReport writeSampleCloud(std::uint64_t points, bool shuffled, const std::filesystem::path& output) {
  requirePly(output);
  const ReliefSurface surface(2 * points); // a point for each two triangles
  ExportReport report;
  report.format = nameOf(MeshFormat::ply);
  report.shapes = 1;
  report.vertices = report.elements.points = surface.squareCount();
  const std::string header = fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n"
                                         "property float x\nproperty float y\nproperty float z\n"
                                         "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                                         "property ushort intensity\nproperty uchar classification\nend_header\n",
                                         surface.squareCount());
  writeFileInPieces(output, [&](const AppendBytes& append) {
    append(asBytes(header));
    PieceWriter writer(append);
    writeCloud(surface, shuffled, writer);
    writer.flush();
    report.bytes = header.size() + writer.written();
  });
  return report;
}

ExportReport writeSampleRelief(std::uint64_t triangles, bool shuffled, const std::filesystem::path& output) {
  requirePly(output);
  const ReliefSurface surface(triangles);
  ExportReport report;
  report.format = nameOf(MeshFormat::ply);
  report.shapes = 1;
  report.vertices = surface.vertexCount();
  report.elements.triangles = surface.triangleCount();
  const std::string header = fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n"
                                         "property float x\nproperty float y\nproperty float z\n"
                                         "element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
                                         surface.vertexCount(), surface.triangleCount());
  writeFileInPieces(output, [&](const AppendBytes& append) {
    append(asBytes(header));
    PieceWriter writer(append);
    writeRelief(surface, shuffled, writer);
    writer.flush();
    report.bytes = header.size() + writer.written();
  });
  return report;
}

} // namespace imgeo
