#include "base/bytes.h"
#include "base/dynamic_library.h"
#include "base/error.h"
#include "base/file.h"
#include "base/file_view.h"
#include "base/parallel.h"
#include "base/scratch_file.h"
#include "base/shortest_decimal.h"
#include "base/testing.h"
#include "base/unfinished_files.h"
#include "base/vec.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <stdexcept>
#include <string>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace imgeo {
namespace {

using testing::TemporaryDirectory;

TEST(Error, CombinesLocationAndMessage) {
  const Error error(ErrorKind::malformed, "a.ply:3", "two words expected");
  EXPECT_STREQ(error.what(), "a.ply:3: two words expected");
  EXPECT_STREQ(Error(ErrorKind::usage, "", "no input").what(), "no input");
}

TEST(Error, HasTheDocumentedExitCodes) {
  EXPECT_EQ(exitCode(ErrorKind::usage), 1);
  EXPECT_EQ(exitCode(ErrorKind::io), 2);
  for (const ErrorKind kind : {ErrorKind::truncated, ErrorKind::malformed, ErrorKind::unsupported, ErrorKind::limit})
    EXPECT_EQ(exitCode(kind), 3);
}

TEST(DynamicLibrary, CallsAFunctionAndNamesAMissingOne) {
  struct Maths : DynamicLibrary {
    explicit Maths(const char* name, const char* function = "fabs") : DynamicLibrary(name), fabs(find(function)) {}
    double (*fabs)(double);
  };
  EXPECT_EQ(Maths("libm.so.6").fabs(-3), 3);
  const auto messageOf = [](const char* name, const char* function) -> std::string {
    try {
      const Maths maths(name, function);
      return "";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::io);
      return error.what();
    }
  };
  EXPECT_TRUE(messageOf("libnone.so.1", "fabs").starts_with("libnone.so.1: cannot be loaded"));
  EXPECT_EQ(messageOf("libm.so.6", "cubeRoot"), "libm.so.6: has no function cubeRoot");
}

TEST(File, IsReadAsItWasWritten) {
  const TemporaryDirectory directory;
  for (const std::size_t size : {0u, 1u, 65536u, 200001u}) {
    Bytes bytes(size);
    for (std::size_t i = 0; i < size; ++i)
      bytes[i] = static_cast<std::uint8_t>(i * 31 >> 3);
    writeFile(directory.path() / "file", bytes);
    EXPECT_EQ(readFile(directory.path() / "file"), bytes);
  }
}

TEST(File, IsViewedAsItIsRead) {
  const TemporaryDirectory directory;
  for (const std::size_t size : {0u, 1u, 200001u}) {
    const Bytes bytes(size, 7);
    writeFile(directory.path() / "file", bytes);
    const FileView view(directory.path() / "file");
    EXPECT_TRUE(std::ranges::equal(view.bytes(), bytes));
  }
  EXPECT_THROW(FileView(directory.path()), Error);
  EXPECT_THROW(FileView(directory.path() / "missing"), Error);
}

TEST(File, OfAPipeIsViewedWhole) {
  const TemporaryDirectory directory;
  const std::filesystem::path pipe = directory / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const Bytes bytes(300000, 9);
  std::thread writer([&] { std::ofstream(pipe, std::ios::binary) << asText(bytes); });
  const FileView view(pipe);
  writer.join();
  EXPECT_TRUE(std::ranges::equal(view.bytes(), bytes));
}

TEST(File, NamesThePathAndTheReasonItCannotBeRead) {
  const TemporaryDirectory directory;
  const auto missing = directory.path() / "missing.ply";
  try {
    readFile(missing);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::io);
    EXPECT_EQ(error.location(), missing.string());
    EXPECT_NE(error.message().find("No such file"), std::string::npos);
  }
  EXPECT_THROW(readFile(directory.path()), Error);
}

