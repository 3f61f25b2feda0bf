#include "base/error.h"
#include "cli/commands.h"
#include "cli/heap.h"
#include "cli/interruption.h"
#include "cli/run_and_report.h"
#include "imgeo/version.h"
#include "mpi/mpi_link.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <optional>
#include <thread>

namespace imgeo {

namespace {

constexpr const char* helpText = R"(Usage: mpirun -n N imgeo-mpi convert INPUT -o DIR [OPTIONS]

Converts a mesh to levels of detail, out of core, by N processes on one machine or many. INPUT, DIR
and the work folder are on a file system that all of them share. The options are those of
`imgeo convert` (imgeo convert --help); --levels is always, unless it is stated. --memory and
--threads are for each process.

The bytes of the site are the same for any N. An error ends all processes; with --resume another
run goes on where this one ended.
)";

/// Errors that all ranks find are told by rank 0, which then ends the others.
constexpr std::chrono::seconds headStart(1);

bool has(const std::vector<std::string>& words, const std::string& option) {
  return std::ranges::any_of(words,
                             [&](const std::string& word) { return word == option || word.starts_with(option + "="); });
}

int run(std::vector<std::string> words, const RankOptions& ranks) {
  const bool asksForHelp = has(words, "--help") || has(words, "-h");
  if (words.empty() || asksForHelp || has(words, "--version")) {
    if (ranks.rank == 0)
      fmt::print("{}", asksForHelp || words.empty() ? helpText : fmt::format("imgeo-mpi {}\n", version()));
    return 0;
  }
  if (words[0] != "convert")
    throw Error(ErrorKind::usage, words[0], "imgeo-mpi has the command convert alone");
  for (const char* option : {"--rank", "--ranks", "--silence"})
    if (has(words, option))
      throw Error(ErrorKind::usage, option, "the ranks are those that mpirun starts");
  if (!has(words, "--levels"))
    words.insert(words.begin() + 1, {"--levels", "always"});
  return cli::runConvert(cli::parseArguments(words), &ranks);
}

} // namespace

} // namespace imgeo

int main(int count, char** words) {
  using namespace imgeo;
  cli::prepareHeap();
  cli::handleSignals(); // before MPI starts threads
  MpiRanks mpi;
  const RankOptions ranks = mpi.options();
  const std::string name = ranks.count == 1 ? "imgeo-mpi" : fmt::format("imgeo-mpi: rank {}", ranks.rank);
  const int code = cli::runAndReport(name, [&] {
    try {
      return run({words + 1, words + count}, ranks);
    } catch (const Error&) {
      if (ranks.rank > 0)
        std::this_thread::sleep_for(headStart);
      throw;
    }
  });
  if (code != 0)
    MpiRanks::abort(code);
  return 0;
}
