#include "images/sgi.h"

#include "base/error.h"
#include "images/decode_image.h"
#include "images/testing.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace imgeo::testing {
namespace {

struct SgiFile {
  std::uint8_t storage = 0, bytesPerChannel = 1;
  std::uint16_t dimensions = 3, width = 0, height = 0, channels = 4;
  std::uint32_t colorMap = 0;

  Bytes header() const {
    Bytes bytes{0x01, 0xda, storage, bytesPerChannel};
    for (const std::uint16_t value : {dimensions, width, height, channels})
      appendBig(bytes, value);
    bytes.resize(104);
    appendBig(bytes, colorMap);
    bytes.resize(512);
    return bytes;
  }

  /// The low byte of two is noise, which decoders drop.
  void appendValue(Bytes& out, std::uint8_t value) const {
    out.push_back(value);
    if (bytesPerChannel == 2)
      out.push_back(static_cast<std::uint8_t>(91 * value + 7));
  }
  void appendHead(Bytes& out, std::size_t head) const {
    out.resize(out.size() + bytesPerChannel - 1u);
    out.push_back(static_cast<std::uint8_t>(head));
  }

  /// A run for values that are equal, copied values for others.
  Bytes runsOf(ByteSpan values, bool hasZero) const {
    Bytes out;
    for (std::size_t i = 0; i < values.size();) {
      std::size_t count = 1;
      const bool isRun = i + 1 < values.size() && values[i + 1] == values[i];
      while (i + count < values.size() && count < 127 && (values[i + count] == values[i + count - 1]) == isRun)
        ++count;
      appendHead(out, isRun ? count : count | 0x80);
      for (std::size_t j = 0; j < (isRun ? 1 : count); ++j)
        appendValue(out, values[i + j]);
      i += count;
    }
    if (hasZero)
      appendHead(out, 0);
    return out;
  }
};

/// The values of a channel in a row that counts from the bottom.
Bytes rowOf(const Raster& raster, std::size_t channel, std::size_t row) {
  Bytes values;
  for (std::size_t x = 0; x < raster.width; ++x)
    values.push_back(raster.pixels[4 * ((raster.height - 1 - row) * raster.width + x) + channel]);
  return values;
}

/// Channels of the raster that a file of so many has.
std::vector<std::size_t> channelsOf(std::size_t count) {
  return count == 1   ? std::vector<std::size_t>{0}
         : count == 2 ? std::vector<std::size_t>{0, 3}
         : count == 3 ? std::vector<std::size_t>{0, 1, 2}
                      : std::vector<std::size_t>{0, 1, 2, 3};
}

SgiFile fileOf(const Raster& raster, std::uint16_t channels, std::uint8_t bytesPerChannel) {
  SgiFile file;
  file.width = static_cast<std::uint16_t>(raster.width);
  file.height = static_cast<std::uint16_t>(raster.height);
  file.channels = channels;
  file.bytesPerChannel = bytesPerChannel;
  return file;
}

Bytes verbatim(const Raster& raster, const SgiFile& file) {
  Bytes bytes = file.header();
  for (const std::size_t channel : channelsOf(file.channels))
    for (std::size_t row = 0; row < raster.height; ++row)
      for (const std::uint8_t value : rowOf(raster, channel, row))
        file.appendValue(bytes, value);
  return bytes;
}

/// Rows of equal values share their runs.
Bytes runLengthEncoded(const Raster& raster, SgiFile file, bool hasZeros) {
  file.storage = 1;
  Bytes bytes = file.header(), data, lengths;
  std::vector<std::pair<Bytes, std::uint32_t>> offsets;
  const auto dataBegin = static_cast<std::uint32_t>(512 + std::size_t{8} * file.channels * file.height);
  for (const std::size_t channel : channelsOf(file.channels))
    for (std::size_t row = 0; row < raster.height; ++row) {
      const Bytes runs = file.runsOf(rowOf(raster, channel, row), hasZeros);
      auto found = std::ranges::find(offsets, runs, &std::pair<Bytes, std::uint32_t>::first);
      if (found == offsets.end()) {
        found = offsets.insert(offsets.end(), {runs, dataBegin + static_cast<std::uint32_t>(data.size())});
        data.insert(data.end(), runs.begin(), runs.end());
      }
      appendBig(bytes, found->second);
      appendBig(lengths, static_cast<std::uint32_t>(runs.size()));
    }
  bytes.insert(bytes.end(), lengths.begin(), lengths.end());
  bytes.insert(bytes.end(), data.begin(), data.end());
  return bytes;
}

/// The raster with the channels that a file of so many has.
Raster reduced(Raster raster, std::size_t channels) {
  for (std::size_t at = 0; at < raster.pixels.size(); at += 4) {
    if (channels < 3)
      raster.pixels[at + 1] = raster.pixels[at + 2] = raster.pixels[at];
    if (channels % 2 == 1)
      raster.pixels[at + 3] = 255;
  }
  return raster;
}

/// Rows with runs of more than 127 pixels, some equal, and rows of noise.
Raster stripes() {
  Raster raster = noiseRaster(300, 6);
  for (std::size_t row : {1, 3, 4})
    for (std::size_t x = 0; x < 290; ++x)
      for (std::size_t channel = 0; channel < 4; ++channel)
        raster.pixels[4 * (row * 300 + x) + channel] = static_cast<std::uint8_t>(x < 140 ? 80 + channel : 9);
  return raster;
}

TEST(DecodeSgi, ReadsEveryNumberOfChannelsAndBothStorages) {
  for (const Raster& raster : {testRaster(9, 5, true), stripes(), testRaster(1, 1, true)})
    for (std::uint16_t channels = 1; channels <= 4; ++channels)
      for (std::uint8_t bytesPerChannel = 1; bytesPerChannel <= 2; ++bytesPerChannel) {
        SCOPED_TRACE(::testing::Message() << channels << " channels of " << int{bytesPerChannel});
        const SgiFile file = fileOf(raster, channels, bytesPerChannel);
        const Raster expected = reduced(raster, channels);
        EXPECT_EQ(decodeRaster(verbatim(raster, file), "a.rgb"), expected);
        for (const bool hasZeros : {true, false})
          EXPECT_EQ(decodeRaster(runLengthEncoded(raster, file, hasZeros), "a.rgb"), expected);
      }
}

TEST(DecodeSgi, ReadsOneAndTwoDimensionsWhateverTheOtherSizesSay) {
  const Raster raster = testRaster(7, 3);
  SgiFile file = fileOf(raster, 1, 1);
  file.dimensions = 2;
  Bytes bytes = verbatim(raster, file);
  bytes[11] = 77; // channels
  EXPECT_EQ(decodeRaster(bytes, "a.bw"), reduced(raster, 1));

  const Raster row = testRaster(7, 1);
  file = fileOf(row, 1, 1);
  file.dimensions = 1;
  bytes = verbatim(row, file);
  bytes[9] = bytes[11] = 0; // rows and channels
  EXPECT_EQ(decodeRaster(bytes, "a.bw"), reduced(row, 1));
}

struct Refused {
  Bytes bytes;
  ErrorKind kind;
  std::string message;
};

void expectRefused(const Refused& refused, std::uint64_t maxPixels = maxRasterPixels) {
  try {
    decodeSgi(refused.bytes, "a.rgb", maxPixels);
    ADD_FAILURE() << "decoded; expected: " << refused.message;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), refused.kind);
    EXPECT_EQ(error.location(), "a.rgb");
    EXPECT_EQ(error.message(), refused.message);
  }
}

