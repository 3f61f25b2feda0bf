#pragma once
// The processes that share a conversion out of core. Each takes tasks that no other has taken; all wait for each other
// after each pass.

#include "transcode/out_of_core/file_link.h"

#include <memory>
#include <optional>

namespace imgeo {

class Ranks {
public:
  /// Opens the work folder: rank 0 as WorkFolder does, the others when rank 0 has done so. Throws as WorkFolder and
  /// FileLink do, and Error{usage} if the job of another rank differs.
  Ranks(const RankOptions& options, const std::filesystem::path& folder, const std::string& job, bool resume,
        const std::function<void()>& whileWaiting);
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  const WorkFolder& work() const { return *work_; }
  std::uint32_t count() const { return options_.count; }
  std::uint32_t rank() const { return options_.rank; }
  bool isFirst() const { return options_.rank == 0; }
  std::size_t tasksTaken() const { return tasksTaken_; }

  /// Begins with another mesh, whose files are in a folder of their own within the work folder. All ranks do this.
  void beginMesh(std::size_t number);
  /// Begins with the meshes that rank 0 converts alone, whose files are in a folder of their own likewise.
  void beginSmallMeshes();
  /// Takes a task for this rank. Returns false if another rank has taken it in this session.
  bool take(const std::string& task);
  /// Returns when all ranks have called it. Throws Error{io} if one has ended or is silent.
  void barrier(const std::function<void()>& whileWaiting);
  /// Throws as barrier().
  void check();
  /// Tells the others why this rank ends.
  void fail(const std::string& sentence);
  /// Ends the work together: rank 0 calls it when the site is in its place, and returns when no other rank needs the
  /// work folder. The others wait for that; throws as barrier() for them.
  void leave(const std::function<void()>& whileWaiting);
  /// Removes the work folder.
  void removeWork() { work_->removeAll(); }

private:
  void lockRank(const std::filesystem::path& folder, const std::function<void()>& whileWaiting);

  void openOther(const std::filesystem::path& folder, const std::string& job);

  RankOptions options_;
  std::optional<RankLock> lock_; ///< of other ranks than 0, which locks the work folder
  std::optional<WorkFolder> work_;
  std::unique_ptr<FileLink> files_; ///< of several ranks without a link
  std::string session_;
  std::size_t tasksTaken_ = 0;
};

} // namespace imgeo
