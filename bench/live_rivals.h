#pragma once
// Other ways to code the frames of a live stream, which the benchmark compares with the one that imgeo has: prediction
// along the triangles of a mesh, prediction from the frame before, and lossless video.

#include "bench/process.h"
#include "containers/png/png.h"
#include "images/raster.h"
#include "live/frame.h"
#include "live/prediction.h"

#include <array>
#include <ctime>
#include <fmt/format.h>
#include <fstream>
#include <libdeflate.h>
#include <map>
#include <optional>

namespace imgeo {

/// Where the position of a vertex is predicted: at a + b - c.
struct Parallelogram {
  std::uint32_t a = 0, b = 0, c = 0;
};

/// The prediction of each vertex from those before it: the corner of a parallelogram over a triangle of which it is the
/// last vertex, or a neighbour in a triangle, or the vertex before.
inline std::vector<Parallelogram> parallelogramsOf(const std::vector<std::uint32_t>& indices, std::uint32_t vertices) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> across;
  const auto edge = [](std::uint32_t a, std::uint32_t b) { return std::pair(std::min(a, b), std::max(a, b)); };
  for (std::size_t t = 0; t < indices.size(); t += 3)
    for (std::size_t i = 0; i < 3; ++i)
      across[edge(indices[t + (i + 1) % 3], indices[t + (i + 2) % 3])].push_back(indices[t + i]);
  std::vector<Parallelogram> predictions(vertices);
  std::vector<int> ranks(vertices, 0); // 1: a neighbour, 2: a parallelogram
  for (std::uint32_t i = 1; i < vertices; ++i)
    predictions[i] = {i - 1, 0, 0};
  for (std::size_t t = 0; t < indices.size(); t += 3)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t vertex = indices[t + i], a = indices[t + (i + 1) % 3], b = indices[t + (i + 2) % 3];
      if (std::max(a, b) > vertex || ranks[vertex] == 2)
        continue;
      if (ranks[vertex] < 1)
        predictions[vertex] = {std::max(a, b), 0, 0};
      ranks[vertex] = std::max(ranks[vertex], 1);
      for (const std::uint32_t c : across.at(edge(a, b)))
        if (c < vertex) {
          predictions[vertex] = {a, b, c};
          ranks[vertex] = 2;
        }
    }
  return predictions;
}

/// Bytes of the gzipped planes of residuals, as frames have them. `residualsOfAxis` fills the residuals of an axis.
template <typename Residuals> std::size_t packedBytes(const live::Frame& frame, const Residuals& residualsOfAxis) {
  const std::size_t vertices = frame.layout.vertices;
  std::vector<std::uint32_t> residuals(vertices);
  Bytes planes(6 * vertices);
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    residualsOfAxis(axis, residuals);
    for (std::size_t i = 0; i < vertices; ++i) {
      planes[axis * vertices + i] = static_cast<std::uint8_t>(residuals[i] >> 8);
      planes[(3 + axis) * vertices + i] = static_cast<std::uint8_t>(residuals[i]);
    }
  }
  libdeflate_compressor* compressor = libdeflate_alloc_compressor(1);
  Bytes packed(libdeflate_gzip_compress_bound(compressor, planes.size()));
  const std::size_t size =
      libdeflate_gzip_compress(compressor, planes.data(), planes.size(), packed.data(), packed.size());
  libdeflate_free_compressor(compressor);
  return live::frameHeaderBytes + size;
}

/// The nearest signed number of 16 bits, with the sign in the lowest bit.
inline std::uint32_t fold16(std::uint32_t difference) {
  const auto value = static_cast<std::int16_t>(difference);
  return ((static_cast<std::uint32_t>(value) << 1) ^ static_cast<std::uint32_t>(value >> 15)) & 0xffff;
}

