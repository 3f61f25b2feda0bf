#include "transcode/site/staged_site.h"

#include "transcode/site/site_files.h"

#include "base/error.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <random>
#include <set>
#include <string>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace imgeo {

namespace fs = std::filesystem;

namespace {

// Flags of renameat2(2). linux/fs.h defines them, but also macros that break other headers.
constexpr unsigned renameNoReplace = 1, renameExchange = 2;

[[noreturn]] void fail(const fs::path& file, const char* action, int reason) {
  throw Error(ErrorKind::io, file.string(), fmt::format("cannot {}: {}", action, std::strerror(reason)));
}

bool isSite(const fs::path& directory) {
  std::error_code ignored;
  return fs::is_regular_file(directory / manifestName, ignored);
}

/// Refuses to replace a directory that is neither empty nor a site, or a site with files of somebody else, unless
/// forced.
void requireReplaceable(const fs::path& target, bool force) {
  std::error_code reason;
  const fs::file_status status = fs::status(target, reason);
  if (!fs::exists(status))
    return;
  if (!fs::is_directory(status))
    throw Error(ErrorKind::io, target.string(), "exists and is not a directory");
  if (force)
    return;
  if (isSite(target)) {
    if (const std::optional<fs::path> foreign = foreignFileIn(target))
      throw Error(ErrorKind::usage, (target / *foreign).string(),
                  "is in the site but was not written by imgeo; --force replaces the site with everything in it");
    return;
  }
  const bool empty = fs::is_empty(target, reason);
  if (reason)
    fail(target, "read", reason.value());
  if (!empty)
    throw Error(ErrorKind::usage, target.string(),
                "is not empty and not a site of ours; --force replaces it with everything in it");
}

bool holdsWorkingDirectory(const fs::path& target) {
  std::error_code ignored;
  const fs::path here = fs::current_path(ignored);
  return std::mismatch(target.begin(), target.end(), here.begin(), here.end()).first == target.end();
}

bool isMountPoint(const fs::path& directory) {
  struct stat own {
  }, parent{};
  return stat(directory.c_str(), &own) == 0 && stat((directory / "..").c_str(), &parent) == 0 &&
         (own.st_dev != parent.st_dev || own.st_ino == parent.st_ino);
}

/// Locks a directory (flock(2)) until the returned descriptor is closed; -1 if another run holds the lock or the
/// directory has been removed. The system unlocks it when the process ends.
int lockDirectory(const fs::path& directory, int operation) {
  const int descriptor = open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC | O_NOFOLLOW);
  if (descriptor < 0)
    return -1;
  struct stat held {
  }, named{};
  if (flock(descriptor, operation) == 0 && fstat(descriptor, &held) == 0 && stat(directory.c_str(), &named) == 0 &&
      held.st_ino == named.st_ino)
    return descriptor;
  close(descriptor);
  return -1;
}

/// Removes those staging directories in `folder` that no running process has locked.
void removeAbandoned(const fs::path& folder, const std::string& prefix) {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename();
    if (!name.starts_with(prefix) || name.size() != prefix.size() + 6)
      continue;
    const int lock = lockDirectory(entry.path(), LOCK_EX | LOCK_NB);
    if (lock < 0)
      continue;
    fs::remove_all(entry.path(), ignored);
    close(lock);
  }
}

std::string randomSuffix() {
  static constexpr char alphabet[] = "abcdefghijklmnopqrstuvwxyz0123456789";
  std::random_device random;
  std::uniform_int_distribution<std::size_t> pick(0, sizeof alphabet - 2);
  std::string suffix(6, ' ');
  for (char& character : suffix)
    character = alphabet[pick(random)];
  return suffix;
}

/// Every file of a staged site, relative to its root, each after the files that it refers to: the page comes last.
std::vector<fs::path> filesInDependencyOrder(const fs::path& staging) {
  std::vector<fs::path> files = filesIn(staging);
  const auto rank = [](fs::path file) {
    if (isPrecompressed(file))
      file.replace_extension();
    return file == pageName ? 3 : file == manifestName ? 2 : file.has_parent_path() ? 0 : 1;
  };
  std::ranges::sort(
      files, [&](const fs::path& a, const fs::path& b) { return std::pair(rank(a), a) < std::pair(rank(b), b); });
  return files;
}

} // namespace

int renameBySystem(const fs::path& from, const fs::path& to, unsigned flags) {
  return syscall(SYS_renameat2, AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), flags) == 0 ? 0 : errno;
}