TEST(ScratchFile, KeepsItsBytesWhenItGrowsAndHasNoName) {
  const TemporaryDirectory directory;
  ScratchFile file(directory.path());
  std::ranges::fill(file.resize(10), std::uint8_t{7});
  const std::span<std::uint8_t> grown = file.resize(100'000);
  EXPECT_EQ(grown[9], 7);
  EXPECT_EQ(grown[10], 0);
  EXPECT_EQ(file.resize(5).size(), 5u);
  EXPECT_EQ(file.bytes()[4], 7);
  EXPECT_TRUE(file.resize(0).empty());
  EXPECT_TRUE(std::filesystem::is_empty(directory.path()));
}

TEST(ScratchFile, NamesTheFolderThatIsMissingOrHasNoRoom) {
  const TemporaryDirectory directory;
  try {
    ScratchFile file(directory / "none");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::io);
    EXPECT_EQ(error.location(), (directory / "none").string());
  }
  ScratchFile file(directory.path());
  try {
    file.resize(std::size_t{1} << 62);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::io);
    EXPECT_NE(std::string(error.what()).find("has no room for"), std::string::npos) << error.what();
  }
}

TEST(File, ThrowsIfItCannotBeWrittenAndKeepsDevices) {
  const TemporaryDirectory directory;
  EXPECT_THROW(writeFile(directory.path() / "no-such-folder" / "file", {}), Error);
  if (std::filesystem::exists("/dev/full")) {
    EXPECT_THROW(writeFile("/dev/full", Bytes(100000)), Error);
    EXPECT_TRUE(std::filesystem::exists("/dev/full"));
  }
}

