// The effect of lossy video on positions (the paper's section 7.1, "streaming operations with lossy video codecs"): a
// recorded motion in the images of docs/formats/video.md, through VP9, H.264 and MJPEG at several rates, and the same
// motion as sequences of fewer bits. Prints a Markdown table: bytes against the errors of positions.
//
//   build/bench/lossy_video [--write DIRECTORY]
//
// --write writes a PLY of one frame for each row of the picture of docs/sequences.md, and panels.json with its captions
// for bench/lossyPicture.ts.

#include "bench/live_rivals.h"
#include "bench/recorded_motion.h"
#include "export/export.h"
#include "sequence/sequence_file.h"
#include "video/video_image.h"

#include <cmath>
#include <cstdio>

namespace imgeo {
namespace {

constexpr std::uint32_t grid = 128;
/// Pixels that the longest edge of the box has on a screen.
constexpr double screenEdge = 1000;

struct Codec {
  std::string name, extension;
  std::vector<std::string> options;
  bool keepsHighBytes = false; ///< they are in a video of their own, without loss
  std::string panel = {};      ///< the caption of its picture; empty: there is none
};

struct Errors {
  double sum = 0, maximum = 0; ///< metres
  std::size_t count = 0;
  std::vector<Vec3d> picture; ///< the positions of one frame

