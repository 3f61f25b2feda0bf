// Bytes by role of compact sites at the maximum effort, compared with Draco and gltfpack with brotli on the same welded
// mesh with the same normals and the same precision. Every site is verified against its input before it is counted.
// Then bytes and times of the images of sites of both profiles as PNG and as lossless WebP, also at the maximum effort,
// and bytes of classic's normals by encoding and precision, at the default effort. Prints Markdown tables.
//
//   build/bench/size MODEL...        (in the repository's root, with draco_encoder installed)

#include "base/file.h"
#include "bench/process.h"
#include "containers/compact/header.h"
#include "containers/compact/payload_image.h"
#include "containers/image_file.h"
#include "imgeo/site.h"

#include <array>
#include <brotli/encode.h>
#include <ctime>
#include <map>
#include <nlohmann/json.hpp>

namespace imgeo {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr int maxEffort = 9;

/// The kinds of streams in compact files, as columns of the table.
constexpr std::array roles{"sizes",   "connectivity", "parts",  "positions", "seams",
                           "normals", "texCoords",    "colors", "other"};

struct Site {
  std::map<std::string, std::uint64_t> streams;
  std::uint64_t files = 0;     ///< geometry files, without the base mesh
  std::uint64_t withNodes = 0; ///< geometry files and geometry nodes
  std::size_t triangles = 0;
};

/// Size of each stream of a file of patches.
void addStreams(const fs::path& file, Site& site) {
  const Bytes png = readFile(file), payload = compact::payloadOfImage(png, file);
  const compact::FileHeader header = compact::readHeader(payload, file).header;
  constexpr std::size_t attributes = 5; // index of the first attribute in `roles`
  for (std::size_t i = 0; i < header.streamLengths.size(); ++i) {
    const std::size_t role =
        i < attributes ? i : attributes + static_cast<std::size_t>(header.attributes[i - attributes].kind);
    site.streams[roles.at(role)] += header.streamLengths[i];
  }
  site.files += png.size();
}

Site measureSite(const std::string& model, int bits, const fs::path& work) {
  const std::string directory = work / "site", report = work / "report.json";
  runOnce({"build/imgeo", "convert", model, "-o", directory, "--profile", "compact", "--base", "0", "--effort",
           std::to_string(maxEffort), "-vp", std::to_string(bits), "-vn", "8", "-r", report});
  runOnce({"build/imgeo", "verify", directory, model});
  const Json json = Json::parse(asText(readFile(report)));
  Site site;
  site.triangles = json["triangles"];
  for (const auto& entry : fs::directory_iterator(fs::path(directory) / "geometry"))
    addStreams(entry.path(), site);
  site.withNodes =
      static_cast<std::uint64_t>(json["bytesPerTriangle"].get<double>() * static_cast<double>(site.triangles) + 0.5);
  return site;
}

std::uint64_t measureDraco(const fs::path& mesh, int bits, const fs::path& work) {
  const std::string out = work / "mesh.drc";
  runOnce({"draco_encoder", "-i", mesh, "-o", out, "-cl", "10", "-qp", std::to_string(bits), "-qn", "8", "-qt", "12"});
  return fs::file_size(out);
}

std::uint64_t brotliSize(const Bytes& bytes) {
  Bytes out(BrotliEncoderMaxCompressedSize(bytes.size()));
  std::size_t size = out.size();
  if (!BrotliEncoderCompress(11, 24, BROTLI_MODE_GENERIC, bytes.size(), bytes.data(), &size, out.data()))
    std::exit(1);
  return size;
}

std::uint64_t measureGltfpack(const fs::path& mesh, int bits, const fs::path& work) {
  const fs::path out = work / "packed.glb";
  runOnce({"node", "node_modules/gltfpack/cli.js", "-i", mesh, "-o", out, "-cz", "-vp", std::to_string(bits), "-vn",
           "8", "-vt", "12", "-kv"});
  return brotliSize(readFile(out));
}

/// Prints a row for each precision. Returns a row for the summary, with the numbers of the maximum precision.
std::string printModel(const std::string& model, const fs::path& work) {
  std::string summary;
  // Draco reads texture coordinates from OBJ files only.
  const fs::path obj = work / "mesh.obj", glb = work / "mesh.glb";
  writePrepared(model, obj, MeshFormat::obj);
  writePrepared(model, glb, MeshFormat::glb);
  for (const int bits : {16, 14, 12}) {
    Site site = measureSite(model, bits, work);
    const std::uint64_t draco = measureDraco(obj, bits, work), gltfpack = measureGltfpack(glb, bits, work);
    fmt::print("| {} | {} | {}", fs::path(model).filename().string(), site.triangles, bits);
    for (const char* role : roles)
      fmt::print(" | {}", site.streams[role]);
    const auto ratio = [&](std::uint64_t other) {
      return static_cast<double>(site.withNodes) / static_cast<double>(other);
    };
    fmt::print(" | {} | **{}** | {} | **{:.3f}** | {} | {:.3f} |\n", site.files, site.withNodes, draco, ratio(draco),
               gltfpack, ratio(gltfpack));
    std::fflush(stdout);
    if (summary.empty())
      summary = fmt::format("| {} | **{}** | {} | {:.2f} | {} |\n", fs::path(model).stem().string(), site.withNodes,
                            draco, ratio(draco), gltfpack);
  }
  return summary;
}

/// Seconds of processor time of this thread that a function takes.
template <typename Function> double processorSeconds(Function function) {
  const auto now = [] {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) / 1e9;
  };
  const double start = now();
  function();
  return now() - start;
}

