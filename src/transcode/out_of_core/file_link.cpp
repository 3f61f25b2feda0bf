#include "transcode/out_of_core/file_link.h"

#include "base/error.h"

#include <algorithm>
#include <fmt/format.h>
#include <random>
#include <sstream>

namespace imgeo {

namespace fs = std::filesystem;

namespace {

using namespace std::chrono_literals;

constexpr auto maxBeat = 5000ms, checkInterval = 500ms, firstPoll = 2ms, maxPoll = 200ms;

std::string joinFile(std::uint32_t rank) {
  return fmt::format("join-{}", rank);
}
std::string stateFile(std::uint32_t rank) {
  return fmt::format("state-{}", rank);
}
std::string failureFile(std::uint32_t rank) {
  return fmt::format("failed-{}", rank);
}
constexpr const char* sessionFile = "session";

} // namespace

std::string randomName() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}", random(), random());
}

void pollUntil(const std::function<bool()>& isThere, const std::function<void()>& whileWaiting) {
  for (std::chrono::milliseconds interval = firstPoll; !isThere(); interval = std::min(2 * interval, maxPoll)) {
    whileWaiting();
    std::this_thread::sleep_for(interval);
  }
}

FileLink::FileLink(fs::path folder, const RankOptions& options, const std::function<void()>& whileWaiting)
    : folder_(std::move(folder)), options_(options), maxSilence_(std::chrono::duration_cast<Clock::duration>(
                                                         std::chrono::duration<double>(options.maxSilenceSeconds))),
      ownName_(randomName()) {
  if (options_.rank == 0)
    admit(whileWaiting);
  else
    join(whileWaiting);
  for (Observed& other : others_)
    other.changed = Clock::now();
  writeState();
  beating_ = std::thread([this] { beat(); });
}

FileLink::~FileLink() {
  {
    const std::lock_guard lock(mutex_);
    isEnding_ = true;
  }
  ends_.notify_all();
  if (beating_.joinable())
    beating_.join();
}

/// Rank 0: waits for the files of all others, and then writes their names.
void FileLink::admit(const std::function<void()>& whileWaiting) {
  session_ = ownName_;
  for (std::uint32_t rank = 1; rank < options_.count; ++rank)
    others_.push_back({rank, {}, {}, 0});
  const Clock::time_point start = Clock::now();
  std::string names = session_;
  for (const Observed& other : others_) {
    std::string name;
    pollUntil(
        [&] {
          name = read(joinFile(other.rank));
          return !name.empty();
        },
        [&] {
          if (Clock::now() - start > maxSilence_)
            failSilent(other.rank, " since rank 0 began");
          whileWaiting();
        });
    names += " " + name;
  }
  if (!tryWrite(sessionFile, names))
    throw Error(ErrorKind::io, folder_.string(), "cannot write the files of ranks");
}

/// Others: asks until rank 0 has written the name.
void FileLink::join(const std::function<void()>& whileWaiting) {
  others_.push_back({0, {}, {}, 0});
  const Clock::time_point start = Clock::now();
  pollUntil(
      [&] {
        if (read(joinFile(options_.rank)) != ownName_) // rank 0 has made the folder anew
          tryWrite(joinFile(options_.rank), ownName_);
        const std::string names = read(sessionFile);
        if (names.find(" " + ownName_) == names.npos)
          return false;
        session_ = names.substr(0, names.find(' '));
        return true;
      },
      [&] {
        if (Clock::now() - start > maxSilence_)
          failSilent(0, ": it does not run, waits for other ranks, or has ended");
        whileWaiting();
      });
}

void FileLink::barrier(const std::function<void()>& whileWaiting) {
  const std::uint64_t number = barriers_ + 1;
  if (options_.rank != 0)
    arrive();
  pollUntil([&] { return haveArrived(number); },
            [&] {
              check();
              whileWaiting();
            });
  if (options_.rank == 0)
    arrive();
}

/// Says that this rank has reached another barrier.
void FileLink::arrive() {
  {
    const std::lock_guard lock(mutex_);
    ++barriers_;
  }
  writeState();
}

