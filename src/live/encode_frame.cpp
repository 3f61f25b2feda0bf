#include "live/frame.h"
#include "live/prediction.h"

#include "base/narrow.h"

#include <array>
#include <bit>
#include <cassert>
#include <libdeflate.h>
#include <memory>
#include <new>

namespace imgeo::live {

namespace {

/// Predictions are compared on this many vertices.
constexpr std::uint32_t maxProbedVertices = 8192;

constexpr int maxCompressionLevel = 12;

libdeflate_compressor* compressor(int level) {
  struct Free {
    void operator()(libdeflate_compressor* each) const { libdeflate_free_compressor(each); }
  };
  thread_local std::array<std::unique_ptr<libdeflate_compressor, Free>, maxCompressionLevel + 1> instances;
  auto& instance = instances.at(static_cast<std::size_t>(level));
  if (!instance)
    instance.reset(libdeflate_alloc_compressor(level));
  if (!instance)
    throw std::bad_alloc();
  return instance.get();
}

void writePlane(std::span<const std::uint32_t> residuals, std::uint32_t shift, std::uint8_t* plane) {
  for (std::size_t i = 0; i < residuals.size(); ++i)
    plane[i] = static_cast<std::uint8_t>(residuals[i] >> shift);
}

/// Writes the planes of one attribute and returns where they end.
std::uint8_t* writePlanes(const Frame& frame, const ComponentBits& attribute, Prediction prediction,
                          std::span<std::uint32_t> residuals, std::uint8_t* out) {
  const std::size_t vertices = frame.layout.vertices;
  const std::uint32_t bytes = (attribute.bits + 7) / 8;
  for (std::uint32_t i = 0; i < attribute.count; ++i) {
    residualsOf(frame.component(attribute.first + i), prediction, frame.layout.columns, attribute.bits, residuals);
    for (std::uint32_t plane = 0; plane < bytes; ++plane)
      writePlane(residuals, 8 * (bytes - 1 - plane), out + (std::size_t{plane} * attribute.count + i) * vertices);
  }
  return out + std::size_t{bytes} * attribute.count * vertices;
}

/// The sum of the residuals' lengths in bits.
std::uint64_t costOf(const Frame& frame, Prediction prediction) {
  const std::uint32_t count = std::min(frame.layout.vertices, maxProbedVertices);
  std::vector<std::uint32_t> residuals(count);
  std::uint64_t cost = 0;
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    residualsOf(frame.component(axis).first(count), prediction, 0, frame.layout.positionBits, residuals);
    for (const std::uint32_t residual : residuals)
      cost += static_cast<std::uint64_t>(std::bit_width(residual));
  }
  return cost;
}

/// `prediction`: the byte of the header.
Bytes headerOf(const Frame& frame, std::uint32_t prediction, std::size_t packedBytes) {
  const FrameLayout& layout = frame.layout;
  Bytes header{'I', 'G', 'F', 1};
  appendLittle(header, narrow<std::uint32_t>(packedBytes));
  appendLittle(header, frame.number);
  appendLittle(header, frame.epoch);
  appendLittle(header, frame.time);
  appendLittle(header, layout.vertices);
  appendLittle(header, layout.columns);
  for (const std::uint32_t field : {layout.positionBits, layout.normalBits, layout.colorComponents,
                                    layout.valueComponents, layout.valueBits, prediction})
    header.push_back(narrow<std::uint8_t>(field));
  header.insert(header.end(), {0, 0});
  appendLittle(header, libdeflate_crc32(0, header.data(), header.size()));
  assert(header.size() == frameHeaderBytes);
  return header;
}

} // namespace

Prediction choosePrediction(const Frame& frame) {
  if (frame.layout.columns > 0)
    return Prediction::planar;
  Prediction best = Prediction::none;
  std::uint64_t bestCost = UINT64_MAX;
  for (const Prediction prediction : {Prediction::none, Prediction::previous, Prediction::linear}) {
    const std::uint64_t cost = costOf(frame, prediction);
    // A prediction has to save 1 %: in noise the differences are chance.
    if (bestCost != UINT64_MAX && cost >= bestCost - bestCost / 100)
      continue;
    best = prediction;
    bestCost = cost;
  }
  return best;
}

namespace {

/// `marks`: bits of the header's byte besides the prediction.
Bytes encode(const Frame& frame, Prediction prediction, std::uint32_t marks, int level) {
  assert(frame.components.size() == std::size_t{componentCount(frame.layout)} * frame.layout.vertices);
  const std::size_t unpackedBytes = unpackedBytesOf(frame.layout);
  const auto planes = std::make_unique_for_overwrite<std::uint8_t[]>(unpackedBytes);
  std::vector<std::uint32_t> residuals(frame.layout.vertices);
  std::uint8_t* end = planes.get();
  for (const ComponentBits& attribute : attributesOf(frame.layout))
    end = writePlanes(frame, attribute, prediction, residuals, end);

  libdeflate_compressor* deflate = compressor(level);
  const std::size_t bound = libdeflate_gzip_compress_bound(deflate, unpackedBytes);
  const auto packed = std::make_unique_for_overwrite<std::uint8_t[]>(bound);
  const std::size_t size = libdeflate_gzip_compress(deflate, planes.get(), unpackedBytes, packed.get(), bound);
  assert(size > 0);
  Bytes bytes = headerOf(frame, static_cast<std::uint32_t>(prediction) | marks, size);
  bytes.insert(bytes.end(), packed.get(), packed.get() + size);
  return bytes;
}

} // namespace

Bytes encodeFrame(const Frame& frame, Prediction prediction, int compressionLevel) {
  return encode(frame, prediction, 0, compressionLevel);
}

Bytes encodeDifference(const Frame& frame, const Frame& before, Prediction prediction, int compressionLevel) {
  assert(frame.layout == before.layout);
  Frame difference = frame;
  const std::size_t vertices = frame.layout.vertices;
  for (const ComponentBits& attribute : attributesOf(frame.layout)) {
    const std::uint32_t mask = (std::uint32_t{1} << attribute.bits) - 1;
    for (std::size_t i = attribute.first * vertices; i < (attribute.first + attribute.count) * vertices; ++i)
      difference.components[i] = (frame.components[i] - before.components[i]) & mask;
  }
  return encode(difference, prediction, differenceBit, compressionLevel);
}

Bytes encodeFrame(const Frame& frame) {
  return encodeFrame(frame, choosePrediction(frame));
}

} // namespace imgeo::live
