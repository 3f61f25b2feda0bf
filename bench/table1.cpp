// Table 1 of the 2012 paper: the size of a mesh in each encoding, as four kinds of triangle primitives, compared with
// the paper's numbers for the models that it has. Meshes have 16-bit positions and 8-bit normals in SIG, and single
// precision in BG and in X3D. Every SIG patch is read back before it is counted. All columns have the same effort.
//
//   build/bench/table1 [--effort 0..9] MODEL...        (in the repository's root, with libfastinfoset-java)

#include "base/error.h"
#include "base/file.h"
#include "bench/models.h"
#include "containers/container_reader.h"
#include "containers/image_file.h"
#include "containers/raw_size.h"
#include "documents/element_writer.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <span>
#include <string>

namespace imgeo {
namespace {

constexpr const char* kinds[] = {"raw triangles", "triangle strips", "indexed triangles", "indexed strips"};
constexpr std::size_t indexedTriangles = 2;
enum Column { x3d, x3db, bg, sigRaw, sigPng, columnCount };
using Row = std::array<std::uint64_t, columnCount>;

struct PaperTable {
  std::size_t triangles;
  std::array<Row, 4> rows;
};
constexpr PaperTable paperTables[] = {{69451,
                                       {{{11135415, 2298303, 5000472, 1875177, 1388904},
                                         {4638412, 1910977, 2150664, 806499, 535483},
                                         {2977736, 1130963, 1252722, 730212, 584695},
                                         {2269225, 937259, 1055238, 492728, 405799}}}},
                                      {96966,
                                       {{{16324694, 2026318, 6981552, 2618082, 2009258},
                                         {6647483, 2742016, 3087816, 1157931, 741350},
                                         {4399737, 1539600, 1745436, 1018161, 883318},
                                         {3411800, 1304490, 1420958, 693683, 607876}}}}};

std::string grouped(std::uint64_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t at = digits.size(); at > 3;)
    digits.insert(at -= 3, ",");
  return digits;
}

/// The X3D nodes of some of a patch's vertices.
std::string verticesText(const IndexedPatch& patch, const Lattice& lattice, std::size_t first, std::size_t count) {
  std::string text = "><Coordinate DEF='c' point='";
  for (const Vec3u& position : std::span(patch.positions).subspan(first, count))
    text += numbers(Vec3f(lattice.point(position))) + " ";
  text += "'></Coordinate><Normal DEF='n' vector='";
  for (const Vec3f& normal : std::span(patch.normals).subspan(first, count))
    text += numbers(normal) + " ";
  return text + "'></Normal>";
}

/// The X3D nodes that hold a patch inline: one for each draw; all but the first USE its vertices.
std::string textOf(const IndexedPatch& patch, const Lattice& lattice) {
  std::string text;
  std::size_t first = 0;
  for (const Draw& draw : patch.draws) {
    const bool indexed = !patch.indices.empty(), strip = draw.primitive == Primitive::triangleStrip;
    const std::string name = fmt::format("{}Triangle{}Set", indexed ? "Indexed" : "", strip ? "Strip" : "");
    text += "<" + name;
    if (indexed) {
      text += " index='";
      for (const std::uint32_t index : std::span(patch.indices).subspan(first, draw.count))
        text += fmt::format("{} ", index);
      text += strip ? "-1'" : "'";
    } else if (strip) {
      text += fmt::format(" stripCount='{}'", draw.count);
    }
    const bool sharesVertices = indexed && first > 0;
    text += sharesVertices
                ? "><Coordinate USE='c'/><Normal USE='n'/>"
                : verticesText(patch, lattice, indexed ? 0 : first, indexed ? patch.vertexCount() : draw.count);
    text += "</" + name + ">";
    first += draw.count;
  }
  return text;
}

/// Bytes of an X3D document in X3DB.
struct X3dbSize {
  std::uint64_t plain = 0;    ///< with the number encodings of Fast Infoset
  std::uint64_t deflated = 0; ///< with X3D's own, which deflate
};

/// Writes the nodes as a document and has bench/X3dbSizes.java measure it.
X3dbSize x3dbSizeOf(const std::string& nodes) {
  std::string folder = (std::filesystem::temp_directory_path() / "imgeo-table1-XXXXXX").string();
  if (!mkdtemp(folder.data()))
    throw Error(ErrorKind::io, folder, "cannot be made");
  writeFile(std::filesystem::path(folder) / "mesh.x3d", asBytes("<X3D><Scene>" + nodes + "</Scene></X3D>"));
  const std::string command =
      fmt::format("java -Xmx6g -cp /usr/share/java/FastInfoset.jar bench/X3dbSizes.java {}/mesh.x3d", folder);
  X3dbSize size;
  FILE* output = popen(command.c_str(), "r");
  const int count = output ? std::fscanf(output, "%zu %zu", &size.plain, &size.deflated) : 0;
  if (output)
    pclose(output);
  std::filesystem::remove_all(folder);
  if (count != 2)
    throw Error(ErrorKind::io, "bench/X3dbSizes.java", "failed; it needs packages of scripts/apt-packages-bench.txt");
  return size;
}

struct Measured {
  std::size_t vertices = 0, indices = 0;
  std::string x3d; ///< the nodes of all patches
  X3dbSize x3db;
  std::uint64_t bg = 0;
  std::array<std::uint64_t, 5> sig{};  ///< as PNG, by role
  std::uint64_t webp = 0, smaller = 0; ///< all images as WebP, and each image in the smaller format

