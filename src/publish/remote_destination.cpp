#include "publish/destination.h"
#include "publish/http_client.h"

#include "base/error.h"

#include <condition_variable>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <thread>

namespace imgeo::live {

namespace {

constexpr auto retryDelay = std::chrono::seconds(1);

/// One thread sends what publish() has left for it: the newest description, if it is new, and the newest frame.
class RemoteDestination final : public Destination {
public:
  RemoteDestination(const std::string& server, const std::string& name, std::string token)
      : server_(server), name_(name), target_("/live/" + name), token_(std::move(token)),
        client_(parseServerAddress(server)), thread_([this](const std::stop_token& stop) { send(stop); }) {}

  void beginEpoch(const Description& description) override {
    const std::lock_guard lock(mutex_);
    description_ = description;
    isAnnounced_ = false;
    frame_.reset();
    changed_.notify_all();
  }

  bool isDue() override { return true; }

  PublishReport publish(Frame frame) override {
    const std::lock_guard lock(mutex_);
    if (frame_)
      ++totals_.dropped;
    frame_ = std::move(frame);
    changed_.notify_all();
    return {};
  }

  void countClamped(std::uint64_t values) override {
    const std::lock_guard lock(mutex_);
    totals_.clamped += values;
  }

  PublisherTotals totals() const override {
    const std::lock_guard lock(mutex_);
    return totals_;
  }

  std::string url() const override { return server_ + (server_.ends_with('/') ? "live/" : "/live/") + name_; }

private:
  bool hasWork() const { return description_ && (!isAnnounced_ || frame_); }

  void send(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (true) {
      changed_.wait(lock, stop, [this] { return hasWork(); });
      if (stop.stop_requested() && (!hasWork() || !totals_.failure.empty()))
        break;
      try {
        sendOne(lock);
        totals_.failure.clear();
      } catch (const Error& error) {
        if (!lock.owns_lock())
          lock.lock();
        totals_.failure = error.what();
        isAnnounced_ = false;
        changed_.wait_for(lock, stop, retryDelay, [] { return false; });
      }
    }
    lock.unlock();
    try {
      client_.send("DELETE", target_, "application/json", token_, {});
    } catch (const Error&) {
      // The server is gone; so is the stream.
    }
  }

  /// Announces the epoch or sends the frame, without the lock.
  void sendOne(std::unique_lock<std::mutex>& lock) {
    if (!isAnnounced_) {
      isAnnounced_ = true;
      std::string json = "{" + describe(*description_);
      if (!description_->viewToken.empty())
        json += ", \"viewToken\": " + nlohmann::json(description_->viewToken).dump();
      json += "}";
      lock.unlock();
      const HttpClient::Answer answer = request("application/json", Bytes(json.begin(), json.end()));
      if (answer.status != 200)
        refuse(answer);
      const auto state = nlohmann::json::parse(answer.body, nullptr, false);
      lock.lock();
      if (!state.is_object() || !state.contains("epoch") || !state.contains("next") ||
          !state["epoch"].is_number_unsigned() || !state["next"].is_number_unsigned())
        throw Error(ErrorKind::malformed, server_, "answers with something else than the stream's state");
      epoch_ = state["epoch"].get<std::uint64_t>();
      next_ = state["next"].get<std::uint64_t>();
      return;
    }
    Frame frame = std::move(*frame_);
    frame_.reset();
    frame.epoch = epoch_;
    frame.number = next_;
    lock.unlock();
    Bytes bytes = encodeFrame(frame);
    const std::size_t size = bytes.size();
    const HttpClient::Answer answer = request("application/x-imgeo-frame", bytes);
    lock.lock();
    if (answer.status == 429) {
      ++totals_.dropped;
      return;
    }
    if (answer.status != 200)
      refuse(answer);
    ++next_;
    ++totals_.published;
    totals_.bytes += size;
  }

  HttpClient::Answer request(const std::string& type, const Bytes& body) {
    return client_.send("POST", target_, type, token_, body);
  }

  [[noreturn]] void refuse(const HttpClient::Answer& answer) const {
    std::string sentence = answer.body.substr(0, answer.body.find('\n'));
    if (sentence.ends_with('.'))
      sentence.pop_back();
    throw Error(ErrorKind::io, server_, fmt::format("refuses the stream with status {}: {}", answer.status, sentence));
  }

  const std::string server_, name_, target_, token_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_; ///< also wakes the thread when it is to stop
  std::optional<Description> description_;
  bool isAnnounced_ = false;
  std::optional<Frame> frame_;
  std::uint64_t epoch_ = 0, next_ = 0;
  PublisherTotals totals_;
  HttpClient client_;   ///< used only by the thread
  std::jthread thread_; ///< the last member: its destructor stops the thread, which uses all others
};

} // namespace

std::unique_ptr<Destination> makeRemoteDestination(const std::string& server, const std::string& name,
                                                   const std::string& token) {
  return std::make_unique<RemoteDestination>(server, name, token);
}

} // namespace imgeo::live