  void add(const Vec3d& decoded, const Vec3d& exact) {
    const double error = length(decoded - exact);
    sum += error;
    maximum = std::max(maximum, error);
    ++count;
  }
};

constexpr std::size_t pictureFrame = 20;

Vec3d positionOf(const live::Frame& frame, std::size_t vertex, const live::Description& description) {
  const Vec3d stored{double(frame.component(0)[vertex]), double(frame.component(1)[vertex]),
                     double(frame.component(2)[vertex])};
  return description.origin() + stored * description.step();
}

/// RGB images of width `grid` through ffmpeg and back. Returns the bytes of the file.
std::uintmax_t recode(Bytes& pixels, std::uint32_t height, const std::vector<std::string>& options,
                      const std::string& extension, const std::filesystem::path& folder) {
  const std::filesystem::path raw = folder / "in.rgb", video = folder / ("video." + extension),
                              back = folder / "out.rgb";
  writeFile(raw, pixels);
  std::vector<std::string> words = videoInput(raw, grid, height);
  words.insert(words.end(), {"-g", "30"});
  words.insert(words.end(), options.begin(), options.end());
  words.push_back(video);
  runOnce(words);
  runOnce({"ffmpeg", "-loglevel", "error", "-nostdin", "-y", "-i", video, "-f", "rawvideo", "-pix_fmt", "rgb24", back});
  pixels = readFile(back);
  return std::filesystem::file_size(video);
}

/// The planes of all frames: high bytes above low ones, or one of both alone.
Bytes planesOf(const std::vector<live::Frame>& frames, std::size_t first, std::size_t count) {
  Bytes pixels;
  constexpr std::size_t plane = std::size_t{3} * grid * grid;
  for (const live::Frame& frame : frames) {
    const Bytes image = videoImageOf(frame, {grid, 2 * grid + 1});
    const auto begin = image.begin() + static_cast<std::ptrdiff_t>(first * plane);
    pixels.insert(pixels.end(), begin, begin + static_cast<std::ptrdiff_t>(count * plane));
  }
  return pixels;
}

Errors errorsOf(const std::vector<live::Frame>& frames, const live::Description& description, const Bytes& high,
                const Bytes& low, std::size_t stride) {
  Errors errors;
  for (std::size_t n = 0; n < frames.size(); ++n)
    for (std::size_t i = 0; i < frames[n].layout.vertices; ++i) {
      const std::size_t at = n * stride + 3 * i;
      Vec3d stored;
      for (int axis = 0; axis < 3; ++axis)
        stored[axis] = high.at(at + std::size_t(axis)) * 256.0 + low.at(at + std::size_t(axis));
      const Vec3d decoded = description.origin() + stored * description.step();
      errors.add(decoded, positionOf(frames[n], i, description));
      if (n == pictureFrame)
        errors.picture.push_back(decoded);
    }
  return errors;
}

struct Row {
  double bytes = 0; ///< of a frame
  Errors errors;
};

Row lossyRow(const Codec& codec, const std::vector<live::Frame>& frames, const live::Description& description,
             const std::filesystem::path& folder) {
  constexpr std::size_t plane = std::size_t{3} * grid * grid;
  std::uintmax_t bytes = 0;
  Row row;
  if (codec.keepsHighBytes) {
    Bytes high = planesOf(frames, 0, 1), low = planesOf(frames, 1, 1);
    bytes = recode(high, grid, {"-c:v", "libvpx-vp9", "-lossless", "1", "-pix_fmt", "gbrp"}, "webm", folder);
    bytes += recode(low, grid, codec.options, codec.extension, folder);
    row.errors = errorsOf(frames, description, high, low, plane);
  } else {
    Bytes both = planesOf(frames, 0, 2);
    bytes = recode(both, 2 * grid, codec.options, codec.extension, folder);
    const Bytes low(both.begin() + static_cast<std::ptrdiff_t>(plane), both.end());
    Bytes padded = low;
    padded.resize(both.size());
    row.errors = errorsOf(frames, description, both, padded, 2 * plane);
  }
  row.bytes = static_cast<double>(bytes) / perFile;
  return row;
}

/// The sequence with fewer bits: what imgeo offers instead.
Row sequenceRow(Motion& motion, std::uint32_t bits, const std::vector<live::Frame>& exact,
                const live::Description& description) {
  live::Description coarse = description;
  coarse.layout.positionBits = bits;
  const std::vector<live::Frame> frames = framesOf(motion, coarse);
  Row row;
  row.bytes = static_cast<double>(encodeSequenceFile(frames, 5).size()) / perFile;
  for (std::size_t n = 0; n < frames.size(); ++n)
    for (std::size_t i = 0; i < frames[n].layout.vertices; ++i) {
      const Vec3d decoded = positionOf(frames[n], i, coarse);
      row.errors.add(decoded, positionOf(exact[n], i, description));
      if (n == pictureFrame)
        row.errors.picture.push_back(decoded);
    }
  return row;
}

void writePicture(const std::vector<Vec3d>& positions, const std::filesystem::path& file) {
  Scene scene;
  Mesh mesh;
  for (std::uint32_t i = 0; i < positions.size(); ++i) {
    mesh.positions.push_back(Vec3f(positions[i]));
    mesh.wedgePositions.push_back(i);
  }
  for (std::uint32_t y = 0; y + 1 < grid; ++y)
    for (std::uint32_t x = 0; x + 1 < grid; ++x) {
      const std::uint32_t a = y * grid + x, b = a + 1, c = a + grid, d = c + 1;
      mesh.corners.insert(mesh.corners.end(), {a, c, b, b, c, d});
    }
  scene.meshes.push_back(std::move(mesh));
  addRoot(scene.graph, {"motion", Shape{}, {}, ""});
  writeFile(file, exportScene(scene, MeshFormat::ply));
}

std::vector<Codec> codecs() {
  std::vector<Codec> all;
  const auto vp9 = [](int quality) -> std::vector<std::string> {
    return {"-c:v", "libvpx-vp9", "-crf", std::to_string(quality), "-b:v", "0", "-cpu-used", "4", "-pix_fmt", "gbrp"};
  };
  const auto h264 = [](int quality) -> std::vector<std::string> {
    return {"-c:v", "libx264rgb", "-crf", std::to_string(quality), "-preset", "medium"};
  };
  const auto mjpeg = [](int quality) -> std::vector<std::string> {
    return {"-c:v", "mjpeg", "-q:v", std::to_string(quality), "-pix_fmt", "yuvj444p"};
  };
  for (const int quality : {4, 15, 30, 45})
    all.push_back({fmt::format("VP9, crf {}", quality), "webm", vp9(quality), false,
                   quality == 4 || quality == 30 ? fmt::format("VP9, crf {}", quality) : ""});
  for (const int quality : {1, 10, 20, 30})
    all.push_back(
        {fmt::format("H.264, crf {}", quality), "mkv", h264(quality), false, quality == 10 ? "H.264, crf 10" : ""});
  for (const int quality : {1, 4})
    all.push_back({fmt::format("MJPEG, q {}", quality), "mkv", mjpeg(quality), false, ""});
  for (const int quality : {15, 45})
    all.push_back({fmt::format("high bytes lossless, low bytes VP9, crf {}", quality), "webm", vp9(quality), true,
                   quality == 45 ? "low bytes VP9, crf 45" : ""});
  return all;
}

class Table {
public:
  Table(const std::filesystem::path& directory, double longestEdge) : directory_(directory), edge_(longestEdge) {
    fmt::print("| positions | bytes a frame | error, mean | error, max | on a screen, mean | max |\n"
               "|---|--:|--:|--:|--:|--:|\n");
  }