  std::uint64_t sigBytes() const {
    std::uint64_t sum = 0;
    for (const std::uint64_t bytes : sig)
      sum += bytes;
    return sum;
  }
};

void add(const IndexedPatch& patch, const PatchedMesh& mesh, const EncodeOptions& options, Measured& sum) {
  sum.vertices += patch.vertexCount();
  sum.indices += patch.indices.size();
  sum.x3d += "<Shape>" + textOf(patch, mesh.lattice) + "</Shape>";
  const GeometryDescription geometry = describe(mesh, options);
  const EncodedPatch encoded = encodePatch(patch, geometry, options);
  const IndexedPatch decoded = decodePatch(encoded, geometry);
  if (decoded.positions != patch.positions || decoded.indices != patch.indices || decoded.draws != patch.draws)
    throw Error(ErrorKind::malformed, "", "what was written reads back as something else");
  for (const EncodedFile& file : encoded.files) {
    sum.sig[static_cast<std::size_t>(file.role)] += file.bytes.size();
    const Image image = decodeImageFile(file.bytes, "image");
    const std::size_t webp = encodeImageFile(image, ImageFormat::webp, options.effort).size();
    sum.webp += webp;
    sum.smaller += std::min(webp, file.bytes.size());
  }
  EncodeOptions typed = options;
  typed.encoding = Encoding::bg;
  for (const EncodedFile& file : encodePatch(patch, describe(mesh, typed), typed).files)
    sum.bg += file.bytes.size();
}

std::array<Measured, 4> measure(const PatchedMesh& mesh, const EncodeOptions& options) {
  std::array<Measured, 4> rows;
  for (const Patch& patch : mesh.patches) {
    const IndexedPatch triangles = asTriangles(patch), strips = asStrips(patch, options.effort);
    add(withoutIndices(triangles), mesh, options, rows[0]);
    add(withoutIndices(strips), mesh, options, rows[1]);
    add(triangles, mesh, options, rows[2]);
    add(strips, mesh, options, rows[3]);
  }
  for (Measured& row : rows)
    row.x3db = x3dbSizeOf(row.x3d);
  return rows;
}

/// Bytes of the files of compact, which orders vertices and triangles itself.
std::uint64_t compactSize(const PatchedMesh& mesh, EncodeOptions options) {
  options.encoding = Encoding::compact;
  options.normals = NormalEncoding::octahedral;
  const GeometryDescription geometry = describe(mesh, options);
  std::uint64_t bytes = 0;
  for (const Patch& patch : mesh.patches)
    for (const EncodedFile& file : encodePatch(patch, geometry, options).files)
      bytes += file.bytes.size();
  return bytes;
}

/// Prints our numbers, and below them the paper's numbers and the ratio.
std::string cell(std::uint64_t ours, const PaperTable* paper, std::size_t row, Column column) {
  if (!paper)
    return grouped(ours);
  const std::uint64_t theirs = paper->rows[row][column];
  return fmt::format("**{}** / {} = {:.3f}", grouped(ours), grouped(theirs),
                     static_cast<double>(ours) / static_cast<double>(theirs));
}

void printTable(const std::array<Measured, 4>& rows, std::uint64_t compact, std::size_t triangles) {
  const PaperTable* paper = nullptr;
  for (const PaperTable& table : paperTables)
    if (table.triangles == triangles)
      paper = &table;
  fmt::print("| mesh | vertices | indices | X3D text | X3DB, not deflated | X3DB | BG | SIG raw | SIG PNG | SIG WebP | "
             "SIG, the smaller of each | compact | BG of 16 and 8 bits |\n"
             "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const Measured& m = rows[row];
    const RawSize raw = rawSize(m.vertices, m.indices);
    fmt::print("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", kinds[row], grouped(m.vertices),
               grouped(m.indices), cell(m.x3d.size(), paper, row, x3d), grouped(m.x3db.plain),
               cell(m.x3db.deflated, paper, row, x3db), cell(raw.bg, paper, row, bg), cell(raw.sig, paper, row, sigRaw),
               cell(m.sigBytes(), paper, row, sigPng), grouped(m.webp), grouped(m.smaller),
               row == indexedTriangles ? grouped(compact) : "", grouped(m.bg));
  }
  fmt::print("\nSIG PNG by role, and its share:\n\n| mesh | index | coord | normal | bytes/triangle |\n"
             "|---|--:|--:|--:|--:|\n");
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const double all = static_cast<double>(rows[row].sigBytes());
    const auto share = [&](Role role) {
      const std::uint64_t bytes = rows[row].sig[static_cast<std::size_t>(role)];
      return fmt::format("{} ({:.1f} %)", grouped(bytes), 100 * static_cast<double>(bytes) / all);
    };
    fmt::print("| {} | {} | {} | {} | {:.3f} |\n", kinds[row], share(Role::index), share(Role::coord),
               share(Role::normal), all / static_cast<double>(triangles));
  }
}

} // namespace
} // namespace imgeo

int main(int count, char** words) {
  using namespace imgeo;
  return bench::run([&] {
    const bench::ModelArguments arguments = bench::modelArguments(count, words, "table1", 9);
    EncodeOptions options;
    options.effort = arguments.effort;
    for (const std::string& model : arguments.models)
      bench::visitSurfaces(model, [&](const Mesh& mesh) {
        const PatchedMesh patched = bench::patchesOf(mesh);
        fmt::print("\n## {}: {} triangles, {} vertices, {} {}\n\n", std::filesystem::path(model).filename().string(),
                   grouped(mesh.elementCount()), grouped(mesh.wedgeCount()), patched.patches.size(),
                   patched.patches.size() == 1 ? "patch" : "patches");
        printTable(measure(patched, options), compactSize(patched, options), mesh.elementCount());
        std::fflush(stdout);
      });
  });
}