/// Whether those that this rank observes have reached a barrier.
bool FileLink::haveArrived(std::uint64_t number) {
  for (Observed& other : others_)
    if (other.barriers < number)
      observe(other);
  return std::ranges::all_of(others_, [&](const Observed& other) { return other.barriers >= number; });
}

std::string FileLink::broadcast(const std::string& text) {
  const std::string name = fmt::format("text-{}-{}", session_, barriers_);
  if (options_.rank == 0 && !tryWrite(name, text))
    throw Error(ErrorKind::io, folder_.string(), "cannot write the files of ranks");
  barrier([] {});
  return read(name);
}

void FileLink::check() {
  if (Clock::now() - checked_ < checkInterval)
    return;
  checked_ = Clock::now();
  requireSession();
  for (Observed& other : others_) {
    if (const std::string sentence = read(failureFile(other.rank)); !sentence.empty())
      throw Error(ErrorKind::io, fmt::format("rank {}", other.rank), fmt::format("has ended: {}", sentence));
    observe(other);
    if (isSilent(other))
      failSilent(other.rank, "");
  }
}

void FileLink::requireSession() const {
  if (const std::string names = read(sessionFile); !names.starts_with(session_))
    throw Error(ErrorKind::io, folder_.string(),
                names.empty() ? "is gone: rank 0 has begun anew, or the work folder is lost"
                              : "rank 0 has begun anew, and this rank is none of its ranks");
}

void FileLink::fail(const std::string& sentence) const {
  tryWrite(failureFile(options_.rank), sentence);
}

void FileLink::leave(const std::function<void()>& whileWaiting) {
  if (options_.rank != 0) {
    barrier(whileWaiting);
    arrive(); // and is not seen any more
    return;
  }
  arrive();
  const std::uint64_t number = barriers_ + 1;
  pollUntil(
      [&] {
        return haveArrived(number) || std::ranges::all_of(others_, [&](const Observed& other) {
                 return other.barriers >= number || isSilent(other) || !read(failureFile(other.rank)).empty();
               });
      },
      whileWaiting);
}

void FileLink::beat() {
  const auto interval = std::min<Clock::duration>(maxBeat, maxSilence_ / 8);
  std::unique_lock lock(mutex_);
  while (!ends_.wait_for(lock, interval, [&] { return isEnding_; })) {
    ++beats_;
    lock.unlock();
    writeState();
    lock.lock();
  }
}

void FileLink::writeState() {
  const std::lock_guard lock(mutex_);
  tryWrite(stateFile(options_.rank), fmt::format("{} {} {}", session_, beats_, barriers_));
}

void FileLink::observe(Observed& other) const {
  std::istringstream words(read(stateFile(other.rank)));
  std::string session, count;
  std::uint64_t barriers = 0;
  if (!(words >> session >> count >> barriers) || session != session_)
    return;
  if (count != other.count || barriers != other.barriers)
    other.changed = Clock::now();
  other.count = count, other.barriers = barriers;
}

void FileLink::failSilent(std::uint32_t rank, const char* circumstances) const {
  throw Error(ErrorKind::io, folder_.parent_path().string(),
              fmt::format("rank {} has given no sign of life for {:g} s{}; begin all ranks again with --resume", rank,
                          options_.maxSilenceSeconds, circumstances));
}

/// The content of a file; "" if it is not there.
std::string FileLink::read(const std::string& name) const {
  try {
    return std::string(asText(readFile(folder_ / name)));
  } catch (const Error&) {
    return "";
  }
}

/// Writes a file under another name and renames it. Returns false if that fails, as where rank 0 makes the folder anew.
bool FileLink::tryWrite(const std::string& name, const std::string& text) const {
  const fs::path part = folder_ / fmt::format("{}.{}", name, ownName_);
  try {
    writeFile(part, asBytes(text));
  } catch (const Error&) {
    return false;
  }
  std::error_code reason;
  fs::rename(part, folder_ / name, reason);
  return !reason;
}

} // namespace imgeo
