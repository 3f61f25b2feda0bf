// Prints the verdict of the C++ decoder on every file of some directories: one line with the verdict, a tab and the
// path. Files are payloads or PNG images that hold one. tests/verdicts.ts compares the runtime's verdicts with these
// lines.
//
//   compact_verdicts DIRECTORY... | node tests/verdicts.ts
#include "base/file.h"
#include "containers/compact/payload_image.h"
#include "containers/compact/verdict.h"

#include <cstdio>
#include <exception>
#include <filesystem>

namespace {

std::string verdictOnFile(const std::filesystem::path& path) {
  const imgeo::Bytes bytes = imgeo::readFile(path);
  if (path.extension() != ".png")
    return imgeo::compact::testing::verdictOn(bytes);
  return imgeo::compact::testing::verdictOf(
      [&] { return imgeo::compact::decodePatches(imgeo::compact::payloadOfImage(bytes, "x.png"), "x.png"); });
}

} // namespace

int main(int argc, char** argv) try {
  for (int i = 1; i < argc; ++i)
    for (const auto& entry : std::filesystem::recursive_directory_iterator(argv[i]))
      if (entry.is_regular_file())
        std::printf("%s\t%s\n", verdictOnFile(entry.path()).c_str(), entry.path().c_str());
} catch (const std::exception& error) {
  std::fprintf(stderr, "compact_verdicts: %s\n", error.what());
  return 1;
}