  void print(const std::string& name, const Row& row, const std::string& panel) {
    const double mean = row.errors.sum / static_cast<double>(row.errors.count);
    fmt::print("| {} | {:.0f} | {:.3f} mm | {:.3f} mm | {:.2f} px | {:.1f} px |\n", name, row.bytes, 1000 * mean,
               1000 * row.errors.maximum, screenEdge * mean / edge_, screenEdge * row.errors.maximum / edge_);
    std::fflush(stdout);
    if (panel.empty() || directory_.empty())
      return;
    const std::string file = fmt::format("cloth-{}", panels_.size());
    writePicture(row.errors.picture, directory_ / (file + ".ply"));
    panels_.push_back(fmt::format(R"({{"file": "{}", "caption": "{}: {:.0f} bytes"}})", file, panel, row.bytes));
  }

  void finish() const {
    if (!directory_.empty())
      writeFile(directory_ / "panels.json", asBytes(fmt::format("[{}]\n", fmt::join(panels_, ",\n"))));
  }

private:
  std::filesystem::path directory_;
  double edge_;
  std::vector<std::string> panels_;
};

void measure(const std::filesystem::path& directory) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / fmt::format("imgeo-lossy-video-{}", getpid());
  std::filesystem::create_directories(folder);
  const auto motion = makeMotion("cloth", grid, 1);
  const live::Description description = describe(*motion);
  const std::vector<live::Frame> frames = framesOf(*motion, description);
  fmt::print("cloth {} x {}, box of {:.2f} m; {:.0f} pixels for its longest edge\n\n", grid, grid,
             description.box.longestEdge(), screenEdge);
  Table table(directory, description.box.longestEdge());
  for (const std::uint32_t bits : {16u, 14u, 12u, 10u}) {
    const auto again = makeMotion("cloth", grid, 1);
    table.print(fmt::format("sequence, {} bits", bits), sequenceRow(*again, bits, frames, description),
                bits == 16 || bits == 12 ? fmt::format("sequence, {} bits", bits) : "");
  }
  const Codec lossless{"VP9, lossless", "webm", {"-c:v", "libvpx-vp9", "-lossless", "1", "-pix_fmt", "gbrp"}};
  table.print(lossless.name, lossyRow(lossless, frames, description, folder), "");
  for (const Codec& codec : codecs())
    table.print(codec.name, lossyRow(codec, frames, description, folder), codec.panel);
  table.finish();
  std::filesystem::remove_all(folder);
}

} // namespace
} // namespace imgeo

int main(int argc, char** argv) {
  const bool writes = argc == 3 && std::string_view(argv[1]) == "--write";
  if (argc > 1 && !writes) {
    fmt::print(stderr, "usage: lossy_video [--write DIRECTORY]\n");
    return 1;
  }
  imgeo::measure(writes ? argv[2] : "");
}