/// Bytes of images in a format, and the processor time of one thread.
struct ImageCost {
  std::uint64_t bytes = 0;
  double encode = 0, decode = 0; ///< seconds

  ImageCost& operator+=(const ImageCost& other) {
    bytes += other.bytes;
    encode += other.encode;
    decode += other.decode;
    return *this;
  }
};

ImageCost costOf(const Image& image, ImageFormat format) {
  Bytes file;
  ImageCost cost;
  cost.encode = processorSeconds([&] { file = encodeImageFile(image, format, maxEffort); });
  cost.decode = processorSeconds([&] { (void)decodeImageFile(file, "image"); });
  cost.bytes = file.size();
  return cost;
}

/// Images in both formats.
struct FormatCosts {
  ImageCost png, webp;
  std::uint64_t smaller = 0; ///< bytes with each image in its smaller format

  FormatCosts& operator+=(const FormatCosts& other) {
    png += other.png;
    webp += other.webp;
    smaller += other.smaller;
    return *this;
  }
};

void printFormats(const std::string& model, const char* profile, const std::string& role, const FormatCosts& costs) {
  const auto& [png, webp, smaller] = costs;
  const auto ratioTo = [&](std::uint64_t bytes) { return static_cast<double>(bytes) / static_cast<double>(png.bytes); };
  fmt::print("| {} | {} | {} | {} | {} ({:.2f}) | {} ({:.2f}) | {:.2f} / {:.2f} | {:.1f} / {:.1f} |\n",
             fs::path(model).stem().string(), profile, role, png.bytes, webp.bytes, ratioTo(webp.bytes), smaller,
             ratioTo(smaller), png.encode, webp.encode, 1000 * png.decode, 1000 * webp.decode);
}

/// Prints a row for each role of a site's images, and one for all of them.
void printImageFormats(const std::string& model, const char* profile, const fs::path& work) {
  const fs::path site = work / profile;
  runOnce({"build/imgeo", "convert", model, "-o", site, "--profile", profile, "--no-pictures"});
  std::map<std::string, FormatCosts> roles;
  for (const SiteFile& file : inspect(site).files) {
    if (!file.path.starts_with("geometry/"))
      continue;
    const Image image = decodeImageFile(readFile(site / file.path), file.path);
    FormatCosts costs{costOf(image, ImageFormat::png), costOf(image, ImageFormat::webp)};
    costs.smaller = std::min(costs.png.bytes, costs.webp.bytes);
    roles[file.role] += costs;
  }
  FormatCosts all;
  for (const auto& [role, costs] : roles) {
    printFormats(model, profile, role, costs);
    all += costs;
  }
  printFormats(model, profile, "**all**", all);
  std::fflush(stdout);
}

/// Prints the bytes of a classic site's normals in one encoding and precision.
void printNormals(const std::string& model, const char* normals, const char* bits, const fs::path& work) {
  const std::string site = work / "classic", report = work / "classic.json";
  runOnce({"build/imgeo", "convert", model, "-o", site, "--profile", "classic", "--normals", normals, "-vn", bits,
           "--no-pictures", "-r", report});
  runOnce({"build/imgeo", "verify", site, model});
  const Json json = Json::parse(asText(readFile(report)));
  for (const Json& role : json["roles"])
    if (role["role"] == "normal")
      fmt::print("| {} | {} | {} | {} | {:.4f} |\n", fs::path(model).stem().string(), normals, bits,
                 role["bytes"].get<std::uint64_t>(), json["normalErrorDegrees"].get<double>());
  std::fflush(stdout);
}

void printImages(const std::vector<std::string>& models, const fs::path& work) {
  fmt::print("\n| model | profile | images | PNG | WebP | the smaller of each | encode, s: PNG / WebP "
             "| decode, ms: PNG / WebP |\n|---|---|---|--:|--:|--:|--:|--:|\n");
  for (const std::string& model : models)
    for (const char* profile : {"classic", "compact"})
      printImageFormats(model, profile, work);
  fmt::print("\nEffort {}; processor time of one thread, by libdeflate and libwebp.\n\n", maxEffort);
}

void printClassicNormals(const std::vector<std::string>& models, const fs::path& work) {
  fmt::print("| model | classic's normals | bits | bytes | largest error, degrees |\n|---|---|--:|--:|--:|\n");
  for (const std::string& model : models)
    for (const char* normals : {"rgb", "octahedral", "spherical"})
      for (const char* bits : {"8", "16"})
        printNormals(model, normals, bits, work);
}

void benchmark(const std::vector<std::string>& models, const fs::path& work) {
  fmt::print("| model | triangles | bits | {} | files | with nodes | Draco | ratio | gltfpack + brotli | ratio |\n"
             "|---|--:|--:|{}--:|--:|--:|--:|--:|--:|\n",
             fmt::join(roles, " | "), fmt::join(std::vector<std::string>(roles.size(), "--:|"), ""));
  std::string summary = "| model | SIG compact | Draco `-cl 10` | ratio | gltfpack `-cz` + brotli-11 |\n"
                        "|---|--:|--:|--:|--:|\n";
  for (const std::string& model : models)
    summary += printModel(model, work);
  fmt::print("\ndraco_encoder -cl 10 -qn 8 -qt 12; gltfpack -cz -vn 8 -vt 12 -kv, then brotli 11.\n\n{}", summary);
  printImages(models, work);
  printClassicNormals(models, work);
}

} // namespace
} // namespace imgeo

int main(int count, char** words) {
  return imgeo::runInFolder(count, words, "size", imgeo::benchmark);
}
