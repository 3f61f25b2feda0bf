#include "live/stream.h"

#include "base/error.h"
#include "live/frame_image.h"

#include <algorithm>
#include <fmt/format.h>

namespace imgeo::live {

StoredFrame::StoredFrame(const FrameHeader& header, Bytes bytes, double addedAt)
    : header_(header), addedAt_(addedAt), bytes_(std::make_shared<const Bytes>(std::move(bytes))) {}

std::shared_ptr<const Bytes> StoredFrame::image() const {
  std::call_once(imageOnce_, [this] { image_ = std::make_shared<const Bytes>(imageOfFrame(*bytes_, "")); });
  return image_;
}

Stream::Stream(std::string name, HistoryLimits limits, std::uint64_t firstNumber, double maxRate)
    : name_(std::move(name)), limits_(limits), maxRate_(maxRate), run_([](const auto& calls) {
        for (const auto& call : calls)
          call();
      }),
      next_(firstNumber), epoch_(firstNumber) {}

void Stream::setRunner(std::function<void(std::vector<std::function<void()>>)> run) {
  const std::lock_guard lock(mutex_);
  run_ = std::move(run);
}

std::uint64_t Stream::beginEpoch(Description description) {
  std::unique_lock lock(mutex_);
  description_ = std::make_shared<const Description>(std::move(description));
  epoch_ = next_;
  hasEnded_ = false;
  changed(lock);
  return epoch_;
}

void Stream::add(const FrameHeader& header, Bytes bytes) {
  std::unique_lock lock(mutex_);
  if (!description_ || header.epoch != epoch_ || header.layout != description_->layout)
    throw Error(ErrorKind::usage, name_, fmt::format("the frame is not of the stream's epoch, {}", epoch_));
  if (header.number != next_)
    throw Error(ErrorKind::usage, name_, fmt::format("the frame has number {}, the next is {}", header.number, next_));
  historyBytes_ += bytes.size();
  frames_.push_back(std::make_shared<const StoredFrame>(header, std::move(bytes), millisecondsNow()));
  while (frames_.size() > 1 && (frames_.size() > limits_.frames || historyBytes_ > limits_.bytes)) {
    historyBytes_ -= frames_.front()->bytes()->size();
    frames_.pop_front();
  }
  ++next_;
  hasEnded_ = false;
  changed(lock);
}

bool Stream::isDue() {
  const std::lock_guard lock(mutex_);
  const double announced = description_ ? description_->rate : 0;
  const double rate = announced > 0 && maxRate_ > 0 ? std::min(announced, maxRate_) : std::max(announced, maxRate_);
  if (rate <= 0)
    return true;
  const auto now = std::chrono::steady_clock::now();
  const std::chrono::duration<double> elapsed = now - lastAllowance_;
  lastAllowance_ = now;
  // A tenth more than the rate, so that clocks that differ a little lose no frame.
  allowance_ = std::min(1 + rate / 4, allowance_ + 1.1 * rate * elapsed.count());
  if (allowance_ < 1) {
    ++dropped_;
    return false;
  }
  allowance_ -= 1;
  return true;
}

void Stream::end() {
  std::unique_lock lock(mutex_);
  hasEnded_ = true;
  changed(lock);
}

void Stream::changed(std::unique_lock<std::mutex>& lock) {
  ++version_;
  lastChange_ = std::chrono::steady_clock::now();
  std::vector<std::function<void()>> calls;
  for (Call& call : calls_)
    if (!call.owner.expired())
      calls.push_back(std::move(call.call));
  calls_.clear();
  const auto run = run_;
  lock.unlock();
  if (!calls.empty())
    run(std::move(calls));
}

Stream::State Stream::state() const {
  const std::lock_guard lock(mutex_);
  State state{version_, next_, epoch_, description_, {}, next_, hasEnded_};
  if (!frames_.empty()) {
    state.newest = frames_.back();
    state.oldest = frames_.front()->number();
  }
  return state;
}

std::shared_ptr<const StoredFrame> Stream::frame(std::uint64_t number) const {
  const std::lock_guard lock(mutex_);
  if (frames_.empty() || number < frames_.front()->number() || number >= next_)
    return nullptr;
  return frames_[static_cast<std::size_t>(number - frames_.front()->number())];
}

bool Stream::callAtChange(std::uint64_t version, std::weak_ptr<const void> owner, std::function<void()> call) {
  const std::lock_guard lock(mutex_);
  if (version != version_)
    return false;
  // Viewers who have given up leave their calls behind.
  if (calls_.size() >= maxCalls_) {
    std::erase_if(calls_, [](const Call& old) { return old.owner.expired(); });
    maxCalls_ = std::max(minMaxCalls, 2 * calls_.size());
  }
  calls_.push_back({std::move(owner), std::move(call)});
  return true;
}

std::chrono::steady_clock::time_point Stream::lastChange() const {
  const std::lock_guard lock(mutex_);
  return lastChange_;
}

std::string Stream::latest(bool isTimed) const {
  const State now = state();
  std::string json = fmt::format("{{\"name\": \"{}\", \"epoch\": {}, \"next\": {}, ", name_, now.epoch, now.next);
  if (now.newest)
    json += fmt::format("\"number\": {}, \"oldest\": {}, \"time\": {}, \"added\": {:.1f}, \"bytes\": {}, ",
                        now.newest->number(), now.oldest, now.newest->time(), now.newest->addedAt(),
                        now.newest->bytes()->size());
  else
    json += R"("number": null, "oldest": null, "time": null, "added": null, "bytes": null, )";
  if (now.description)
    json += describe(*now.description) + ", ";
  return json + fmt::format("\"ended\": {}, \"clamped\": {}, \"dropped\": {}, \"timed\": {}, \"now\": {:.1f}}}\n",
                            now.hasEnded, clamped_.load(), dropped_.load(), isTimed, millisecondsNow());
}

double millisecondsNow() {
  return std::chrono::duration<double, std::milli>(std::chrono::system_clock::now().time_since_epoch()).count();
}

std::uint64_t firstNumberNow() {
  return static_cast<std::uint64_t>(millisecondsNow());
}

} // namespace imgeo::live
