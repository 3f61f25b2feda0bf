// A main function for fuzz targets without libFuzzer, so that every test run includes them: replays a corpus, then a
// fixed sequence of mutations of it.
//
//   ply_fuzz [--rounds N] FILE|DIRECTORY...
//
// An input that crashes the target is saved as <program>-crash; run the target with that file alone to reproduce it.
#include "mutate.h"

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" void __attribute__((weak)) __sanitizer_set_death_callback(void (*callback)());

namespace {

namespace fs = std::filesystem;
using imgeo::fuzz::Input;

// Global, since signal handlers take no arguments.
const Input* current = nullptr;
std::string crashPath;

void saveCurrent() {
  if (!current)
    return;
  if (std::FILE* file = std::fopen(crashPath.c_str(), "wb")) {
    std::fwrite(current->data(), 1, current->size(), file);
    std::fclose(file);
  }
  std::fprintf(stderr, "the input is in %s\n", crashPath.c_str());
  current = nullptr;
}

void onSignal(int signal) {
  saveCurrent();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void run(const Input& input) {
  current = &input;
  // A copy of exact size, so that a sanitizer detects a read beyond the end.
  const Input exact(input);
  LLVMFuzzerTestOneInput(exact.data(), exact.size());
  current = nullptr;
}

Input readWhole(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    std::fprintf(stderr, "cannot read %s\n", path.c_str());
    std::exit(1);
  }
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// Reads files in the order of their names, so that every run has the same mutations.
std::vector<Input> readCorpus(const std::vector<fs::path>& filesAndFolders) {
  std::vector<fs::path> paths;
  for (const fs::path& path : filesAndFolders) {
    if (!fs::is_directory(path))
      paths.push_back(path);
    else
      for (const auto& entry : fs::recursive_directory_iterator(path))
        if (entry.is_regular_file())
          paths.push_back(entry.path());
  }
  std::ranges::sort(paths);
  std::vector<Input> corpus;
  for (const fs::path& path : paths)
    corpus.push_back(readWhole(path));
  return corpus;
}

} // namespace

int main(int argc, char** argv) {
  std::size_t rounds = 0;
  std::vector<fs::path> filesAndFolders;
  for (int i = 1; i < argc; ++i) {
    if (std::string_view(argv[i]) == "--rounds" && i + 1 < argc)
      rounds = std::strtoull(argv[++i], nullptr, 10);
    else
      filesAndFolders.emplace_back(argv[i]);
  }
  const std::vector<Input> corpus = readCorpus(filesAndFolders);
  if (corpus.empty()) {
    std::fprintf(stderr, "%s: no corpus\nusage: %s [--rounds N] FILE|DIRECTORY...\n", argv[0], argv[0]);
    return 1;
  }
  crashPath = fs::path(argv[0]).filename().string() + "-crash";
  for (const int signal : {SIGABRT, SIGSEGV, SIGFPE, SIGBUS, SIGILL})
    std::signal(signal, onSignal);
  if (__sanitizer_set_death_callback)
    __sanitizer_set_death_callback(saveCurrent);

  for (const Input& input : corpus)
    run(input);
  imgeo::fuzz::Mutator mutator(corpus);
  for (std::size_t round = 0; round < rounds; ++round)
    run(mutator.next());
  std::printf("%zu seeds and %zu mutations\n", corpus.size(), rounds);
}
