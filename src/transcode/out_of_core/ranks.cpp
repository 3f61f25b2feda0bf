#include "transcode/out_of_core/ranks.h"

#include "base/error.h"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace imgeo {

namespace fs = std::filesystem;

Ranks::Ranks(const RankOptions& options, const fs::path& folder, const std::string& job, bool resume,
             const std::function<void()>& whileWaiting)
    : options_(options) {
  if (isFirst())
    work_.emplace(folder, job, resume);
  if (options.count == 1)
    return;
  if (options.link) {
    session_ = options.link->broadcast(randomName()); // which rank 0 does when it has opened the folder
  } else {
    if (!isFirst())
      lockRank(folder, whileWaiting);
    files_ = std::make_unique<FileLink>(folder / rankFolder, options, whileWaiting);
    session_ = files_->session();
  }
  if (!isFirst())
    openOther(folder, job);
  if (files_)
    work_->guardWrites([this] { files_->requireSession(); });
}

/// Waits until rank 0 has made the work folder.
void Ranks::lockRank(const fs::path& folder, const std::function<void()>& whileWaiting) {
  const auto start = std::chrono::steady_clock::now();
  pollUntil([&] { return isWorkFolder(folder); },
            [&] {
              const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - start;
              if (waited.count() > options_.maxSilenceSeconds)
                throw Error(ErrorKind::io, folder.string(),
                            fmt::format("is not there after {:g} s: rank 0 has given no sign of life, or has ended",
                                        options_.maxSilenceSeconds));
              whileWaiting();
            });
  lock_.emplace(folder, options_.rank);
}

void Ranks::openOther(const fs::path& folder, const std::string& job) {
  try {
    work_.emplace(WorkFolder::ofOtherRank(folder, job, options_.rank));
  } catch (const Error& error) {
    fail(error.what());
    throw;
  }
}

void Ranks::beginMesh(std::size_t number) {
  work_->enter(fmt::format("{}", number));
}

void Ranks::beginSmallMeshes() {
  work_->enter("small");
}

bool Ranks::take(const std::string& task) {
  if (options_.count > 1) {
    const fs::path file =
        work_->path() / rankFolder / fmt::format("taken-{}-{}-{}", session_, work_->subfolder(), task);
    // Where several ranks make the same file exclusively, one succeeds, also on NFS.
    const int descriptor = open(file.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (descriptor < 0 && errno == EEXIST)
      return false;
    if (descriptor < 0)
      throw Error(ErrorKind::io, file.string(), fmt::format("cannot write: {}", std::strerror(errno)));
    close(descriptor);
  }
  ++tasksTaken_;
  return true;
}

void Ranks::barrier(const std::function<void()>& whileWaiting) {
  if (files_)
    files_->barrier(whileWaiting);
  else if (options_.count > 1)
    options_.link->barrier(whileWaiting);
}

void Ranks::check() {
  if (files_)
    files_->check();
}

void Ranks::fail(const std::string& sentence) {
  if (files_)
    files_->fail(sentence);
}

void Ranks::leave(const std::function<void()>& whileWaiting) {
  if (files_)
    files_->leave(whileWaiting);
  else
    barrier(whileWaiting);
}

} // namespace imgeo
