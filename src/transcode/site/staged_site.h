#pragma once
// Atomic publication of a site: the directory is built beside its target and replaces it in one step. After a crash the
// target is the old site or the new one; the next run removes what a crashed run left.

#include <filesystem>
#include <functional>
#include <vector>

namespace imgeo {

/// Moves `from` to `to`; `flags` are those of renameat2(2). Returns 0 or an errno.
using Rename = std::function<int(const std::filesystem::path& from, const std::filesystem::path& to, unsigned flags)>;

/// Calls renameat2(2).
int renameBySystem(const std::filesystem::path& from, const std::filesystem::path& to, unsigned flags);

/// A directory under construction. The destructor removes it unless it is published.
class StagedSite {
public:
  /// Makes `.<name>.imgeo-XXXXXX` beside `target` (and the folders above it),
  /// after removing those that killed runs left there.
  ///
  /// Where the target cannot change places with another directory (it is a mount
  /// point or holds the working directory, or the folder above it is not
  /// writable) the staging directory stands inside it, and is published as on
  /// systems without renameat2.
  ///
  /// Throws Error{usage} where the target is a directory that is neither empty
  /// nor a site and `force` does not say that it may be replaced with everything
  /// in it; Error{io} where nothing can be written.
  StagedSite(const std::filesystem::path& target, bool force);
  ~StagedSite();
  StagedSite(const StagedSite&) = delete;
  StagedSite& operator=(const StagedSite&) = delete;

  const std::filesystem::path& path() const { return staging_; }

  /// Puts the staged directory in the target's place: a new target by
  /// RENAME_NOREPLACE, an existing one by RENAME_EXCHANGE, after which the old
  /// one is removed. Where the file system has neither, containers are added
  /// first, the document is renamed last and stale containers are deleted after.
  /// Throws Error; the target is then the old site.
  void publish(const Rename& rename = renameBySystem);

private:
  void makeParentFolders();
  void create(const std::filesystem::path& folder, const std::string& prefix);
  bool exchange(const Rename& rename);
  void publishFileByFile(const Rename& rename);
  void discard() noexcept;

  std::filesystem::path target_, staging_;
  std::vector<std::filesystem::path> foldersMade_; ///< above the target, outermost first
  bool force_ = false, keepsTarget_ = false, published_ = false;
  int lock_ = -1; ///< held on the staging directory: tells a living run from a killed one
};

} // namespace imgeo
