#pragma once
// Passes of independent tasks, each of which writes a work file. What an earlier run has written is not done again.
// Several ranks share the tasks of a pass, and begin the next when all tasks of it are done.

#include "imgeo/convert.h"
#include "transcode/out_of_core/ranks.h"

#include <chrono>
#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <vector>

namespace imgeo {

/// Where the work on a mesh begins and ends in the work on all meshes, which goes from 0 to 1.
struct ShareOfMeshes {
  double begin = 0, end = 1;
};

/// Independent tasks, of which each writes a file.
struct Pass {
  std::string name;       ///< what progress says
  double share = 0;       ///< of the work on the mesh
  std::size_t count = 1;  ///< of the tasks
  std::size_t atOnce = 1; ///< tasks in parallel
  std::string doneFile;   ///< nothing is done if it is there
  std::function<std::string(std::size_t)> fileOf;
  std::function<Bytes(std::size_t)> task; ///< gives the content of its file
  /// Gives the content of `doneFile`, on rank 0 after all tasks.
  std::function<Bytes()> finish = [] { return Bytes(); };
};

class Passes {
public:
  /// `progress` gets the share of the work on all meshes that is done, and how long the rest will take.
  Passes(Ranks& ranks, const Progress& progress, ShareOfMeshes share)
      : ranks_(ranks), work_(ranks.work()), progress_(progress), ofMeshes_(share) {}

  /// Runs the tasks whose files are not there. Returns when `doneFile` is there.
  void run(const Pass& pass);

  /// Work that is no pass.
  void advance(const std::string& name, double share);

  std::size_t taskCount() const { return taskCount_; } ///< of the passes that have been run

private:
  void doShare(const Pass& pass, double each, std::span<const std::size_t> missing);
  void report(const std::string& name);
  std::string timeLeft() const;

  Ranks& ranks_;
  const WorkFolder& work_;
  const Progress& progress_;
  ShareOfMeshes ofMeshes_;
  double done_ = 0, skipped_ = 0; ///< shares of the work on the mesh; those that an earlier run has done
  std::size_t taskCount_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
};

} // namespace imgeo
