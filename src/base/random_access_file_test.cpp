#include "base/random_access_file.h"

#include "base/error.h"
#include "base/file.h"
#include "base/testing.h"

#include <gtest/gtest.h>
#include <numeric>

namespace imgeo {
namespace {

using imgeo::testing::TemporaryDirectory;

TEST(RandomAccessFile, ReadsAnyPartOfAFile) {
  const TemporaryDirectory folder;
  Bytes content(5000);
  std::iota(content.begin(), content.end(), std::uint8_t{0});
  writeFile(folder / "file", content);
  const RandomAccessFile file(folder / "file");
  EXPECT_EQ(file.size(), content.size());
  for (const std::size_t offset : {0u, 1u, 4095u, 4096u, 4999u, 5000u})
    for (const std::size_t size : {0u, 1u, 700u}) {
      if (offset + size > content.size())
        continue;
      Bytes part(size);
      file.read(offset, part);
      EXPECT_EQ(part, Bytes(content.begin() + static_cast<std::ptrdiff_t>(offset),
                            content.begin() + static_cast<std::ptrdiff_t>(offset + size)));
    }
}

TEST(RandomAccessFile, NamesAFileThatIsMissingOrEndsBefore) {
  const TemporaryDirectory folder;
  const std::string path = folder / "file";
  const auto messageOf = [](const auto& action) -> std::string {
    try {
      action();
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::io);
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(messageOf([&] { RandomAccessFile opened(path); }), path + ": cannot open: No such file or directory");
  writeFile(path, Bytes(10));
  const RandomAccessFile file(path);
  Bytes part(4);
  EXPECT_EQ(messageOf([&] { file.read(7, part); }), path + ": has become shorter");
}

} // namespace
} // namespace imgeo
