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

class Passes {
public:
  /// `progress` gets the share of the work on all meshes that is done, and how long the rest will take.
  Passes(Ranks& ranks, const Progress& progress, ShareOfMeshes share)
      : ranks_(ranks), work_(ranks.work()), progress_(progress), ofMeshes_(share) {}

  /// Calls task(i) for each i whose file fileOf(i) is not there, `atOnce` in parallel, and writes what it returns.
  /// `share`: of the work on the mesh. `name` is what progress says. Nothing is done if the file `doneFile` is there,
  /// to which finish() gives its content on rank 0 after all tasks. Returns when `doneFile` is there.
  void run(const std::string& name, double share, std::size_t count, std::size_t atOnce, const std::string& doneFile,
           const std::function<std::string(std::size_t)>& fileOf, const std::function<Bytes(std::size_t)>& task,
           const std::function<Bytes()>& finish);

  /// Work that is no pass.
  void advance(const std::string& name, double share);

  std::size_t taskCount() const { return taskCount_; } ///< of the passes that have been run

private:
  void doShare(const std::string& name, double each, std::span<const std::size_t> missing, std::size_t atOnce,
               const std::function<std::string(std::size_t)>& fileOf, const std::function<Bytes(std::size_t)>& task);
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