TEST(ContentName, IsSixteenHexDigitsThatChangeWithTheContent) {
  Bytes bytes(1000, 7);
  const std::string before = contentName(bytes);
  EXPECT_EQ(before.size(), 16u);
  EXPECT_EQ(before.find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_EQ(contentName(bytes), before);
  bytes[500] ^= 1;
  EXPECT_NE(contentName(bytes), before);
}

TEST(ParallelFor, VisitsEveryIndexOnce) {
  std::vector<std::atomic<int>> visits(10007);
  parallelFor(visits.size(), [&](std::size_t i) { ++visits[i]; });
  for (const auto& count : visits)
    EXPECT_EQ(count, 1);
}

TEST(ParallelFor, KeepsTheOrderOnOneThread) {
  limitThreads(1);
  std::vector<std::size_t> visits;
  parallelFor(100, [&](std::size_t i) { visits.push_back(i); });
  limitThreads(0);
  ASSERT_EQ(visits.size(), 100u);
  EXPECT_TRUE(std::is_sorted(visits.begin(), visits.end()));
}

TEST(ParallelForBlocks, VisitsEveryIndexOnce) {
  for (const std::size_t count : {0, 1, 4095, 4096, 4097, 100000}) {
    std::vector<std::atomic<int>> visits(count);
    parallelForBlocks(count, [&](std::size_t begin, std::size_t end) {
      ASSERT_LT(begin, end);
      for (std::size_t i = begin; i < end; ++i)
        ++visits[i];
    });
    for (const auto& visitCount : visits)
      EXPECT_EQ(visitCount, 1);
  }
}

TEST(ParallelFor, RethrowsAnExceptionOfABody) {
  EXPECT_THROW(parallelFor(100,
                           [](std::size_t i) {
                             if (i == 50)
                               throw std::runtime_error("fifty");
                           }),
               std::runtime_error);
}

TEST(ParallelFor, FinishesALoopWithinABodyWhenAnotherBodyThrows) {
  for (int round = 0; round < 20; ++round) {
    std::atomic<bool> isInnerRunning = false;
    std::atomic<int> unfinished = 0;
    EXPECT_THROW(parallelFor(2,
                             [&](std::size_t i) {
                               if (i == 1) {
                                 for (int wait = 0; wait < 1000 && !isInnerRunning; ++wait)
                                   std::this_thread::sleep_for(std::chrono::microseconds(100));
                                 throw std::runtime_error("outer");
                               }
                               std::atomic<int> visits = 0;
                               parallelFor(200, [&](std::size_t) {
                                 isInnerRunning = true;
                                 std::this_thread::sleep_for(std::chrono::microseconds(50));
                                 ++visits;
                               });
                               unfinished += visits != 200;
                             }),
                 std::runtime_error);
    EXPECT_EQ(unfinished, 0);
  }
}

TEST(Bytes, StoreAndLoadScalarsInTheStatedByteOrder) {
  Bytes bytes;
  appendLittle<std::uint32_t>(bytes, 0x01020304u);
  appendBig<std::uint16_t>(bytes, 0x0506u);
  EXPECT_EQ(bytes, (Bytes{4, 3, 2, 1, 5, 6}));
  EXPECT_EQ(loadLittle<std::uint32_t>(bytes.data()), 0x01020304u);
  EXPECT_EQ(loadBig<std::uint16_t>(bytes.data() + 4), 0x0506u);
}

TEST(Box, ContainsTheAddedPoints) {
  Box3d box;
  EXPECT_TRUE(box.empty());
  EXPECT_EQ(box.size(), Vec3d{});
  box.add({1, 2, 3});
  box.add({-1, 5, 3});
  EXPECT_EQ(box.center(), (Vec3d{0, 3.5, 3}));
  EXPECT_EQ(box.longestEdge(), 3);
}

TEST(ShortestWithin, StaysWithinTheTolerance) {
  EXPECT_EQ(shortestWithin(2.009999990463257, 3e-8), 2.01);
  EXPECT_EQ(shortestWithin(-0.29999, 1e-4), -0.3);
  EXPECT_EQ(shortestWithin(123456.789, 0.5), 123457);
  EXPECT_EQ(shortestWithin(123456.789, 5000), 1.2e5);
  EXPECT_EQ(shortestWithin(1.0 / 3, 0), 1.0 / 3);
  EXPECT_FALSE(std::signbit(shortestWithin(-1e-9, 1e-8)));
  for (double value = 1e-12; value < 1e12; value *= 1.37)
    for (const double tolerance : {value * 1e-9, value * 1e-4, 0.3 * value})
      EXPECT_LE(std::abs(shortestWithin(value, tolerance) - value), tolerance) << value;
}

TEST(File, AFileNamedByItsContentIsRecognised) {
  const std::string hash = contentName(asBytes("content"));
  EXPECT_TRUE(isContentNamed(hash + ".png"));
  EXPECT_TRUE(isContentNamed("coord-0-" + hash + ".bin"));
  EXPECT_TRUE(isContentNamed("imgeo." + hash + ".js"));
}

TEST(File, OtherNamesAreNotContentNames) {
  const std::string hash = contentName(asBytes("content"));
  for (const std::string& name : {std::string("index.html"), hash + "-old.png", "a" + hash + ".png",
                                  hash.substr(1) + ".png", std::string("0123456789ABCDEF.png"), std::string()})
    EXPECT_FALSE(isContentNamed(name)) << name;
}

TEST(UnfinishedFiles, OnlyTheRegisteredOnesAreRemoved) {
  const TemporaryDirectory directory;
  const std::filesystem::path made = directory / "made", staging = made / "staging", kept = directory / "kept";
  std::filesystem::create_directories(staging);
  writeFile(staging / "patch.png", asBytes("patch"));
  writeFile(kept, asBytes("kept"));
  const pid_t child = fork();
  if (child == 0) {
    const UnfinishedFile folder(made, Removal::ifEmpty), site(staging);
    { const UnfinishedFile finished(kept); }
    removeUnfinishedFiles();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_FALSE(std::filesystem::exists(made));
  EXPECT_TRUE(std::filesystem::exists(kept));
}

TEST(UnfinishedFiles, AFolderThatHoldsOtherFilesIsKept) {
  const TemporaryDirectory directory;
  std::filesystem::create_directories(directory / "made");
  writeFile(directory / "made/other", asBytes("other"));
  const pid_t child = fork();
  if (child == 0) {
    const UnfinishedFile folder(directory / "made", Removal::ifEmpty);
    removeUnfinishedFiles();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(std::filesystem::exists(directory / "made/other"));
}

} // namespace
} // namespace imgeo
