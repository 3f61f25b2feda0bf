#pragma once
// Atomic publication of a site: the directory is built beside its target and replaces it in one step. After a crash the
// target is the old site or the new one; the next run removes what a crashed run left.

#include "base/unfinished_files.h"

#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

namespace imgeo {

/// Moves `from` to `to`; `flags` are those of renameat2(2). Returns 0 or an errno.
using Rename = std::function<int(const std::filesystem::path& from, const std::filesystem::path& to, unsigned flags)>;

/// Calls renameat2(2).
int renameBySystem(const std::filesystem::path& from, const std::filesystem::path& to, unsigned flags);

/// A directory under construction. The destructor removes it unless it is published.
class StagedSite {
public:
  /// Makes the staging directory `.<name>.imgeo-XXXXXX` beside `target`, and missing parent folders. Removes staging
  /// directories that killed runs left there.
  ///
  /// If the target cannot be exchanged with another directory (it is a mount point or contains the working directory,
  /// or its parent is not writable), the staging directory is inside the target, and is published as on file systems
  /// without renameat2.
  ///
  /// Throws Error{usage} if the target is a directory that is neither empty nor a site, or a site with a file that
  /// convert has not written, unless `force` allows to replace it with everything in it; Error{io} if the target is a
  /// file or nothing can be written.
  StagedSite(const std::filesystem::path& target, bool force);
  ~StagedSite();
  StagedSite(const StagedSite&) = delete;
  StagedSite& operator=(const StagedSite&) = delete;

  const std::filesystem::path& path() const { return staging_; }

  /// Renames the staging directory to the target: a new target by RENAME_NOREPLACE; an existing one by RENAME_EXCHANGE,
  /// after which the destructor removes the old one. On file systems that support neither, moves the files one by one,
  /// the page last, and then deletes the remaining files of the old site. Throws Error; the target's page is then the
  /// old one.
  void publish(const Rename& rename = renameBySystem);

private:
  void makeParentFolders();
  void create(const std::filesystem::path& folder, const std::string& prefix);
  bool exchange(const Rename& rename);
  void publishFileByFile(const Rename& rename);
  void discard() noexcept;

  std::filesystem::path target_, staging_;
  std::optional<UnfinishedFile> unfinished_;       ///< staging_
  std::vector<std::filesystem::path> foldersMade_; ///< above the target, outermost first
  std::deque<UnfinishedFile> unfinishedFolders_;   ///< the same folders
  bool force_ = false, keepsTarget_ = false, published_ = false;
  int lock_ = -1; ///< held on the staging directory: tells a living run from a killed one
};

} // namespace imgeo
