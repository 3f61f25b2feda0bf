// A plain main for fuzz targets, so that they are built and run with every test:
// replays a corpus, then mutations of it, the same ones every time.
//
//   ply_fuzz [--rounds N] FILE|DIRECTORY...
//
// An input under which the target dies is left behind as <program>-crash; give
// that file alone to see it again.
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

// Read by the handlers below, which can be given nothing else.
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
  // The target gets a block of exactly its size, so that a sanitizer sees one byte too far.
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

/// Files in the order of their names, so that every run mutates alike.
std::vector<Input> readCorpus(const std::vector<fs::path>& arguments) {
  std::vector<fs::path> paths;
  for (const fs::path& argument : arguments) {
    if (!fs::is_directory(argument))
      paths.push_back(argument);
    else
      for (const auto& entry : fs::recursive_directory_iterator(argument))
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
  std::vector<fs::path> paths;
  for (int i = 1; i < argc; ++i) {
    if (std::string_view(argv[i]) == "--rounds" && i + 1 < argc)
      rounds = std::strtoull(argv[++i], nullptr, 10);
    else
      paths.emplace_back(argv[i]);
  }
  const std::vector<Input> corpus = readCorpus(paths);
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