StagedSite::StagedSite(const fs::path& target, bool force) : force_(force) {
  std::error_code reason;
  target_ = fs::weakly_canonical(fs::absolute(target), reason);
  if (reason)
    fail(target, "write", reason.value());
  if (!target_.has_filename())
    target_ = target_.parent_path();
  requireReplaceable(target_, force);
  const bool exists = fs::is_directory(target_, reason);
  const fs::path parent = target_.parent_path();
  keepsTarget_ =
      exists && (holdsWorkingDirectory(target_) || isMountPoint(target_) || access(parent.c_str(), W_OK) != 0);
  try {
    if (!exists)
      makeParentFolders();
    if (keepsTarget_)
      create(target_, stagingPrefix);
    else
      create(parent, fmt::format(".{}.imgeo-", target_.filename().string()));
  } catch (...) {
    discard();
    throw;
  }
}

StagedSite::~StagedSite() {
  discard();
}

void StagedSite::makeParentFolders() {
  std::vector<fs::path> missing;
  std::error_code ignored;
  for (fs::path folder = target_.parent_path(); !fs::exists(folder, ignored); folder = folder.parent_path())
    missing.push_back(folder);
  for (auto folder = missing.rbegin(); folder != missing.rend(); ++folder) {
    if (mkdir(folder->c_str(), 0777) != 0 && errno != EEXIST)
      fail(*folder, "make the directory", errno);
    foldersMade_.push_back(*folder);
    unfinishedFolders_.emplace_back(*folder, Removal::ifEmpty);
  }
}

void StagedSite::create(const fs::path& folder, const std::string& prefix) {
  removeAbandoned(folder, prefix);
  while (lock_ < 0) {
    staging_ = folder / (prefix + randomSuffix());
    if (mkdir(staging_.c_str(), 0777) != 0) {
      if (errno == EEXIST)
        continue;
      const int reason = errno;
      staging_.clear();
      fail(target_, "write", reason);
    }
    // Another run may remove the directory as abandoned before this run locks it. Then lockDirectory fails, and the
    // loop makes another directory.
    unfinished_.emplace(staging_);
    lock_ = lockDirectory(staging_, LOCK_EX);
    std::error_code ignored;
    if (lock_ < 0 && fs::exists(staging_, ignored))
      break; // a file system without locks
  }
}

void StagedSite::publish(const Rename& rename) {
  const auto publishing = holdUnfinishedFiles();
  std::error_code ignored;
  struct stat old {};
  if (stat(target_.c_str(), &old) == 0)
    fs::permissions(staging_, fs::perms(old.st_mode & 07777), ignored);
  if (keepsTarget_ || !exchange(rename))
    publishFileByFile(rename);
  published_ = true;
}

/// Renames the staged directory to the target and an old target to the staging path. Returns false, without a change,
/// if a target exists and the file system does not support the flags of renameat2.
bool StagedSite::exchange(const Rename& rename) {
  // Another run may add or remove the target between our two attempts.
  for (int attempt = 0; attempt < 100; ++attempt) {
    int reason = rename(staging_, target_, renameNoReplace);
    if (reason == 0)
      return true;
    if (reason == EEXIST) {
      requireReplaceable(target_, force_);
      reason = rename(staging_, target_, renameExchange);
      if (reason == 0)
        return true;
    }
    if (reason == EINVAL || reason == ENOSYS || reason == ENOTSUP)
      break;
    if (reason != EEXIST && reason != ENOENT)
      fail(target_, "put the new site in place", reason);
  }
  std::error_code ignored;
  if (fs::exists(target_, ignored))
    return false;
  const int reason = rename(staging_, target_, 0);
  if (reason != 0)
    fail(target_, "put the new site in place", reason);
  return true;
}

void StagedSite::publishFileByFile(const Rename& rename) {
  const std::vector<fs::path> files = filesInDependencyOrder(staging_);
  std::set<fs::path> kept;
  for (const fs::path& file : files) {
    std::error_code reason;
    fs::create_directories((target_ / file).parent_path(), reason);
    if (reason)
      fail((target_ / file).parent_path(), "make the directory", reason.value());
    const int failure = rename(staging_ / file, target_ / file, 0);
    if (failure != 0)
      fail(target_ / file, "put the new file in place", failure);
    kept.insert(file);
  }
  std::error_code ignored;
  for (const fs::path& file : filesIn(target_))
    if (isSiteFile(file) && !kept.contains(file))
      fs::remove(target_ / file, ignored);
}

/// Removes the directory at the staging path: an unfinished site or, after an exchange, the old site.
void StagedSite::discard() noexcept {
  std::error_code ignored;
  if (!staging_.empty())
    fs::remove_all(staging_, ignored);
  if (lock_ >= 0)
    close(lock_);
  lock_ = -1;
  if (!published_)
    for (auto folder = foldersMade_.rbegin(); folder != foldersMade_.rend(); ++folder)
      rmdir(folder->c_str());
}

} // namespace imgeo
