#include "transcode/out_of_core/work_folder.h"

#include "base/error.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>
#include <utility>

namespace imgeo {

namespace fs = std::filesystem;

namespace {

constexpr const char* partInfix = ".part";
constexpr const char* lockExtension = ".lock";

[[noreturn]] void failIo(const fs::path& path, const char* action, const std::error_code& reason) {
  throw Error(ErrorKind::io, path.string(), fmt::format("cannot {}: {}", action, std::strerror(reason.value())));
}

/// Locks what `flags` open until the descriptor is closed. File systems without locks are used without.
int lockedDescriptor(const fs::path& path, int flags, const std::string& refusal) {
  const int descriptor = open(path.c_str(), flags | O_CLOEXEC, 0666);
  if (descriptor < 0)
    throw Error(ErrorKind::io, path.string(), fmt::format("cannot open: {}", std::strerror(errno)));
  if (flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    close(descriptor);
    throw Error(ErrorKind::usage, path.string(), refusal);
  }
  return descriptor;
}

/// Removes what an earlier run has left: all but the job and the locks, or with `resume` what is of no use.
void clean(const fs::path& folder, bool resume) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const fs::path name = entry.path().filename();
    if (name == workJobName || name == rankFolder || name.extension() == lockExtension)
      continue;
    if (!resume || name.string().find(partInfix) != std::string::npos)
      fs::remove_all(entry.path());
    else if (entry.is_directory())
      clean(entry.path(), resume);
  }
}

void cleanRanks(const fs::path& folder) {
  fs::create_directory(folder / rankFolder);
  std::error_code ignored; // other ranks of this run may write there already
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / rankFolder))
    fs::remove(entry.path(), ignored);
}

} // namespace

void WorkReader::failShort() const {
  throw Error(ErrorKind::malformed, path_, "is no work file of this conversion; convert without --resume");
}

WorkFolder::WorkFolder(fs::path folder, const std::string& job, bool resume) : folder_(std::move(folder)) {
  std::error_code reason;
  const bool exists = fs::is_directory(folder_, reason), isOurs = isWorkFolder(folder_);
  if (resume && !isOurs)
    throw Error(
        ErrorKind::usage, "--resume",
        fmt::format("there is no work folder of an earlier run at {}: convert without --resume", folder_.string()));
  if (exists && !isOurs && !fs::is_empty(folder_, reason))
    throw Error(ErrorKind::usage, folder_.string(), "is not empty and no work folder of ours; name another by --work");
  if (!exists && !fs::create_directories(folder_, reason) && reason)
    failIo(folder_, "make the directory", reason);
  lock_ = lockedDescriptor(folder_, O_RDONLY | O_DIRECTORY, "is the work folder of a run that has not ended");
  try {
    if (resume)
      requireJob(job);
    clean(folder_, resume);
    cleanRanks(folder_);
    if (!resume)
      write(workJobName, asBytes(job));
  } catch (...) {
    close(lock_);
    throw;
  }
}

WorkFolder::WorkFolder(fs::path folder, std::uint32_t rank)
    : folder_(std::move(folder)), partSuffix_(fmt::format("{}-{}", partInfix, rank)) {}

WorkFolder::WorkFolder(WorkFolder&& other) noexcept
    : folder_(std::move(other.folder_)), subfolder_(std::move(other.subfolder_)),
      partSuffix_(std::move(other.partSuffix_)), guard_(std::move(other.guard_)),
      lock_(std::exchange(other.lock_, -1)) {}

void WorkFolder::enter(const std::string& subfolder) {
  subfolder_ = subfolder;
  std::error_code reason;
  fs::create_directories(folder_ / subfolder_, reason);
  if (reason)
    failIo(folder_ / subfolder_, "make the directory", reason);
}

void WorkFolder::removeSubfolder() {
  std::error_code ignored;
  if (!subfolder_.empty())
    fs::remove_all(folder_ / subfolder_, ignored);
  subfolder_.clear();
}

WorkFolder WorkFolder::ofOtherRank(fs::path folder, const std::string& job, std::uint32_t rank) {
  WorkFolder work(std::move(folder), rank);
  work.requireJob(job);
  return work;
}

void WorkFolder::requireJob(const std::string& job) const {
  const Bytes earlier = readFile(folder_ / workJobName);
  if (asText(earlier) != job)
    throw Error(ErrorKind::usage, folder_.string(),
                "is of another source, other options or another version of imgeo: convert without --resume, and all "
                "ranks with the same options");
}

WorkFolder::~WorkFolder() {
  if (lock_ >= 0)
    close(lock_);
}

bool WorkFolder::has(const std::string& name) const {
  std::error_code ignored;
  return fs::is_regular_file(file(name), ignored);
}

void WorkFolder::write(const std::string& name, ByteSpan bytes) const {
  const fs::path part = file(name + partSuffix_);
  writeFile(part, bytes);
  if (guard_)
    guard_();
  std::error_code reason;
  fs::rename(part, file(name), reason);
  if (reason)
    failIo(file(name), "write", reason);
}

void WorkFolder::requireDisk(std::uint64_t bytes) const {
  std::error_code reason;
  const auto space = fs::space(folder_, reason);
  if (!reason && space.available < bytes)
    throw Error(ErrorKind::io, folder_.string(),
                fmt::format("has {} MB left, and the work files take about {}; --work names another folder",
                            space.available / 1'000'000, bytes / 1'000'000));
}

void WorkFolder::remove(const std::string& name) const {
  std::error_code ignored;
  fs::remove(file(name), ignored);
}

void WorkFolder::removeAll() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

bool isWorkFolder(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_regular_file(folder / workJobName, ignored);
}

RankLock::RankLock(const fs::path& workFolder, std::uint32_t rank)
    : lock_(lockedDescriptor(workFolder / fmt::format("rank-{}{}", rank, lockExtension), O_RDWR | O_CREAT,
                             "is of a process of the same rank that has not ended")) {}

RankLock::~RankLock() {
  close(lock_);
}

} // namespace imgeo
