#pragma once
/// @file
/// Processes, on one machine or many, that share a conversion out of core (docs/massive.md, "Many machines").

#include <cstdint>
#include <functional>
#include <string>

namespace imgeo {

/// How processes wait for each other that were started together, such as those of MPI. Called from one thread.
class RankLink {
public:
  RankLink() = default;
  virtual ~RankLink() = default;
  RankLink(const RankLink&) = delete;
  RankLink& operator=(const RankLink&) = delete;

  /// Returns when all ranks have called it. Calls `whileWaiting` again and again; what that throws ends the wait.
  virtual void barrier(const std::function<void()>& whileWaiting) = 0;
  /// Returns the text of rank 0 to all ranks.
  virtual std::string broadcast(const std::string& text) = 0;
};

/// Which of the processes that share a conversion this one is.
struct RankOptions {
  std::uint32_t rank = 0;         ///< 0 .. count - 1; rank 0 writes the site
  std::uint32_t count = 1;        ///< number of processes; 1: this one converts alone
  std::uint32_t onMachine = 1;    ///< how many of them share the memory of this machine
  double maxSilenceSeconds = 120; ///< without a link: how long a rank may give no sign of life
  RankLink* link = nullptr;       ///< nullptr: ranks tell each other by files in the work folder
};

} // namespace imgeo
