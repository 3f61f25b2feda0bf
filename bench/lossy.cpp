// Measures the effect of JPEG and lossy WebP on coordinate images (the paper's Figure 10 and section 7.1). Each model
// is prepared as `imgeo convert` does it; its coordinate images are encoded and decoded with a lossy codec; the
// resulting geometry is compared with the exact one.
//
//   build/bench/lossy MODEL... [--write DIRECTORY]
//
// --write writes a PLY of each distorted mesh there, for `imgeo convert` and visual inspection.

#include "base/error.h"
#include "base/file.h"
#include "bench/models.h"
#include "containers/container_reader.h"
#include "containers/png/png.h"
#include "export/export.h"

#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <fmt/format.h>
#include <jpeglib.h>
#include <memory>
#include <optional>
#include <string>
#include <vector>
#include <webp/decode.h>
#include <webp/encode.h>

namespace imgeo {
namespace {

struct Coded {
  std::size_t bytes = 0;
  Image image; ///< after decoding
};

Coded throughJpeg(const Image& image, int quality) {
  jpeg_error_mgr errors;
  jpeg_compress_struct compress{};
  compress.err = jpeg_std_error(&errors);
  jpeg_create_compress(&compress);
  unsigned char* buffer = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&compress, &buffer, &size);
  compress.image_width = image.width;
  compress.image_height = image.height;
  compress.input_components = 3;
  compress.in_color_space = JCS_RGB;
  jpeg_set_defaults(&compress);
  jpeg_set_quality(&compress, quality, TRUE);
  // No chroma subsampling: x, y and z have the same importance.
  compress.comp_info[0].h_samp_factor = compress.comp_info[0].v_samp_factor = 1;
  jpeg_start_compress(&compress, TRUE);
  while (compress.next_scanline < compress.image_height) {
    auto* row = const_cast<JSAMPLE*>(&image.pixels[std::size_t{compress.next_scanline} * image.width * 3]);
    jpeg_write_scanlines(&compress, &row, 1);
  }
  jpeg_finish_compress(&compress);
  jpeg_destroy_compress(&compress);

  Coded coded{size, image};
  jpeg_decompress_struct decompress{};
  decompress.err = &errors;
  jpeg_create_decompress(&decompress);
  jpeg_mem_src(&decompress, buffer, size);
  jpeg_read_header(&decompress, TRUE);
  decompress.out_color_space = JCS_RGB;
  jpeg_start_decompress(&decompress);
  while (decompress.output_scanline < decompress.output_height) {
    JSAMPLE* row = &coded.image.pixels[std::size_t{decompress.output_scanline} * image.width * 3];
    jpeg_read_scanlines(&decompress, &row, 1);
  }
  jpeg_finish_decompress(&decompress);
  jpeg_destroy_decompress(&decompress);
  std::free(buffer);
  return coded;
}

Coded throughWebp(const Image& image, int quality) {
  std::uint8_t* buffer = nullptr;
  const int stride = static_cast<int>(image.width) * 3;
  const std::size_t size = WebPEncodeRGB(image.pixels.data(), static_cast<int>(image.width),
                                         static_cast<int>(image.height), stride, static_cast<float>(quality), &buffer);
  Coded coded{size, image};
  WebPDecodeRGBInto(buffer, size, coded.image.pixels.data(), coded.image.pixels.size(), stride);
  WebPFree(buffer);
  return coded;
}

struct Variant {
  const char* codec; ///< "PNG" (lossless), "JPEG" or "WebP"
  int quality;
  bool encodesHighBytes; ///< the first byte plane is encoded with the codec, too, and not only the second
};

struct Outcome {
  std::size_t coordBytes = 0;
  double squaredError = 0, maxError = 0;         ///< in the mesh's units
  std::size_t vertices = 0, beyondFirstByte = 0; ///< moved by more than the first byte's step

  void add(double error, const Lattice& lattice) {
    squaredError += error * error;
    maxError = std::max(maxError, error);
    beyondFirstByte += error > 256 * lattice.step;
    ++vertices;
  }
};

Coded recode(const Bytes& png, std::size_t plane, const Variant& variant) {
  const Image image = decodePng(png, "coordinate image");
  const bool lossy = variant.quality > 0 && (plane > 0 || variant.encodesHighBytes);
  if (!lossy)
    return {png.size(), image};
  return variant.codec[0] == 'J' ? throughJpeg(image, variant.quality) : throughWebp(image, variant.quality);
}

/// Encodes and decodes one patch's coordinate images with the codec. Stores the distorted positions in `patch` and adds
/// their errors to `outcome`.
void distort(IndexedPatch& patch, const GeometryDescription& geometry, const EncodeOptions& options,
             const Variant& variant, Outcome& outcome) {
  const EncodedPatch encoded = encodePatch(patch, geometry, options);
  std::vector<Vec3u> stored(patch.vertexCount());
  std::size_t plane = 0;
  for (const EncodedFile& file : encoded.files) {
    if (file.role != Role::coord)
      continue;
    const Coded coded = recode(file.bytes, plane++, variant);
    outcome.coordBytes += coded.bytes;
    for (std::size_t i = 0; i < stored.size(); ++i)
      for (int axis = 0; axis < 3; ++axis)
        stored[i][axis] = stored[i][axis] << 8 | coded.image.pixels[i * 3 + static_cast<std::size_t>(axis)];
  }
  for (std::size_t i = 0; i < stored.size(); ++i)
    outcome.add(length(Vec3d(stored[i]) - Vec3d(patch.positions[i])) * geometry.lattice.step, geometry.lattice);
  patch.positions = std::move(stored);
}

void writeMesh(const std::vector<IndexedPatch>& patches, const Lattice& lattice, const std::string& path) {
  Scene scene;
  Mesh mesh;
  for (const IndexedPatch& patch : patches) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec3u& position : patch.positions) {
      mesh.wedgePositions.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
      mesh.positions.push_back(Vec3f(lattice.point(position)));
    }
    for (const std::uint32_t index : patch.indices)
      mesh.corners.push_back(first + index);
  }
  scene.meshes.push_back(std::move(mesh));
  addRoot(scene.graph, {"distorted", Shape{}, {}, ""});
  writeFile(path, exportScene(scene, MeshFormat::ply));
}

