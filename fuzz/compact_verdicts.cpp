// What the C++ decoder says of every file of some directories: a line each of its
// verdict, a tab and its path. tests/verdicts.ts asks the runtime's decoder the same.
//
//   compact_verdicts DIRECTORY... | node tests/verdicts.ts
#include "base/file.h"
#include "containers/compact/verdict.h"

#include <cstdio>
#include <exception>
#include <filesystem>

int main(int argc, char** argv) try {
  for (int i = 1; i < argc; ++i)
    for (const auto& entry : std::filesystem::recursive_directory_iterator(argv[i]))
      if (entry.is_regular_file())
        std::printf("%s\t%s\n", imgeo::compact::testing::verdictOn(imgeo::readFile(entry.path())).c_str(),
                    entry.path().c_str());
} catch (const std::exception& error) {
  std::fprintf(stderr, "compact_verdicts: %s\n", error.what());
  return 1;
}
