#pragma once
// The ranks of MPI.

#include "imgeo/ranks.h"

namespace imgeo {

/// Which rank of MPI this process is, from MPI_Init to MPI_Finalize.
class MpiRanks : public RankLink {
public:
  MpiRanks();
  /// Waits for all ranks.
  ~MpiRanks() override;

  RankOptions options();
  /// Waits without using a processor.
  void barrier(const std::function<void()>& whileWaiting) override;
  std::string broadcast(const std::string& text) override;

  /// Ends the processes of all ranks.
  [[noreturn]] static void abort(int exitCode);
};

} // namespace imgeo
