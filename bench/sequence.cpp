// Bytes and times of the frames of a recorded sequence beside other codings of the same integers: frames that all stand
// alone, images (PNG, MPNG, lossless WebP) and lossless video (VP9, H.264, AV1), for three motions on grids of three
// sizes. Prints a Markdown table. Usage: build/bench/sequence (no model is read).

#include "base/file.h"
#include "bench/live_rivals.h"
#include "bench/recorded_motion.h"
#include "containers/webp/webp.h"
#include "images/encode_image.h"
#include "live/frame_image.h"
#include "sequence/sequence_file.h"

#include <cstdio>

namespace {

using namespace imgeo;

struct Row {
  std::string coding;
  double bytes = 0, decodeMs = 0, seekMs = 0; ///< of a frame; seeks: the mean over all frames of a file
  bool isExact = false;
};

Row sequenceRow(const std::vector<live::Frame>& frames, const live::Description& description) {
  const Bytes bytes = encodeSequenceFile(frames, 5);
  const SequenceIndex index{description, {{"a.igf", perFile, bytes.size()}}};
  Row row{"sequence", static_cast<double>(bytes.size()) / perFile, 0, 0, true};
  const double start = threadMilliseconds();
  decodeSequenceFile(bytes, index, 0, "",
                     [&](const live::Frame& frame) { row.isExact &= frame == frames[frame.number]; });
  row.decodeMs = (threadMilliseconds() - start) / perFile;
  const double before = threadMilliseconds();
  for (std::uint32_t target = 1; target <= perFile; ++target)
    decodeSequenceFile(
        bytes, index, 0, "", [](const live::Frame&) {}, target);
  row.seekMs = (threadMilliseconds() - before) / perFile;
  return row;
}

/// A coding in which each frame stands alone.
template <typename Encode, typename Decode>
Row aloneRow(const std::string& coding, const std::vector<live::Frame>& frames, const Encode& encode,
             const Decode& decodesExactly) {
  Row row{coding, 0, 0, 0, true};
  for (const live::Frame& frame : frames) {
    const Bytes bytes = encode(frame);
    row.bytes += static_cast<double>(bytes.size()) / perFile;
    const double start = threadMilliseconds();
    row.isExact &= decodesExactly(bytes, frame);
    row.decodeMs += (threadMilliseconds() - start) / perFile;
  }
  row.seekMs = row.decodeMs;
  return row;
}

/// Whether an image of three or four channels has the colours of one of three.
bool hasColors(const Image& image, const Image& expected) {
  for (std::size_t i = 0; i < expected.pixels.size(); ++i)
    if (image.pixels[i / 3 * image.channels + i % 3] != expected.pixels[i])
      return false;
  return true;
}

/// An image as a server of images sends it (the paper's MPNG): the fastest PNG, with the head of its part.
Bytes partOf(const Bytes& png) {
  const std::string head = fmt::format("--frame\r\nContent-Type: image/png\r\nContent-Length: {}\r\n\r\n", png.size());
  Bytes part(head.begin(), head.end());
  part.insert(part.end(), png.begin(), png.end());
  return part;
}

struct Codec {
  std::string name, extension;
  std::vector<std::string> options;
};

/// A lossless video with a key frame each second, by ffmpeg; nothing without it. Times are those of its processes.
std::optional<Row> videoRow(const Codec& codec, const std::vector<Image>& images, const std::filesystem::path& folder) {
  if (std::system("command -v ffmpeg >/dev/null") != 0)
    return {};
  const std::filesystem::path raw = folder / "in.rgb", video = folder / ("video." + codec.extension),
                              back = folder / "out.rgb";
  Bytes pixels;
  for (const Image& image : images)
    pixels.insert(pixels.end(), image.pixels.begin(), image.pixels.end());
  writeFile(raw, pixels);
  std::vector<std::string> words = videoInput(raw, images[0].width, images[0].height);
  words.insert(words.end(), {"-g", "30"});
  words.insert(words.end(), codec.options.begin(), codec.options.end());
  words.push_back(video);
  runOnce(words);
  const Run whole = runOnce(
      {"ffmpeg", "-loglevel", "error", "-nostdin", "-y", "-i", video, "-f", "rawvideo", "-pix_fmt", "rgb24", back});
  // What the program itself takes: a single frame.
  const Run one =
      runOnce({"ffmpeg", "-loglevel", "error", "-nostdin", "-y", "-i", video, "-frames:v", "1", "-f", "null", "-"});
  Row row{codec.name, static_cast<double>(std::filesystem::file_size(video)) / perFile};
  row.isExact = readFile(back) == pixels;
  row.decodeMs = 1e3 * std::max(0.0, whole.processorSeconds - one.processorSeconds) / (perFile - 1);
  row.seekMs = row.decodeMs * (perFile + 1) / 2;
  return row;
}

void print(const std::string& motion, const Row& row, double bytesOfSequence) {
  fmt::print("| {} | {} | {:.0f} | {:.2f} | {} | {:.2f} | {:.1f} |\n", motion, row.coding, row.bytes,
             row.bytes / bytesOfSequence, row.isExact ? "yes" : "no", row.decodeMs, row.seekMs);
  std::fflush(stdout);
}

void measure(const std::string& name, Motion& motion, const std::filesystem::path& folder) {
  const live::Description description = describe(motion);
  const std::vector<live::Frame> frames = framesOf(motion, description);
  const Row sequence = sequenceRow(frames, description);
  print(name, sequence, sequence.bytes);
  print(name,
        aloneRow(
            "frames alone", frames,
            [](const live::Frame& frame) { return live::encodeFrame(frame, live::choosePrediction(frame), 5); },
            [](const Bytes& bytes, const live::Frame& frame) { return live::decodeFrame(bytes, "") == frame; }),
        sequence.bytes);
  std::vector<Image> images;
  for (const live::Frame& frame : frames)
    images.push_back(decodePng(live::imageOfFrame(live::encodeFrame(frame), ""), ""));
  const auto imageAt = [&](const live::Frame& frame) -> const Image& { return images[frame.number]; };
  print(name,
        aloneRow(
            "PNG", frames, [&](const live::Frame& frame) { return encodePng(imageAt(frame), 5); },
            [&](const Bytes& bytes, const live::Frame& frame) {
              return decodePng(bytes, "").pixels == imageAt(frame).pixels;
            }),
        sequence.bytes);
  print(name,
        aloneRow(
            "MPNG", frames, [&](const live::Frame& frame) { return partOf(encodePng(imageAt(frame), 0)); },
            [&](const Bytes& bytes, const live::Frame& frame) {
              const std::size_t head = asText(bytes).find("\x89PNG");
              return decodePng(ByteSpan(bytes).subspan(head), "").pixels == imageAt(frame).pixels;
            }),
        sequence.bytes);
  print(name,
        aloneRow(
            "WebP", frames, [&](const live::Frame& frame) { return encodeLosslessWebp(rasterOf(imageAt(frame))); },
            [&](const Bytes& bytes, const live::Frame& frame) {
              return hasColors(decodeWebp(bytes, ""), imageAt(frame));
            }),
        sequence.bytes);
  for (const Codec& codec :
       {Codec{"VP9", "webm", {"-c:v", "libvpx-vp9", "-lossless", "1", "-deadline", "good", "-cpu-used", "4"}},
        Codec{"H.264", "mkv", {"-c:v", "libx264rgb", "-qp", "0", "-preset", "medium", "-pix_fmt", "rgb24"}},
        Codec{"AV1", "mkv", {"-c:v", "libaom-av1", "-usage", "good", "-cpu-used", "6", "-aom-params", "lossless=1"}}})
    if (const std::optional<Row> row = videoRow(codec, images, folder))
      print(name, *row, sequence.bytes);
}

} // namespace

int main() {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / fmt::format("imgeo-sequence-{}", getpid());
  std::filesystem::create_directories(folder);
  fmt::print("| motion | coding | bytes a frame | of the sequence's | exact | decode, ms | seek, ms |\n"
             "|---|---|--:|--:|---|--:|--:|\n");
  for (const std::uint32_t grid : {64u, 128u, 256u})
    for (const char* name : {"cloth", "water", "turntable"})
      measure(fmt::format("{} {} x {}", name, grid, grid), *makeMotion(name, grid, 1), folder);
  std::filesystem::remove_all(folder);
}
