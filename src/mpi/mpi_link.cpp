#include "mpi/mpi_link.h"

#include "base/error.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <mpi.h>
#include <thread>

namespace imgeo {

namespace {

using namespace std::chrono_literals;

constexpr auto firstPoll = 1ms, maxPoll = 50ms;

} // namespace

// The constants of Open MPI are macros that cast through void pointers.
// NOLINTBEGIN(bugprone-casting-through-void)

MpiRanks::MpiRanks() {
  int provided = 0;
  // Threads of ours do not call MPI. By default, errors of MPI end all ranks.
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  if (provided < MPI_THREAD_FUNNELED)
    throw Error(ErrorKind::unsupported, "MPI", "allows no threads");
}

MpiRanks::~MpiRanks() {
  MPI_Finalize();
}

RankOptions MpiRanks::options() {
  int rank = 0, count = 1, onMachine = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &count);
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, rank, MPI_INFO_NULL, &machine);
  MPI_Comm_size(machine, &onMachine);
  MPI_Comm_free(&machine);
  RankOptions options;
  options.rank = static_cast<std::uint32_t>(rank);
  options.count = static_cast<std::uint32_t>(count);
  options.onMachine = static_cast<std::uint32_t>(onMachine);
  options.link = this;
  return options;
}

void MpiRanks::barrier(const std::function<void()>& whileWaiting) {
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibarrier(MPI_COMM_WORLD, &request);
  int isDone = 0;
  MPI_Test(&request, &isDone, MPI_STATUS_IGNORE);
  for (std::chrono::milliseconds interval = firstPoll; !isDone; interval = std::min(2 * interval, maxPoll)) {
    whileWaiting();
    std::this_thread::sleep_for(interval);
    MPI_Test(&request, &isDone, MPI_STATUS_IGNORE);
  }
}

std::string MpiRanks::broadcast(const std::string& text) {
  std::uint64_t size = text.size();
  MPI_Bcast(&size, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
  std::string result = text;
  result.resize(size);
  MPI_Bcast(result.data(), static_cast<int>(size), MPI_CHAR, 0, MPI_COMM_WORLD);
  return result;
}

void MpiRanks::abort(int exitCode) {
  MPI_Abort(MPI_COMM_WORLD, exitCode);
  std::abort();
}

// NOLINTEND(bugprone-casting-through-void)

} // namespace imgeo
