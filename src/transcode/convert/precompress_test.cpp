// Converts with files compressed in advance.

#include "base/error.h"
#include "base/file.h"
#include "base/soak_testing.h"
#include "base/testing.h"
#include "content/content_coding.h"
#include "transcode/site/site_files.h"
#include "transcode/site/testing.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

namespace fs = std::filesystem;

/// An OBJ file of a wavy grid of n x n quads.
std::string wavyGridObj(int n) {
  std::string text;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x)
      text += "v " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(x * y % 7) + "\n";
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const int corner = y * (n + 1) + x + 1;
      text += "f " + std::to_string(corner) + " " + std::to_string(corner + 1) + " " + std::to_string(corner + n + 2) +
              " " + std::to_string(corner + n + 1) + "\n";
    }
  return text;
}

class Precompress : public ::testing::Test {
protected:
  Precompress() { writeFile(directory_ / "grid.obj", asBytes(wavyGridObj(40))); }

  ConvertReport convertGrid(bool precompress) {
    ConvertOptions options;
    options.encoding = Encoding::bg;
    options.precompress = precompress;
    return convert(directory_ / "grid.obj", site(), options);
  }
  fs::path site() const { return directory_ / "site"; }

  std::vector<fs::path> precompressedFiles() const {
    std::vector<fs::path> files = filesIn(site());
    std::erase_if(files, [](const fs::path& file) { return !isPrecompressed(file); });
    return files;
  }

  testing::TemporaryDirectory directory_;
};

TEST_F(Precompress, TextAndArraysHaveSmallerCopiesInBothCodings) {
  const ConvertReport report = convertGrid(true);
  std::size_t arrays = 0;
  for (const fs::path& file : filesIn(site())) {
    const bool isArray = file.extension() == ".bin";
    if (!isArray && file != pageName && file != sceneName)
      continue;
    arrays += isArray;
    const Bytes bytes = readFile(site() / file);
    for (const ContentCoding coding : {ContentCoding::brotli, ContentCoding::gzip}) {
      fs::path copy = site() / file;
      copy += codingExtension(coding);
      ASSERT_TRUE(fs::exists(copy)) << copy;
      EXPECT_EQ(readFile(copy), encodeContent(coding, bytes, CodingEffort::smallest)) << copy;
      EXPECT_LT(fs::file_size(copy), bytes.size()) << copy;
    }
  }
  EXPECT_GT(arrays, 0u);
  for (const fs::path& file : precompressedFiles())
    EXPECT_NE(fs::path(file).replace_extension().extension(), ".png") << file;
  EXPECT_GT(report.precompressed.files, arrays);
  EXPECT_LT(report.precompressed.brotliBytes, report.precompressed.bytes);
  EXPECT_LT(report.precompressed.gzipBytes, report.precompressed.bytes);
}

SOAK_TEST_F(Precompress, ALaterConversionReplacesTheCopies) {
  convertGrid(true);
  EXPECT_FALSE(precompressedFiles().empty());
  EXPECT_EQ(convertGrid(false).precompressed.files, 0u);
  EXPECT_TRUE(precompressedFiles().empty());
}

TEST_F(Precompress, ACompressedFileOfSomebodyElseIsForeign) {
  convertGrid(true);
  for (const char* name : {"notes.txt.gz", "index.html.br.gz"}) {
    writeFile(site() / name, asBytes("somebody else's"));
    EXPECT_THROW(convertGrid(true), Error) << name;
    EXPECT_TRUE(fs::exists(site() / name));
    fs::remove(site() / name);
  }
}

} // namespace
} // namespace imgeo
