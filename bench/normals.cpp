// Size and error of normals in each encoding of SIG classic, and in two that imgeo does not write: octahedral
// coordinates as two channels of one image, and the palette as a GIF (the paper's unexplored option, 7.1). Meshes are
// prepared as `imgeo convert` does it; errors are those of the files as they are read back.
//
//   build/bench/normals MODEL...

#include "containers/normals.h"
#include "base/error.h"
#include "bench/models.h"
#include "containers/classic/layout.h"
#include "containers/container_reader.h"
#include "containers/normal_palette.h"
#include "containers/png/png.h"
#include "containers/unit_vectors.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <functional>
#include <gif_lib.h>
#include <numbers>
#include <string>

namespace imgeo {
namespace {

struct Outcome {
  std::size_t bytes = 0, vertices = 0;
  double sum = 0, maximum = 0; ///< of angles, in degrees

  void add(const std::vector<Vec3f>& normals, const std::vector<Vec3f>& stored) {
    for (std::size_t i = 0; i < normals.size(); ++i) {
      const double degrees = angleBetween(normals[i], stored[i]) * (180 / std::numbers::pi);
      sum += degrees;
      maximum = std::max(maximum, degrees);
    }
    vertices += normals.size();
  }
};

/// Adds the size and the error of one patch's normals.
using Measure = std::function<void(const PatchedMesh&, const IndexedPatch&, Outcome&)>;

constexpr int effort = 9;

Measure asWritten(NormalEncoding normals) {
  return [normals](const PatchedMesh& mesh, const IndexedPatch& patch, Outcome& outcome) {
    const EncodeOptions options{Encoding::classic, 8, effort, Target::web, normals};
    const GeometryDescription geometry = describe(mesh, options);
    const EncodedPatch encoded = encodePatch(patch, geometry, options);
    outcome.bytes += std::ranges::find(encoded.files, Role::normal, &EncodedFile::role)->bytes.size();
    outcome.add(patch.normals, decodePatch(encoded, geometry).normals);
  };
}

/// Octahedral coordinates in red and green, stored as positions are.
void asTwoChannels(const PatchedMesh&, const IndexedPatch& patch, Outcome& outcome) {
  std::vector<Vec3f> stored;
  const Image image =
      imageOf(recordImageSize(patch.vertexCount()), 3, patch.vertexCount(), [&](std::size_t n, std::uint8_t* out) {
        const auto pair = storeNormal(patch.normals[n], NormalEncoding::octahedral, 8);
        out[0] = static_cast<std::uint8_t>(pair.x);
        out[1] = static_cast<std::uint8_t>(pair.y);
        stored.push_back(loadNormal(pair, NormalEncoding::octahedral, 8));
      });
  outcome.bytes += encodePng(image, effort).size();
  outcome.add(patch.normals, stored);
}

int appendTo(GifFileType* gif, const GifByteType* bytes, int count) {
  Bytes& out = *static_cast<Bytes*>(gif->UserData);
  out.insert(out.end(), bytes, bytes + count);
  return count;
}

Bytes encodeGif(ImageSize size, const NormalPalette& palette, std::vector<std::uint8_t> pixels) {
  Bytes out;
  const int width = static_cast<int>(size.columns), height = static_cast<int>(size.rows);
  std::array<GifColorType, 256> colors;
  std::ranges::transform(palette.colors, colors.begin(), [](Rgba8 c) { return GifColorType{c.r, c.g, c.b}; });
  ColorMapObject* map = GifMakeMapObject(256, colors.data());
  GifFileType* gif = EGifOpen(&out, appendTo, nullptr);
  bool good = EGifPutScreenDesc(gif, width, height, 8, 0, map) == GIF_OK &&
              EGifPutImageDesc(gif, 0, 0, width, height, false, nullptr) == GIF_OK &&
              EGifPutLine(gif, pixels.data(), static_cast<int>(pixels.size())) == GIF_OK;
  good = EGifCloseFile(gif, nullptr) == GIF_OK && good;
  GifFreeMapObject(map);
  if (!good)
    throw Error(ErrorKind::io, "", "the GIF could not be written");
  return out;
}

void asGif(const PatchedMesh&, const IndexedPatch& patch, Outcome& outcome) {
  const NormalPalette palette = normalPalette(patch.normals);
  const ImageSize size = recordImageSize(patch.vertexCount());
  std::vector<std::uint8_t> pixels = palette.indices;
  pixels.resize(std::size_t{size.columns} * size.rows, pixels.back());
  outcome.bytes += encodeGif(size, palette, pixels).size();
  std::vector<Vec3f> stored;
  for (const std::uint8_t index : palette.indices) {
    const Rgba8 c = palette.colors[index];
    const Vec3d v{c.r / 127.5 - 1, c.g / 127.5 - 1, c.b / 127.5 - 1};
    stored.push_back(Vec3f(v * (1 / length(v))));
  }
  outcome.add(patch.normals, stored);
}

struct Row {
  std::string name, bound;
  Measure measure;
};

std::string degrees(double radians) {
  return fmt::format("{:.2f}", radians * (180 / std::numbers::pi));
}

void printTable(const std::string& path) {
  const Row rows[] = {
      {"rgb", degrees(componentErrorBound(1 / 127.5)), asWritten(NormalEncoding::rgb)},
      {"octahedral", degrees(octahedralErrorBound(8)), asWritten(NormalEncoding::octahedral)},
      {"octahedral, as two channels", degrees(octahedralErrorBound(8)), asTwoChannels},
      {"spherical", degrees(sphericalErrorBound(8)), asWritten(NormalEncoding::spherical)},
      {"palette, PNG", "none", asWritten(NormalEncoding::palette)},
      {"palette, GIF", "none", asGif},
  };
  bench::visitSurfaces(path, [&](const Mesh& mesh) {
    const PatchedMesh patched = bench::patchesOf(mesh);
    const std::vector<IndexedPatch> patches = bench::patchesInFanOrder(patched);
    fmt::print("\n{}: {} vertices, {} patches\n\n", std::filesystem::path(path).filename().string(), mesh.wedgeCount(),
               patches.size());
    fmt::print("| normals | bytes | bits/vertex | of rgb | mean error, degrees | largest | bound |\n"
               "|---|--:|--:|--:|--:|--:|--:|\n");
    std::size_t rgbBytes = 0;
    for (const Row& row : rows) {
      Outcome outcome;
      for (const IndexedPatch& patch : patches)
        row.measure(patched, patch, outcome);
      if (rgbBytes == 0)
        rgbBytes = outcome.bytes;
      const double vertices = static_cast<double>(outcome.vertices), bytes = static_cast<double>(outcome.bytes);
      fmt::print("| {} | {} | {:.1f} | {:.2f} | {:.3f} | {:.2f} | {} |\n", row.name, outcome.bytes,
                 8 * bytes / vertices, bytes / static_cast<double>(rgbBytes), outcome.sum / vertices, outcome.maximum,
                 row.bound);
      std::fflush(stdout);
    }
  });
}

} // namespace
} // namespace imgeo

int main(int count, char** words) {
  using namespace imgeo;
  return bench::run([&] {
    if (count < 2)
      throw Error(ErrorKind::usage, "", "usage: normals MODEL...");
    for (int i = 1; i < count; ++i)
      printTable(words[i]);
  });
}
