#pragma once
// How ranks without MPI wait for each other: by small files in the work folder, which all of them share. Rank 0
// observes all ranks, and all ranks observe rank 0.
//
//   ranks/join-R      a random name, by which rank R asks rank 0 to admit it
//   ranks/session     the random name of this session, and the names of the ranks that rank 0 has admitted to it
//   ranks/state-R     session, a count that a thread increases as a sign of life, and the barriers that R has reached
//   ranks/failed-R    the sentence with which R has ended
//
// Nothing depends on clocks of several machines: each rank measures by its own clock how long a count stays the same.

#include "imgeo/ranks.h"
#include "transcode/out_of_core/work_folder.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace imgeo {

class FileLink : public RankLink {
public:
  /// Returns when all ranks have joined. Throws Error{io} if one has not within `maxSilenceSeconds`.
  /// `folder`: that of the signals, which rank 0 has made anew.
  FileLink(std::filesystem::path folder, const RankOptions& options, const std::function<void()>& whileWaiting);
  ~FileLink() override;

  const std::string& session() const { return session_; }

  /// Throws Error{io} if another rank has ended, or has given no sign of life for too long.
  void barrier(const std::function<void()>& whileWaiting) override;
  std::string broadcast(const std::string& text) override;

  /// Throws as barrier(). Looks at files at most twice a second.
  void check();
  /// Throws if rank 0 has begun another session.
  void requireSession() const;
  /// Tells the others why this rank ends.
  void fail(const std::string& sentence) const;
  /// The last barrier, which rank 0 reaches when all work is done. Returns to the others then, and to rank 0 when none
  /// of them needs the files any more; does not throw on rank 0.
  void leave(const std::function<void()>& whileWaiting);

private:
  using Clock = std::chrono::steady_clock;

  /// A rank that this one observes.
  struct Observed {
    std::uint32_t rank = 0;
    std::string count; ///< its last sign of life
    Clock::time_point changed;
    std::uint64_t barriers = 0;
  };

  void join(const std::function<void()>& whileWaiting);
  void admit(const std::function<void()>& whileWaiting);
  void beat();
  void arrive();
  bool haveArrived(std::uint64_t number);
  void writeState();
  void observe(Observed& other) const;
  [[noreturn]] void failSilent(std::uint32_t rank, const char* circumstances) const;
  bool isSilent(const Observed& other) const { return Clock::now() - other.changed > maxSilence_; }
  std::string read(const std::string& name) const;
  bool tryWrite(const std::string& name, const std::string& text) const;

  std::filesystem::path folder_;
  RankOptions options_;
  Clock::duration maxSilence_;
  std::string ownName_, session_;
  std::vector<Observed> others_;
  Clock::time_point checked_{};

  std::mutex mutex_; ///< of what follows
  std::condition_variable ends_;
  bool isEnding_ = false;
  std::uint64_t beats_ = 0, barriers_ = 0;
  std::thread beating_;
};

/// A name that no other process has.
std::string randomName();

/// Calls isThere() until it returns true, at growing intervals of up to a fifth of a second.
void pollUntil(const std::function<bool()>& isThere, const std::function<void()>& whileWaiting);

} // namespace imgeo
