#include "import/ply/frames.h"

#include "base/error.h"
#include "import/ply/testing.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

using testing::PlyStyle;

/// A surface of four triangles whose first vertex is at x = `moment`.
Mesh frameMesh(float moment) {
  Mesh mesh;
  mesh.positions = {{moment, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.wedgePositions = {0, 1, 2, 3};
  mesh.corners = {0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2};
  mesh.normals = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}};
  mesh.colors = {Rgba8{255, 0, 0, 255}, Rgba8{0, 255, 0, 255}, Rgba8{0, 0, 255, 255}, Rgba8{9, 9, 9, 255}};
  return mesh;
}

/// Gives `bytes` in portions of a size.
PlyFrameReader readerOf(Bytes bytes, std::size_t portion) {
  return PlyFrameReader([bytes = std::move(bytes), at = std::size_t{0}, portion](std::span<std::uint8_t> out) mutable {
    const std::size_t count = std::min({portion, out.size(), bytes.size() - at});
    std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), count, out.begin());
    at += count;
    return count;
  });
}

Bytes framesOf(const std::string& encoding, int count) {
  PlyStyle style;
  style.encoding = encoding;
  Bytes all;
  for (int i = 0; i < count; ++i) {
    const Bytes file = plyBytes(frameMesh(static_cast<float>(i)), style);
    all.insert(all.end(), file.begin(), file.end());
  }
  return all;
}

constexpr const char* encodings[] = {"ascii", "binary_little_endian", "binary_big_endian"};

TEST(PlyFrames, AreCutFromAStreamInAnyPortions) {
  for (const char* encoding : encodings)
    for (const std::size_t portion : {1u, 7u, 100000u}) {
      PlyFrameReader reader = readerOf(framesOf(encoding, 3), portion);
      for (int i = 0; i < 3; ++i) {
        const auto frame = reader.next("pipe", {});
        ASSERT_TRUE(frame) << encoding;
        EXPECT_EQ(frame->positions, frameMesh(static_cast<float>(i)).positions) << encoding;
        EXPECT_EQ(frame->attributes.normals, frameMesh(0).normals);
        EXPECT_EQ(frame->attributes.colors, frameMesh(0).colors);
        EXPECT_TRUE(frame->indices.empty());
      }
      EXPECT_FALSE(reader.next("pipe", {})) << encoding;
    }
}

TEST(PlyFrames, AreReadWhenTheirLastByteHasArrived) {
  for (const char* encoding : encodings) {
    const Bytes first = framesOf(encoding, 1);
    std::size_t at = 0;
    PlyFrameReader reader([&](std::span<std::uint8_t> out) {
      // The next frame is never written.
      if (at == first.size())
        throw Error(ErrorKind::io, "", "the reader asks for bytes of the next frame");
      out[0] = first[at++];
      return std::size_t{1};
    });
    EXPECT_TRUE(reader.next("pipe", {})) << encoding;
  }
}

TEST(PlyFrames, ThatEndEarlyAreRefused) {
  for (const char* encoding : encodings) {
    const Bytes whole = framesOf(encoding, 2);
    for (std::size_t length = whole.size() / 2 + 1; length + 1 < whole.size(); ++length) {
      PlyFrameReader reader = readerOf(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)), 64);
      ASSERT_TRUE(reader.next("pipe, frame 0", {}));
      try {
        reader.next("pipe, frame 1", {});
        // The last line of a text may lack a digit or its end.
        EXPECT_STREQ(encoding, "ascii");
        EXPECT_GT(length, whole.size() - 8);
      } catch (const Error& error) {
        EXPECT_EQ(error.location().substr(0, 13), "pipe, frame 1") << error.what();
      }
    }
  }
}

TEST(PlyFrames, ThatPromiseTooMuchAreRefusedBeforeTheyAreRead) {
  const auto refusal = [](const std::string& text) {
    PlyFrameReader reader = readerOf(Bytes(text.begin(), text.end()), 1000);
    try {
      reader.next("pipe", {});
    } catch (const Error& error) {
      return error.kind();
    }
    return ErrorKind::usage;
  };
  const std::string properties = "property float x\nproperty float y\nproperty float z\n";
  EXPECT_EQ(refusal("ply\nformat binary_little_endian 1.0\nelement vertex 99999999999\n" + properties + "end_header\n"),
            ErrorKind::limit);
  EXPECT_EQ(
      refusal("ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty list uint double x\nend_header\n" +
              std::string(8, '\xff')),
      ErrorKind::limit);
  EXPECT_EQ(refusal("ply\n" + std::string(100000, 'c')), ErrorKind::limit);
  EXPECT_EQ(refusal("solid cube\n"), ErrorKind::malformed);
  EXPECT_EQ(refusal("ply\nformat ascii 1.0\nelement vertex 2\n" + properties + "end_header\n0 0 0\n"),
            ErrorKind::truncated);
}

} // namespace
} // namespace imgeo
