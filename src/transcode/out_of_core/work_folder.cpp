#include "transcode/out_of_core/work_folder.h"

#include "base/error.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

namespace imgeo {

namespace fs = std::filesystem;

namespace {

constexpr const char* jobName = "job.txt";
constexpr const char* partSuffix = ".part";

[[noreturn]] void failIo(const fs::path& path, const char* action, const std::error_code& reason) {
  throw Error(ErrorKind::io, path.string(), fmt::format("cannot {}: {}", action, std::strerror(reason.value())));
}

/// Opens the folder and locks it until the descriptor is closed.
int lockFolder(const fs::path& folder) {
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0)
    throw Error(ErrorKind::io, folder.string(), fmt::format("cannot open: {}", std::strerror(errno)));
  if (flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    close(descriptor);
    throw Error(ErrorKind::usage, folder.string(), "is the work folder of a run that has not ended");
  }
  return descriptor;
}

} // namespace

void WorkReader::failShort() const {
  throw Error(ErrorKind::malformed, path_, "is no work file of this conversion; convert without --resume");
}

WorkFolder::WorkFolder(fs::path folder, const std::string& job, bool resume) : folder_(std::move(folder)) {
  std::error_code reason;
  const bool exists = fs::is_directory(folder_, reason), isOurs = fs::is_regular_file(folder_ / jobName, reason);
  if (resume && !isOurs)
    throw Error(
        ErrorKind::usage, "--resume",
        fmt::format("there is no work folder of an earlier run at {}: convert without --resume", folder_.string()));
  if (exists && !isOurs && !fs::is_empty(folder_, reason))
    throw Error(ErrorKind::usage, folder_.string(), "is not empty and no work folder of ours; name another by --work");
  if (!exists && !fs::create_directories(folder_, reason) && reason)
    failIo(folder_, "make the directory", reason);
  lock_ = lockFolder(folder_);
  try {
    if (resume) {
      const Bytes earlier = readFile(folder_ / jobName);
      if (asText(earlier) != job)
        throw Error(ErrorKind::usage, "--resume",
                    fmt::format("{} is of another source, other options or another version of imgeo: convert without "
                                "--resume",
                                folder_.string()));
      return;
    }
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_))
      if (entry.path().filename() != jobName)
        fs::remove_all(entry.path());
    write(jobName, asBytes(job));
  } catch (...) {
    close(lock_);
    throw;
  }
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
  const fs::path part = file(name + partSuffix);
  writeFile(part, bytes);
  std::error_code reason;
  fs::rename(part, file(name), reason);
  if (reason)
    failIo(file(name), "write", reason);
}

void WorkFolder::remove(const std::string& name) const {
  std::error_code ignored;
  fs::remove(file(name), ignored);
}

void WorkFolder::removeAll() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

} // namespace imgeo