TEST(DecodeSgi, RefusesHeadersWithASentence) {
  const Raster raster = testRaster(2, 2);
  const SgiFile file = fileOf(raster, 3, 1);
  const auto changed = [&](std::size_t at, std::uint8_t value) {
    Bytes bytes = verbatim(raster, file);
    bytes[at] = value;
    return bytes;
  };
  const std::string image = "is an SGI image that ";
  const auto malformed = ErrorKind::malformed, unsupported = ErrorKind::unsupported;
  expectRefused({changed(2, 2), malformed, image + "states storage 2, 1 bytes a channel and 3 dimensions"});
  expectRefused({changed(3, 0), malformed, image + "states storage 0, 0 bytes a channel and 3 dimensions"});
  expectRefused({changed(3, 3), malformed, image + "states storage 0, 3 bytes a channel and 3 dimensions"});
  expectRefused({changed(5, 4), malformed, image + "states storage 0, 1 bytes a channel and 4 dimensions"});
  expectRefused({changed(7, 0), malformed, image + "has no pixels"});
  expectRefused({changed(11, 5), unsupported, image + "has 5 channels; those of 1 to 4 are decoded"});
  expectRefused({changed(107, 1), unsupported, image + "has the obsolete kind of colours 1; only 0 is decoded"});
  expectRefused(
      {changed(9, 3), ErrorKind::truncated, image + "needs 530 bytes for 2 x 3 pixels of 3 channels, but has 524"});
  expectRefused({Bytes(511, 0), ErrorKind::truncated, image + "ends in its header"});
}

TEST(DecodeSgi, RefusesRunsThatDoNotFillTheirRow) {
  Raster raster = testRaster(4, 2);
  raster.pixels[4 * 7] = 0; // the last pixel of the lower row, which comes first
  const Bytes whole = runLengthEncoded(raster, fileOf(raster, 1, 1), true); // tables of 16 bytes, rows of 6
  const auto expectMessage = [&](std::size_t at, std::uint8_t value, const std::string& message) {
    Bytes bytes = whole;
    ASSERT_EQ(bytes.size(), 540u);
    bytes[at] = value;
    expectRefused({bytes, ErrorKind::malformed, "is an SGI image that " + message});
  };
  expectMessage(512, 1, "has row 0 of channel 0 behind its end");
  expectMessage(519, 29, "has row 1 of channel 0 behind its end"); // of 6 bytes from 534 on, 541 for it
  expectMessage(523, 255, "has row 0 of channel 0 behind its end");
  expectMessage(527, 2, "has 0 of 4 pixels in row 1 of channel 0");
  expectMessage(528, 0x83, "has 3 of 4 pixels in row 0 of channel 0"); // then a zero, which ends the row
  expectMessage(534, 0, "has 0 of 4 pixels in row 1 of channel 0");
}

TEST(DecodeSgi, RefusesHugeImagesByTheirHeader) {
  SgiFile file;
  file.storage = 1;
  file.width = 0xffff;
  file.height = 1;
  expectRefused({file.header(), ErrorKind::limit,
                 "is an image of 65535 x 1 pixels; more than 16384 along an edge or 67108864 in all are not decoded"});
  file.width = 40, file.height = 30;
  expectRefused({file.header(), ErrorKind::limit,
                 "is an image of 40 x 30 pixels; more than 16384 along an edge or 1000 in all are not decoded"},
                1000);
}

TEST(DecodeSgi, RefusesEveryPrefixOfAFile) {
  const Raster raster = testRaster(9, 7, true);
  const SgiFile file = fileOf(raster, 4, 2);
  for (const Bytes& whole : {verbatim(raster, file), runLengthEncoded(raster, file, false)})
    for (std::size_t size = 2; size < whole.size(); ++size)
      EXPECT_THROW(decodeRaster({whole.data(), size}, "cut.sgi"), Error) << size;
}

} // namespace
} // namespace imgeo::testing
