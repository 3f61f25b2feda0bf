#include "transcode/out_of_core/passes.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace imgeo {

void Passes::run(const std::string& name, double share, std::size_t count, std::size_t atOnce,
                 const std::string& doneFile, const std::function<std::string(std::size_t)>& fileOf,
                 const std::function<Bytes(std::size_t)>& task, const std::function<Bytes()>& finish) {
  if (work_.has(doneFile)) {
    done_ += share, skipped_ += share;
    return;
  }
  const double each = share / static_cast<double>(std::max<std::size_t>(count, 1));
  for (std::size_t first = 0; first < count; first += atOnce)
    parallelFor(std::min(atOnce, count - first), [&](std::size_t i) {
      const std::string file = fileOf(first + i);
      const bool isThere = work_.has(file);
      if (!isThere)
        work_.write(file, task(first + i));
      const std::lock_guard lock(mutex_);
      done_ += each;
      skipped_ += isThere ? each : 0;
      report(name);
    });
  work_.write(doneFile, finish());
}

void Passes::advance(const std::string& name, double share) {
  const std::lock_guard lock(mutex_);
  done_ += share;
  report(name);
}

void Passes::report(const std::string& name) {
  if (progress_)
    progress_(begin_ + (end_ - begin_) * std::min(done_, 1.0), name + timeLeft());
}

std::string Passes::timeLeft() const {
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const double worked = done_ - skipped_;
  if (seconds < 5 || worked < 0.02) // nothing to judge by yet
    return "";
  const double left = seconds * std::max(1 - done_, 0.0) / worked;
  return left < 90 ? fmt::format(", about {:.0f} s left", std::ceil(left / 10) * 10)
                   : fmt::format(", about {:.0f} min left", std::ceil(left / 60));
}

} // namespace imgeo