void printRow(const std::string& name, const Outcome& outcome, std::size_t losslessBytes, double diagonal) {
  const auto count = static_cast<double>(outcome.vertices);
  fmt::print("| {} | {} | {:.2f} | {:.4f} | {:.3f} | {:.1f} % |\n", name, outcome.coordBytes,
             static_cast<double>(outcome.coordBytes) / static_cast<double>(losslessBytes),
             100 * std::sqrt(outcome.squaredError / count) / diagonal, 100 * outcome.maxError / diagonal,
             100 * static_cast<double>(outcome.beyondFirstByte) / count);
}

/// Measures the alternative to a lossy codec: lossless images with fewer bits.
Outcome withFewerBits(const Mesh& mesh, const Lattice& full, std::uint32_t bits, EncodeOptions options) {
  const Lattice lattice = latticeFor(boxOf(mesh), bits);
  const PatchedMesh patched = cutIntoPatches(mesh, lattice, 65535);
  const GeometryDescription geometry = describe(patched, options);
  Outcome outcome;
  for (const Patch& patch : patched.patches) {
    const EncodedPatch encoded = encodePatch(asTriangles(patch), geometry, options);
    for (const EncodedFile& file : encoded.files)
      if (file.role == Role::coord)
        outcome.coordBytes += file.bytes.size();
  }
  const std::vector<Vec3u> coarse = quantise(mesh.positions, lattice), fine = quantise(mesh.positions, full);
  for (std::size_t i = 0; i < fine.size(); ++i)
    outcome.add(length(lattice.point(coarse[i]) - full.point(fine[i])), full);
  return outcome;
}

void measure(const std::filesystem::path& model, const std::string& directory) {
  Mesh mesh = importFile(model).scene.meshes.at(0);
  weld(mesh);
  const PatchedMesh patched = bench::patchesOf(mesh);
  const EncodeOptions options{.encoding = Encoding::classic, .normalBits = 8, .effort = 9};
  const GeometryDescription geometry = describe(patched, options);
  const double diagonal = length(boxOf(mesh).size());
  const std::vector<IndexedPatch> exact = bench::patchesInFanOrder(patched);

  fmt::print("\n{}: {} triangles\n\n", model.filename().string(), mesh.elementCount());
  fmt::print("| coordinate images | bytes | of lossless | RMS error, % of diagonal | largest | vertices off by "
             "more than 8-bit precision |\n|---|---|---|---|---|---|\n");
  std::size_t losslessBytes = 0;
  const auto run = [&](const Variant& variant, const std::string& name, const std::string& file) {
    std::vector<IndexedPatch> patches = exact;
    Outcome outcome;
    for (IndexedPatch& patch : patches)
      distort(patch, geometry, options, variant, outcome);
    if (losslessBytes == 0)
      losslessBytes = outcome.coordBytes;
    printRow(name, outcome, losslessBytes, diagonal);
    if (!directory.empty())
      writeMesh(patches, geometry.lattice, fmt::format("{}/{}-{}.ply", directory, model.stem().string(), file));
  };
  run({"PNG", 0, false}, "PNG, 16 bits, lossless", "lossless");
  for (const std::uint32_t bits : {14u, 12u, 10u})
    printRow(fmt::format("PNG, {} bits, lossless", bits), withFewerBits(mesh, geometry.lattice, bits, options),
             losslessBytes, diagonal);
  for (const bool encodesHighBytes : {false, true})
    for (const char* codec : {"JPEG", "WebP"})
      for (const int quality : {100, 95, 80, 50})
        run({codec, quality, encodesHighBytes},
            fmt::format("{} {}, {}", codec, quality, encodesHighBytes ? "both bytes" : "second byte only"),
            fmt::format("{}{}{}", codec, quality, encodesHighBytes ? "-both" : ""));
}

} // namespace
} // namespace imgeo

int main(int argc, char** argv) {
  std::vector<std::string> models;
  std::string directory;
  for (int i = 1; i < argc; ++i) {
    if (std::string_view(argv[i]) == "--write" && i + 1 < argc)
      directory = argv[++i];
    else
      models.emplace_back(argv[i]);
  }
  return imgeo::bench::run([&] {
    if (models.empty())
      throw imgeo::Error(imgeo::ErrorKind::usage, "", "usage: lossy MODEL... [--write DIRECTORY]");
    for (const std::string& model : models)
      imgeo::measure(model, directory);
  });
}
