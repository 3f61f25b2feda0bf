// Bytes and times of live frames beside images of the same integers, for motions of different kinds. Prints a Markdown
// table. Usage: build/bench/live MODEL...: the first model, encoded and decoded again, is bent for the last row.

#include "base/file.h"
#include "bench/process.h"
#include "containers/png/png.h"
#include "images/encode_image.h"
#include "imgeo/convert.h"
#include "imgeo/site.h"
#include "live/frame.h"
#include "live/frame_image.h"
#include "live/quantise.h"
#include "motions/motion.h"
#include "motions/random.h"

#include <ctime>
#include <fmt/format.h>

namespace {

using namespace imgeo;

/// Positions without any order.
class Noise final : public Motion {
public:
  explicit Noise(std::uint32_t grid) : random_(1) {
    columns_ = grid;
    positions_.resize(std::size_t{grid} * grid);
    box_.add({-1, -1, -1});
    box_.add({1, 1, 1});
    advance(1);
  }
  void advance(double) override {
    for (Vec3f& position : positions_)
      position = {2 * random_.unit() - 1, 2 * random_.unit() - 1, 2 * random_.unit() - 1};
  }

private:
  Random random_;
};

/// A mesh whose vertices keep their order and turn about the y axis, the more the higher they are.
class Bending final : public Motion {
public:
  explicit Bending(std::vector<Vec3f> rest) : rest_(std::move(rest)) {
    positions_ = rest_;
    Box3d box;
    for (const Vec3f position : rest_)
      box.add(Vec3d(position));
    center_ = Vec3f(box.center());
    const double radius = box.longestEdge();
    box_.add(box.center() + Vec3d{-radius, -radius, -radius});
    box_.add(box.center() + Vec3d{radius, radius, radius});
    size_ = static_cast<float>(radius);
  }
  void advance(double seconds) override {
    time_ += static_cast<float>(seconds);
    for (std::size_t i = 0; i < rest_.size(); ++i) {
      const Vec3f p = rest_[i] - center_;
      const float angle = 0.8F * std::sin(2 * time_ + 3 * p.y / size_);
      positions_[i] = center_ + Vec3f{p.x * std::cos(angle) - p.z * std::sin(angle), p.y,
                                      p.x * std::sin(angle) + p.z * std::cos(angle)};
    }
  }

private:
  std::vector<Vec3f> rest_;
  Vec3f center_;
  float size_ = 1, time_ = 0;
};

/// The vertices of a model in the order in which imgeo encodes them.
std::unique_ptr<Motion> makeBending(const std::string& model, const std::filesystem::path& folder) {
  ConvertOptions options;
  options.pictures = false;
  options.encoding = Encoding::compact;
  convert(model, folder / "site", options);
  std::vector<Vec3f> positions;
  for (const SiteMesh& mesh : readSiteMeshes(folder / "site").meshes)
    for (const auto& position : mesh.positions)
      positions.push_back(
          {static_cast<float>(position[0]), static_cast<float>(position[1]), static_cast<float>(position[2])});
  return std::make_unique<Bending>(std::move(positions));
}

/// Milliseconds of this thread on a processor.
double threadMilliseconds() {
  struct timespec time {};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

/// Adds the milliseconds that a call takes.
template <typename Call> auto timed(double& milliseconds, const Call& call) {
  const double start = threadMilliseconds();
  auto result = call();
  milliseconds += threadMilliseconds() - start;
  return result;
}

Raster rasterOf(const Image& image) {
  Raster raster;
  raster.width = image.width;
  raster.height = image.height;
  for (std::size_t i = 0; i < image.pixels.size(); i += 3)
    raster.pixels.insert(raster.pixels.end(), {image.pixels[i], image.pixels[i + 1], image.pixels[i + 2], 255});
  return raster;
}

void measure(const std::string& name, Motion& motion, std::size_t frames) {
  live::Description description;
  const Box3d& box = motion.box();
  description.layout.vertices = static_cast<std::uint32_t>(motion.positions().size());
  description.layout.columns = motion.columns();
  description.box = box;
  double quantiseMs = 0, encodeMs = 0, decodeMs = 0, pngMs = 0;
  std::uint64_t bytes = 0, linearBytes = 0, previousBytes = 0, pngBytes = 0, smallPngBytes = 0, webpBytes = 0,
                clamped = 0;
  const char* predictions[] = {"none", "previous", "linear", "planar"};
  live::Prediction prediction{};
  for (std::size_t i = 0; i < frames; ++i) {
    for (int step = 0; step < 5; ++step)
      motion.advance(1.0 / 30);
    live::Frame frame;
    const live::Arrays arrays{{&motion.positions().front().x, 3 * motion.positions().size()}, {}, {}, {}};
    clamped += timed(quantiseMs, [&] { return quantise(arrays, description, frame); });
    prediction = live::choosePrediction(frame);
    const Bytes encoded = timed(encodeMs, [&] { return encodeFrame(frame); });
    if (timed(decodeMs, [&] { return live::decodeFrame(encoded, ""); }) != frame) {
      fmt::print(stderr, "{}: a frame is not the same after decoding\n", name);
      std::exit(1);
    }
    bytes += encoded.size();
    linearBytes += encodeFrame(frame, live::Prediction::linear).size();
    previousBytes += encodeFrame(frame, live::Prediction::previous).size();
    const Bytes png = timed(pngMs, [&] { return live::imageOfFrame(encoded, ""); });
    pngBytes += png.size();
    const Image image = decodePng(png, "");
    smallPngBytes += encodePng(image, 5).size();
    webpBytes += encodeLosslessWebp(rasterOf(image)).size();
  }
  const auto ratio = [&](std::uint64_t other) { return static_cast<double>(bytes) / static_cast<double>(other); };
  const auto mean = [&](double sum) { return sum / static_cast<double>(frames); };
  fmt::print(
      "| {} | {} | {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {} |\n",
      name, description.layout.vertices, predictions[static_cast<std::size_t>(prediction)], bytes / frames,
      ratio(frames * 6 * std::uint64_t{description.layout.vertices}), ratio(pngBytes), ratio(smallPngBytes),
      ratio(webpBytes), ratio(linearBytes), ratio(previousBytes), mean(quantiseMs), mean(encodeMs), mean(decodeMs),
      clamped);
}

} // namespace

int main(int count, char** words) {
  return runInFolder(count, words, "live", [](const std::vector<std::string>& models, const auto& folder) {
    fmt::print(
        "| motion | vertices | prediction | bytes | of raw | of PNG, fast | of PNG, effort 5 | of WebP | of linear | "
        "of previous | quantise, ms | encode, ms | decode, ms | clamped "
        "|\n|---|--:|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
    for (const std::uint32_t grid : {64u, 128u, 256u})
      measure(fmt::format("cloth {} x {}", grid, grid), *makeCloth(grid, 1), 40);
    measure("water 128 x 128", *makeWater(128, 1), 40);
    measure("turning scanner", *makeTurntable(128, 1), 40);
    Noise noise(128);
    measure("noise", noise, 20);
    measure("bent model", *makeBending(models.front(), folder), 5);
  });
}
