#pragma once
// A live stream in memory: the newest frames, each encoded once, for any number of viewers.

#include "live/description.h"

#include <atomic>
#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

namespace imgeo::live {

/// A frame as it was published. Viewers share it for as long as they send it.
class StoredFrame {
public:
  StoredFrame(const FrameHeader& header, Bytes bytes, double addedAt);

  std::uint64_t number() const { return header_.number; }
  std::uint64_t epoch() const { return header_.epoch; }
  double time() const { return header_.time; }
  /// When it was added, in milliseconds of the server's clock (millisecondsNow()).
  double addedAt() const { return addedAt_; }
  const std::shared_ptr<const Bytes>& bytes() const { return bytes_; }
  /// The positions as a PNG (frame_image.h), made at the first call.
  std::shared_ptr<const Bytes> image() const;

private:
  FrameHeader header_;
  double addedAt_;
  std::shared_ptr<const Bytes> bytes_;
  mutable std::once_flag imageOnce_;
  mutable std::shared_ptr<const Bytes> image_;
};

/// What a stream keeps of its past.
struct HistoryLimits {
  std::size_t frames = 30;
  std::size_t bytes = std::size_t{64} << 20; ///< the newest frame is kept even if it is larger
};

/// Safe to use from several threads. No call waits for a viewer.
class Stream {
public:
  /// Numbers begin with `firstNumber`: the milliseconds since 1970, unless tests choose another. `maxRate`: frames per
  /// second, whatever a description announces; 0: no limit.
  Stream(std::string name, HistoryLimits limits, std::uint64_t firstNumber, double maxRate = 0);

  /// Calls that viewers registered with callAtChange() are handed over to `run` instead of being made by the thread
  /// that publishes.
  void setRunner(std::function<void(std::vector<std::function<void()>>)> run);

  const std::string& name() const { return name_; }

  /// Begins an epoch and returns its number, the number of the next frame. A valid description.
  std::uint64_t beginEpoch(Description description);
  /// Adds an encoded frame, which has the next number and the epoch and layout of the last beginEpoch(). Throws
  /// Error{usage} where it has not.
  void add(const FrameHeader& header, Bytes bytes);
  /// Whether another frame may come now: false if frames come faster than their rate, and counted then.
  /// Up to a quarter of a second may come at once.
  bool isDue();
  /// Counts values that a publisher has clamped.
  void countClamped(std::uint64_t values) { clamped_ += values; }
  std::uint64_t clampedCount() const { return clamped_; }
  std::uint64_t droppedCount() const { return dropped_; }
  /// No frame follows, until another epoch begins.
  void end();

  /// The state that a request is answered from.
  struct State {
    std::uint64_t version = 0;                      ///< grows with every change
    std::uint64_t next = 0;                         ///< number of the next frame
    std::uint64_t epoch = 0;                        ///< the current one
    std::shared_ptr<const Description> description; ///< of the current epoch; nullptr before the first
    std::shared_ptr<const StoredFrame> newest;      ///< of the current epoch or one before; nullptr before the first
    std::uint64_t oldest = 0;                       ///< the oldest frame in the history, `next` if there is none
    bool hasEnded = false;
  };
  State state() const;
  /// A frame of the history; nullptr if it is not there.
  std::shared_ptr<const StoredFrame> frame(std::uint64_t number) const;

  /// Calls `call` once, at the next change, unless `owner` is no more. False if the state is no longer `version`; it is
  /// not called then. `call` must not throw and must not wait.
  bool callAtChange(std::uint64_t version, std::weak_ptr<const void> owner, std::function<void()> call);

  /// The response to GET /live/NAME/latest. `isTimed`: whether viewers shall request each frame when it is there,
  /// because a cache between them and the server shares frames among them.
  std::string latest(bool isTimed) const;

  /// When the last frame or epoch was added.
  std::chrono::steady_clock::time_point lastChange() const;

private:
  static constexpr std::size_t minMaxCalls = 64;

  void changed(std::unique_lock<std::mutex>& lock);

  const std::string name_;
  const HistoryLimits limits_;
  const double maxRate_;
  mutable std::mutex mutex_;
  std::function<void(std::vector<std::function<void()>>)> run_;
  std::uint64_t version_ = 0, next_ = 0, epoch_ = 0;
  std::shared_ptr<const Description> description_;
  std::deque<std::shared_ptr<const StoredFrame>> frames_; ///< with consecutive numbers
  std::size_t historyBytes_ = 0;
  bool hasEnded_ = false;
  struct Call {
    std::weak_ptr<const void> owner;
    std::function<void()> call;
  };
  std::vector<Call> calls_;
  std::size_t maxCalls_ = minMaxCalls; ///< with more calls, those without an owner are removed
  std::chrono::steady_clock::time_point lastChange_ = std::chrono::steady_clock::now();
  double allowance_ = 1; ///< frames that may come now
  std::chrono::steady_clock::time_point lastAllowance_;
  std::atomic<std::uint64_t> clamped_{0}, dropped_{0};
};

/// The milliseconds since 1970 by the system's clock, with fractions.
double millisecondsNow();

/// The milliseconds since 1970: the first number of a stream that begins now.
std::uint64_t firstNumberNow();

} // namespace imgeo::live
