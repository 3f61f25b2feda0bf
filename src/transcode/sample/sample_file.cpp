// Writes a generated scene to a mesh file.

#include "transcode/sample/sample_file.h"

#include "base/box_corners.h"
#include "base/error.h"
#include "base/file.h"
#include "transcode/export/write_scene.h"
#include "transcode/sample/box_soup.h"
#include "transcode/sample/relief_charts.h"
#include "transcode/sample/relief_surface.h"
#include "transcode/sample/sample_hall.h"

#include <algorithm>
#include <array>
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

void addTriangle(PieceWriter& writer, const std::array<std::uint64_t, 3>& vertices) {
  writer.add(std::uint8_t{3});
  for (const std::uint64_t vertex : vertices)
    writer.add(static_cast<std::uint32_t>(vertex));
}

/// `addVertex` writes one vertex of the surface.
template <typename Surface, typename AddVertex>
void writeSurface(const Surface& surface, bool shuffled, PieceWriter& writer, const AddVertex& addVertex) {
  const Scattering vertices(surface.vertexCount(), 1), triangles(surface.triangleCount(), 2);
  for (std::uint64_t i = 0; i < surface.vertexCount(); ++i)
    addVertex(shuffled ? vertices.of(i) : i);
  for (std::uint64_t i = 0; i < surface.triangleCount(); ++i) {
    std::array<std::uint64_t, 3> corners = surface.triangle(shuffled ? triangles.of(i) : i);
    if (shuffled)
      for (std::uint64_t& corner : corners)
        corner = vertices.inverse(corner);
    addTriangle(writer, corners);
  }
}

void addPoint(PieceWriter& writer, const Vec3f& point) {
  for (int axis = 0; axis < 3; ++axis)
    writer.add(point[axis]);
}

void writeBoxes(const BoxSoup& soup, std::uint64_t count, bool shuffled, PieceWriter& writer) {
  const Scattering order(count, 1);
  for (std::uint64_t i = 0; i < count; ++i)
    for (const Vec3d& corner : cornersOf(soup.box(shuffled ? order.of(i) : i)))
      addPoint(writer, Vec3f(corner));
  // Corner number n is at the maximum of the axes that are bits of n; triangles are counterclockwise from outside.
  constexpr std::array<std::array<std::uint64_t, 3>, 12> triangles{{{0, 2, 1},
                                                                    {1, 2, 3},
                                                                    {4, 5, 6},
                                                                    {5, 7, 6},
                                                                    {0, 1, 4},
                                                                    {1, 5, 4},
                                                                    {2, 6, 3},
                                                                    {3, 6, 7},
                                                                    {0, 4, 2},
                                                                    {2, 4, 6},
                                                                    {1, 3, 5},
                                                                    {3, 7, 5}}};
  for (std::uint64_t i = 0; i < count; ++i)
    for (const auto& [a, b, c] : triangles)
      addTriangle(writer, {8 * i + a, 8 * i + b, 8 * i + c});
}

void writeCloud(const ReliefSurface& surface, bool shuffled, PieceWriter& writer) {
  const Scattering order(surface.squareCount(), 1);
  for (std::uint64_t i = 0; i < surface.squareCount(); ++i) {
    const Vec3f point = surface.pointInSquare(shuffled ? order.of(i) : i);
    addPoint(writer, point);
    const double height = std::clamp(5 * (length(Vec3d(point)) - 0.9), 0.0, 1.0); // of 0.9 .. 1.1
    for (const double channel : {90 + 150 * height, 130 + 60 * height, 70 + 160 * height * height})
      writer.add(static_cast<std::uint8_t>(channel));
    writer.add(static_cast<std::uint16_t>(65535 * height));
    writer.add(std::uint8_t{height < 0.5 ? std::uint8_t{2} : std::uint8_t{5}});
  }
}

/// Writes a PLY file of one shape. `properties`: the lines of the header about the vertices' further values, and about
/// where up is. `write` writes the body.
template <typename Write>
ExportReport writePlyInPieces(const std::filesystem::path& output, std::uint64_t vertices, ElementCounts elements,
                              const std::string& comment, const std::string& properties, const Write& write) {
  if (meshFormatOf(output) != MeshFormat::ply)
    throw Error(ErrorKind::usage, output.string(), "does not end in .ply, the format of this sample");
  ExportReport report;
  report.format = nameOf(MeshFormat::ply);
  report.shapes = 1;
  report.vertices = vertices;
  report.elements = elements;
  std::string header = fmt::format("ply\nformat binary_little_endian 1.0\n{}element vertex {}\n"
                                   "property float x\nproperty float y\nproperty float z\n{}",
                                   comment, vertices, properties);
  if (elements.triangles > 0)
    header += fmt::format("element face {}\nproperty list uchar uint vertex_indices\n", elements.triangles);
  header += "end_header\n";
  writeFileInPieces(output, [&](const AppendBytes& append) {
    append(asBytes(header));
    PieceWriter writer(append);
    write(writer);
    writer.flush();
    report.bytes = header.size() + writer.written();
  });
  return report;
}

} // namespace

ExportReport writeSampleCloud(std::uint64_t points, bool shuffled, const std::filesystem::path& output) {
  const ReliefSurface surface(2 * points); // a point for each two triangles
  return writePlyInPieces(output, surface.squareCount(), {.points = surface.squareCount()}, "",
                          "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                          "property ushort intensity\nproperty uchar classification\n",
                          [&](PieceWriter& writer) { writeCloud(surface, shuffled, writer); });
}

ExportReport writeSampleRelief(std::uint64_t triangles, bool shuffled, const std::filesystem::path& output) {
  const ReliefSurface surface(triangles);
  return writePlyInPieces(output, surface.vertexCount(), {.triangles = surface.triangleCount()}, "", "",
                          [&](PieceWriter& writer) {
                            writeSurface(surface, shuffled, writer,
                                         [&](std::uint64_t vertex) { addPoint(writer, surface.vertex(vertex)); });
                          });
}

ExportReport writeSampleReliefInCharts(std::uint64_t triangles, std::uint64_t charts, bool shuffled,
                                       const std::filesystem::path& output) {
  const ReliefCharts surface(triangles, charts);
  if (surface.vertexCount() > UINT32_MAX)
    throw Error(ErrorKind::usage, output.string(),
                fmt::format("would have {} vertices, more than the indices of a PLY file can number: ask for fewer "
                            "triangles or charts",
                            surface.vertexCount()));
  std::filesystem::path image = output;
  image.replace_extension(".png");
  if (meshFormatOf(output) == MeshFormat::ply)
    writeFile(image, encodePng(surface.atlas(), 1));
  return writePlyInPieces(output, surface.vertexCount(), {.triangles = surface.triangleCount()},
                          fmt::format("comment TextureFile {}\n", image.filename().string()),
                          "property float s\nproperty float t\n", [&](PieceWriter& writer) {
                            writeSurface(surface, shuffled, writer, [&](std::uint64_t vertex) {
                              addPoint(writer, surface.vertex(vertex));
                              const Vec2f texCoord = surface.texCoord(vertex);
                              writer.add(texCoord.x);
                              writer.add(texCoord.y);
                            });
                          });
}

ExportReport writeSampleBoxes(std::uint64_t count, std::uint64_t seed, bool shuffled,
                              const std::filesystem::path& output) {
  const BoxSoup soup(count, seed);
  return writePlyInPieces(output, 8 * count, {.triangles = 12 * count}, "comment up z\n", "",
                          [&](PieceWriter& writer) { writeBoxes(soup, count, shuffled, writer); });
}

} // namespace imgeo
