#include "transcode/out_of_core/passes.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace imgeo {

namespace {

/// How often rank 0 counts what all ranks have done, which is an access to each missing file.
constexpr std::chrono::seconds countInterval(2);

} // namespace

void Passes::run(const Pass& pass) {
  if (work_.has(pass.doneFile)) {
    done_ += pass.share, skipped_ += pass.share;
    return;
  }
  const double each = pass.share / static_cast<double>(std::max<std::size_t>(pass.count, 1)), before = done_;
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < pass.count; ++i)
    if (!work_.has(pass.fileOf(i)))
      missing.push_back(i);
  skipped_ += each * static_cast<double>(pass.count - missing.size());
  done_ += each * static_cast<double>(pass.count - missing.size());
  taskCount_ += pass.count;
  report(pass.name);
  doShare(pass, each, missing);

  const auto isComplete = [&] {
    std::erase_if(missing, [&](std::size_t i) { return work_.has(pass.fileOf(i)); });
    done_ = before + each * static_cast<double>(pass.count - missing.size()); // with those of other ranks
    return missing.empty();
  };
  const auto whileWaiting = [&] {
    ranks_.check();
    report(pass.name);
  };
  auto counted = std::chrono::steady_clock::now();
  ranks_.barrier([&] {
    if (const auto now = std::chrono::steady_clock::now(); ranks_.isFirst() && now - counted > countInterval) {
      counted = now;
      isComplete();
    }
    report(pass.name);
  });
  // File systems of several machines may show files a little later than they are written.
  pollUntil(isComplete, whileWaiting);
  if (ranks_.isFirst())
    work_.write(pass.doneFile, pass.finish());
  ranks_.barrier([&] { report(pass.name); });
  pollUntil([&] { return work_.has(pass.doneFile); }, whileWaiting);
}

/// Does those of the missing tasks that no other rank takes.
void Passes::doShare(const Pass& pass, double each, std::span<const std::size_t> missing) {
  // Each rank begins elsewhere, so that they seldom want the same task, and takes few at a time, so that all end at
  // about the same time.
  const std::size_t first = missing.size() * ranks_.rank() / ranks_.count();
  for (std::size_t next = 0; next < missing.size();) {
    const std::size_t portion = (missing.size() - next + ranks_.count() - 1) / ranks_.count();
    std::vector<std::size_t> taken;
    for (; next < missing.size() && taken.size() < std::min(pass.atOnce, portion); ++next)
      if (const std::size_t i = missing[(first + next) % missing.size()]; ranks_.take(pass.fileOf(i)))
        taken.push_back(i);
    parallelFor(taken.size(), [&](std::size_t k) {
      work_.write(pass.fileOf(taken[k]), pass.task(taken[k]));
      const std::lock_guard lock(mutex_);
      done_ += each;
      report(pass.name);
    });
    ranks_.check();
  }
}

void Passes::advance(const std::string& name, double share) {
  const std::lock_guard lock(mutex_);
  done_ += share;
  report(name);
}

void Passes::report(const std::string& name) {
  if (progress_)
    progress_(std::lerp(ofMeshes_.begin, ofMeshes_.end, std::min(done_, 1.0)), name + timeLeft());
}

std::string Passes::timeLeft() const {
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const double worked = done_ - skipped_;
  if (seconds < 5 || worked < 0.02) // nothing to judge by yet
    return "";
  const double further = (1 - ofMeshes_.end) / (ofMeshes_.end - ofMeshes_.begin); // meshes
  const double left = seconds * (std::max(1 - done_, 0.0) + further) / worked;
  return left < 90 ? fmt::format(", about {:.0f} s left", std::ceil(left / 10) * 10)
                   : fmt::format(", about {:.0f} min left", std::ceil(left / 60));
}

} // namespace imgeo
