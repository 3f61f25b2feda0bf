// Bytes and times of live frames beside other codings of the same integers, for motions of different kinds: images
// (PNG as stream.mpng has it, and at effort 5; lossless WebP), lossless video (VP9), and predictions that frames do not
// have. Prints a Markdown table. Usage: build/bench/live MODEL...: the first model, encoded and decoded again, is bent.

#include "base/file.h"
#include "bench/live_motions.h"
#include "bench/live_rivals.h"
#include "images/encode_image.h"
#include "live/frame_image.h"
#include "live/quantise.h"

namespace {

using namespace imgeo;

constexpr double interval = 1.0 / 30;

/// Adds the milliseconds that a call takes.
template <typename Call> auto timed(double& milliseconds, const Call& call) {
  const double start = threadMilliseconds();
  auto result = call();
  milliseconds += threadMilliseconds() - start;
  return result;
}

live::Frame frameOf(const Motion& motion, const live::Description& description) {
  live::Frame frame;
  const live::Arrays arrays{{&motion.positions().front().x, 3 * motion.positions().size()}, {}, {}, {}};
  live::quantise(arrays, description, frame);
  return frame;
}

void measure(const std::string& name, Motion& motion, std::size_t frames, const std::filesystem::path& folder) {
  live::Description description;
  description.layout.vertices = static_cast<std::uint32_t>(motion.positions().size());
  description.layout.columns = motion.columns();
  description.box = motion.box();
  const auto* mesh = dynamic_cast<const MeshMotion*>(&motion);
  const auto parallelograms =
      mesh ? parallelogramsOf(mesh->indices(), description.layout.vertices) : std::vector<Parallelogram>();
  const char* predictions[] = {"none", "previous", "linear", "planar"};
  double quantiseMs = 0, encodeMs = 0, decodeMs = 0, pngMs = 0, webpMs = 0;
  std::uint64_t bytes = 0, pngBytes = 0, smallPngBytes = 0, webpBytes = 0, meshBytes = 0, timeBytes = 0, keyBytes = 0;
  live::Prediction prediction{};
  std::vector<Bytes> images;
  live::Frame before = frameOf(motion, description), key;
  for (std::size_t i = 0; i < frames; ++i) {
    motion.advance(interval);
    const live::Frame frame = timed(quantiseMs, [&] { return frameOf(motion, description); });
    prediction = live::choosePrediction(frame);
    const Bytes encoded = timed(encodeMs, [&] { return encodeFrame(frame); });
    if (timed(decodeMs, [&] { return live::decodeFrame(encoded, ""); }) != frame) {
      fmt::print(stderr, "{}: a frame is not the same after decoding\n", name);
      std::exit(1);
    }
    bytes += encoded.size();
    if (mesh)
      meshBytes += bytesAlongTriangles(frame, parallelograms);
    // A key frame each second.
    if (i % 30 == 0)
      key = frame;
    keyBytes += i % 30 == 0 ? encoded.size() : std::min(bytesAfter(frame, key), encoded.size());
    timeBytes += i % 30 == 0 ? encoded.size() : std::min(bytesAfter(frame, before), encoded.size());
    images.push_back(timed(pngMs, [&] { return live::imageOfFrame(encoded, ""); }));
    pngBytes += images.back().size();
    const Image image = decodePng(images.back(), "");
    smallPngBytes += encodePng(image, 5).size();
    const Raster raster = rasterOf(image);
    webpBytes += timed(webpMs, [&] { return encodeLosslessWebp(raster); }).size();
    before = frame;
  }
  const auto video = encodeVideo(images, folder);
  const auto count = static_cast<double>(frames);
  const auto ratio = [&](double other) {
    return other > 0 ? fmt::format("{:.2f}", static_cast<double>(bytes) / other) : "–";
  };
  fmt::print(
      "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.1f} | {:.0f} | {} "
      "|\n",
      name, description.layout.vertices, predictions[static_cast<std::size_t>(prediction)], bytes / frames,
      ratio(6 * count * description.layout.vertices), ratio(static_cast<double>(pngBytes)),
      ratio(static_cast<double>(smallPngBytes)), ratio(static_cast<double>(webpBytes)),
      ratio(video ? count * video->bytes : 0),
      mesh ? fmt::format("{:.2f}", static_cast<double>(meshBytes) / static_cast<double>(bytes)) : "–",
      fmt::format("{:.2f}", static_cast<double>(timeBytes) / static_cast<double>(bytes)),
      fmt::format("{:.2f}", static_cast<double>(keyBytes) / static_cast<double>(bytes)), quantiseMs / count,
      encodeMs / count, decodeMs / count, pngMs / count, webpMs / count,
      video ? fmt::format("{:.1f} / {:.1f}", video->encodeMs, video->decodeMs) : "–");
  std::fflush(stdout);
}

} // namespace

int main(int count, char** words) {
  return runInFolder(count, words, "live", [](const std::vector<std::string>& models, const auto& folder) {
    fmt::print(
        "| motion | vertices | prediction | bytes | of raw | of PNG, fast | of PNG, effort 5 | of WebP | of VP9 | "
        "along triangles | from the frame before | from a key frame | quantise, ms | encode, ms | decode, ms | PNG, ms "
        "| WebP, ms "
        "| VP9, encode / decode, ms "
        "|\n|---|--:|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
    for (const std::uint32_t grid : {64u, 128u, 256u})
      measure(fmt::format("cloth {} x {}", grid, grid), *makeCloth(grid, 1), grid > 128 ? 30 : 60, folder);
    measure("water 128 x 128", *makeWater(128, 1), 60, folder);
    measure("turning scanner", *makeTurntable(128, 1), 60, folder);
    Walker walker;
    measure("walking figure", walker, 60, folder);
    Noise noise(128);
    measure("noise", noise, 20, folder);
    measure("bent model", *makeBending(models.front(), folder), 5, folder);
  });
}