/// Bytes of a frame of 16 bits whose vertices are predicted along triangles.
inline std::size_t bytesAlongTriangles(const live::Frame& frame, const std::vector<Parallelogram>& predictions) {
  return packedBytes(frame, [&](std::uint32_t axis, std::vector<std::uint32_t>& residuals) {
    const auto v = frame.component(axis);
    residuals[0] = v[0];
    for (std::size_t i = 1; i < v.size(); ++i) {
      const auto [a, b, c] = predictions[i];
      residuals[i] = fold16(v[i] - (v[a] + v[b] - v[c]));
    }
  });
}

/// Bytes of a frame of 16 bits as the difference to the frame before, the smallest of those whose differences are
/// predicted by no vertex, the one before, and planar on a grid.
inline std::size_t bytesAfter(const live::Frame& frame, const live::Frame& before) {
  std::size_t smallest = SIZE_MAX;
  for (const auto prediction : {live::Prediction::none, live::Prediction::previous, live::Prediction::planar}) {
    if (prediction == live::Prediction::planar && frame.layout.columns == 0)
      continue;
    const std::size_t bytes = packedBytes(frame, [&](std::uint32_t axis, std::vector<std::uint32_t>& residuals) {
      const auto v = frame.component(axis), w = before.component(axis);
      std::vector<std::uint32_t> differences(v.size());
      for (std::size_t i = 0; i < v.size(); ++i)
        differences[i] = (v[i] - w[i]) & 0xffff;
      residualsOf(differences, prediction, frame.layout.columns, 16, residuals);
    });
    smallest = std::min(smallest, bytes);
  }
  return smallest;
}

/// Milliseconds of a processor that the calling thread has had.
inline double threadMilliseconds() {
  struct timespec time {};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

/// An RGB image as an opaque raster.
inline Raster rasterOf(const Image& image) {
  Raster raster;
  raster.width = image.width;
  raster.height = image.height;
  for (std::size_t i = 0; i < image.pixels.size(); i += 3)
    raster.pixels.insert(raster.pixels.end(), {image.pixels[i], image.pixels[i + 1], image.pixels[i + 2], 255});
  return raster;
}

/// The call of ffmpeg up to its input: raw RGB images of one size, 30 a second, which are encoded as RGB.
inline std::vector<std::string> videoInput(const std::filesystem::path& raw, std::uint32_t width,
                                           std::uint32_t height) {
  const std::string size = fmt::format("{}x{}", width, height);
  return {"ffmpeg", "-loglevel", "error", "-nostdin", "-y", "-f",         "rawvideo", "-pix_fmt", "rgb24",
          "-s",     size,        "-r",    "30",       "-i", raw.string(), "-pix_fmt", "gbrp"};
}

struct VideoResult {
  double bytes = 0, encodeMs = 0, decodeMs = 0; ///< of a frame
};

/// VP9 without losses (libvpx, RGB, as quick as it encodes) of images of one size, at 30 frames a second; nothing
/// without ffmpeg. Times are those of its processes, and starting them takes a part.
inline std::optional<VideoResult> encodeVideo(const std::vector<Bytes>& pngs, const std::filesystem::path& folder) {
  if (std::system("command -v ffmpeg >/dev/null") != 0)
    return {};
  const std::filesystem::path raw = folder / "frames.rgb", video = folder / "frames.webm";
  std::ofstream file(raw, std::ios::binary);
  Image image;
  for (const Bytes& png : pngs) {
    image = decodePng(png, "");
    file.write(reinterpret_cast<const char*>(image.pixels.data()), static_cast<std::streamsize>(image.pixels.size()));
  }
  file.close();
  const auto frames = static_cast<double>(pngs.size());
  std::vector<std::string> words = videoInput(raw, image.width, image.height);
  words.insert(words.end(),
               {"-c:v", "libvpx-vp9", "-lossless", "1", "-deadline", "realtime", "-cpu-used", "6", video.string()});
  const Run encoding = runOnce(words);
  const Run decoding = runOnce({"ffmpeg", "-loglevel", "error", "-nostdin", "-i", video, "-f", "null", "-"});
  return VideoResult{static_cast<double>(std::filesystem::file_size(video)) / frames,
                     1e3 * encoding.processorSeconds / frames, 1e3 * decoding.processorSeconds / frames};
}

} // namespace imgeo
