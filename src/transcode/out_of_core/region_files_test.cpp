#include "transcode/out_of_core/region_files.h"

#include "base/error.h"
#include "base/testing.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

using imgeo::testing::TemporaryDirectory;

/// Elements of `regions` regions, some of which have none.
ScatteredElements elementsOf(std::size_t regions) {
  ScatteredElements elements{std::vector<std::vector<float>>(regions), EdgeLengths(30, 4), 7, {1, 2, 3}};
  for (std::size_t region = 0; region < regions; ++region)
    for (std::size_t i = 0; i < region % 4 * 5; ++i)
      elements.records[region].push_back(static_cast<float>(100 * region + i));
  return elements;
}

TEST(ScatteredElements, AreReadAsTheyWereWrittenAsAWholeAndByRegion) {
  const TemporaryDirectory folder;
  const std::string path = folder / "scatter";
  for (const std::size_t regions : {0u, 1u, 2u, 900u}) {
    const ScatteredElements written = elementsOf(regions);
    writeFile(path, writeScattered(written));

    const ScatteredElements sums = readScatteredSums(path);
    EXPECT_EQ(sums.lengths.sum(), written.lengths.sum());
    EXPECT_EQ(sums.lengths.count(), written.lengths.count());
    EXPECT_EQ(sums.collapsed, written.collapsed);
    EXPECT_EQ(sums.labels, written.labels);

    std::vector<float> all;
    const std::vector<std::uint64_t> sizes = readScatteredSizes(path);
    ASSERT_EQ(sizes.size(), regions);
    for (std::uint32_t region = 0; region < regions; ++region) {
      std::vector<float> records = {-1};
      appendScattered(records, path, region);
      EXPECT_EQ(records.at(0), -1);
      records.erase(records.begin());
      EXPECT_EQ(records, written.records[region]);
      EXPECT_EQ(sizes[region], records.size());
      all.insert(all.end(), records.begin(), records.end());
    }
    visitScattered(path, [&](std::span<const float> records) {
      EXPECT_EQ(std::vector<float>(records.begin(), records.end()), all);
    });
  }
}

TEST(ScatteredElements, OfAFileThatIsShorterOrOfAnotherConversionAreRefused) {
  const TemporaryDirectory folder;
  const std::string path = folder / "scatter";
  const Bytes written = writeScattered(elementsOf(4));
  std::vector<float> records;
  const auto expectRefused = [&](std::uint32_t region) {
    try {
      appendScattered(records, path, region);
      ADD_FAILURE() << "region " << region << " is not refused";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::malformed);
      EXPECT_EQ(error.what(), path + ": is no work file of this conversion; convert without --resume");
    }
  };
  for (std::size_t size = 0; size < written.size(); ++size) {
    writeFile(path, ByteSpan(written).first(size));
    expectRefused(3);
  }
  writeFile(path, written);
  expectRefused(4);
  for (const std::size_t at : {7u, 47u}) { // the highest bytes of the records' offset and of the last region's end
    Bytes damaged = written;
    damaged[at] = 0xff;
    writeFile(path, damaged);
    expectRefused(3);
  }
}

} // namespace
} // namespace imgeo
