// Many viewers of a live stream in one process, each with two connections as a browser's FrameSource has: how many
// frames they get, how old, and whether every byte is right. Prints one JSON object.
// Usage: build/bench/live_viewers PORT NAME VIEWERS SECONDS

#include "live/frame.h"
#include "live/stream.h"

#include "base/error.h"

#include <algorithm>
#include <arpa/inet.h>
#include <charconv>
#include <fcntl.h>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <netinet/tcp.h>
#include <nlohmann/json.hpp>
#include <queue>
#include <sys/epoll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

namespace {

using namespace imgeo;

constexpr double marginMs = 4; ///< as FrameSchedule of the runtime
constexpr std::size_t lanes = 2;

struct Viewer {
  std::uint64_t requested = 0, shown = 0, frames = 0, skipped = 0;
};

/// A connection that requests one frame after the other.
struct Lane {
  int socket = -1;
  std::size_t viewer = 0;
  std::uint64_t number = 0;
  std::string received;
};

std::string_view fieldOf(std::string_view head, std::string_view name) {
  const std::size_t at = head.find(name);
  if (at == std::string_view::npos)
    return {};
  const std::size_t begin = at + name.size();
  return head.substr(begin, head.find("\r\n", begin) - begin);
}

template <typename Number> Number numberOf(std::string_view text) {
  Number number{};
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

class Viewers {
public:
  Viewers(std::uint16_t port, std::string name, std::size_t count) : port_(port), name_(std::move(name)) {
    struct rlimit limit {};
    getrlimit(RLIMIT_NOFILE, &limit);
    limit.rlim_cur = limit.rlim_max;
    setrlimit(RLIMIT_NOFILE, &limit);
    readState();
    viewers_.assign(count, {next_ - 1, next_ - 1, 0, 0});
    for (std::size_t i = 0; i < lanes * count; ++i) {
      lanes_.push_back({connectSocket(), i / lanes, 0, {}});
      struct epoll_event event {};
      event.events = EPOLLIN;
      event.data.u64 = i;
      epoll_ctl(epoll_, EPOLL_CTL_ADD, lanes_.back().socket, &event);
    }
    for (std::size_t i = 0; i < lanes_.size(); ++i)
      request(i);
  }

  /// Runs for a time; frames count from `measureFrom` on.
  void run(double seconds, double measureFrom) {
    const double begin = live::millisecondsNow(), end = begin + 1e3 * seconds;
    std::vector<struct epoll_event> events(256);
    for (double now = begin; now < end; now = live::millisecondsNow()) {
      isMeasuring_ = now >= begin + 1e3 * measureFrom;
      while (!waiting_.empty() && waiting_.top().first <= now) {
        send(waiting_.top().second);
        waiting_.pop();
      }
      const double next = waiting_.empty() ? end : std::min(end, waiting_.top().first);
      const int timeout = static_cast<int>(std::clamp(next - now, 0.0, 50.0));
      const int count = epoll_wait(epoll_, events.data(), static_cast<int>(events.size()), timeout);
      for (int i = 0; i < count; ++i)
        receive(events[static_cast<std::size_t>(i)].data.u64);
    }
    report(seconds - measureFrom);
  }

private:
  int connectSocket() const {
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    struct sockaddr_in address {};
    address.sin_family = AF_INET;
    address.sin_port = htons(port_);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
      throw Error(ErrorKind::io, fmt::format("port {}", port_), "does not answer");
    const int one = 1;
    setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &one, sizeof one);
    fcntl(socket, F_SETFL, O_NONBLOCK);
    return socket;
  }

  void readState() {
    const int socket = connectSocket();
    fcntl(socket, F_SETFL, 0);
    const std::string head =
        fmt::format("GET /live/{}/latest HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n", name_);
    std::ignore = ::send(socket, head.data(), head.size(), MSG_NOSIGNAL);
    std::string answer(1 << 16, '\0');
    std::size_t length = 0;
    for (ssize_t more = 0; (more = ::recv(socket, answer.data() + length, answer.size() - length, 0)) > 0;)
      length += static_cast<std::size_t>(more);
    ::close(socket);
    const auto json = nlohmann::json::parse(answer.substr(answer.find("\r\n\r\n") + 4, length), nullptr, false);
    if (!json.is_object())
      throw Error(ErrorKind::io, name_, "is no stream");
    next_ = json.at("next").get<std::uint64_t>();
    isTimed_ = json.at("timed").get<bool>();
    intervalMs_ = 1e3 / json.at("rate").get<double>();
    known_ = {next_ - 1, json.at("added").is_null() ? live::millisecondsNow() : json.at("added").get<double>()};
  }

  double dueAt(std::uint64_t number) const {
    return known_.second + (static_cast<double>(number) - static_cast<double>(known_.first)) * intervalMs_;
  }

  void request(std::size_t index) {
    Lane& lane = lanes_[index];
    Viewer& viewer = viewers_[lane.viewer];
    const double now = live::millisecondsNow();
    const auto ahead = std::max(0.0, (now - marginMs - known_.second) / intervalMs_);
    const std::uint64_t newest = isTimed_ ? known_.first + static_cast<std::uint64_t>(ahead) : known_.first;
    lane.number = viewer.requested = std::max(viewer.requested + 1, newest);
    // Viewers' clocks differ by some milliseconds.
    const double due = dueAt(lane.number) + marginMs + static_cast<double>(lane.viewer % 32) / 16;
    if (isTimed_ && due > now)
      waiting_.emplace(due, index);
    else
      send(index);
  }

  void send(std::size_t index) {
    Lane& lane = lanes_[index];
    const std::string head =
        fmt::format("GET /live/{}/frames/{} HTTP/1.1\r\nHost: localhost\r\n\r\n", name_, lane.number);
    if (::send(lane.socket, head.data(), head.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(head.size()))
      throw Error(ErrorKind::io, name_, "a connection is broken");
  }

  void receive(std::size_t index) {
    Lane& lane = lanes_[index];
    char buffer[1 << 16];
    const ssize_t count = ::recv(lane.socket, buffer, sizeof buffer, 0);
    if (count <= 0)
      throw Error(ErrorKind::io, name_, "the server has closed a connection");
    lane.received.append(buffer, static_cast<std::size_t>(count));
    const std::size_t headEnd = lane.received.find("\r\n\r\n");
    if (headEnd == std::string::npos)
      return;
    const std::string_view head = std::string_view(lane.received).substr(0, headEnd + 2);
    const auto length = numberOf<std::size_t>(fieldOf(head, "Content-Length: "));
    if (lane.received.size() < headEnd + 4 + length)
      return;
    if (head.starts_with("HTTP/1.1 200"))
      accept(lane, head, std::string_view(lane.received).substr(headEnd + 4));
    else
      ++refused_;
    lane.received.clear();
    request(index);
  }

  void accept(const Lane& lane, std::string_view head, std::string_view body) {
    const auto added = numberOf<double>(fieldOf(head, "Imgeo-Added: "));
    if (lane.number > known_.first)
      known_ = {lane.number, added};
    // The first copy of a frame is decoded, which verifies its checksums; all others have the same bytes.
    auto [copy, isNew] = copies_.try_emplace(lane.number, body);
    if (isNew && live::decodeFrame(asBytes(body), "").number != lane.number)
      ++torn_;
    if (copy->second != body)
      ++torn_;
    while (copies_.size() > 100)
      copies_.erase(copies_.begin());
    Viewer& viewer = viewers_[lane.viewer];
    if (lane.number <= viewer.shown)
      return;
    if (isMeasuring_) {
      ++viewer.frames;
      viewer.skipped += lane.number - viewer.shown - 1;
      ages_.push_back(static_cast<float>(live::millisecondsNow() - added));
    }
    viewer.shown = lane.number;
  }

  void report(double seconds) {
    std::ranges::sort(ages_);
    const auto age = [&](double share) {
      return ages_.empty() ? 0 : ages_[static_cast<std::size_t>(share * static_cast<double>(ages_.size() - 1))];
    };
    std::uint64_t frames = 0, skipped = 0;
    for (const Viewer& viewer : viewers_) {
      frames += viewer.frames;
      skipped += viewer.skipped;
    }
    fmt::print("{{\"viewers\": {}, \"timed\": {}, \"rate\": {:.2f}, \"frames\": {}, \"skipped\": {}, \"torn\": {}, "
               "\"refused\": {}, \"medianAge\": {:.1f}, \"age95\": {:.1f}}}\n",
               viewers_.size(), isTimed_, static_cast<double>(frames) / seconds / static_cast<double>(viewers_.size()),
               frames, skipped, torn_, refused_, age(0.5), age(0.95));
  }

  std::uint16_t port_;
  std::string name_;
  const int epoll_ = epoll_create1(EPOLL_CLOEXEC);
  std::vector<Viewer> viewers_;
  std::vector<Lane> lanes_;
  using Waiting = std::pair<double, std::size_t>;
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> waiting_; ///< lanes whose frame is not due yet
  std::map<std::uint64_t, std::string> copies_;
  std::vector<float> ages_;
  std::uint64_t next_ = 0, torn_ = 0, refused_ = 0;
  bool isTimed_ = false, isMeasuring_ = false;
  double intervalMs_ = 0;
  std::pair<std::uint64_t, double> known_; ///< the newest frame that is known, and when the server had it
};

} // namespace

int main(int count, char** words) {
  if (count != 5) {
    fmt::print(stderr, "usage: build/bench/live_viewers PORT NAME VIEWERS SECONDS\n");
    return 1;
  }
  try {
    Viewers viewers(static_cast<std::uint16_t>(std::atoi(words[1])), words[2],
                    static_cast<std::size_t>(std::atoi(words[3])));
    viewers.run(std::atof(words[4]), 1);
  } catch (const Error& error) {
    fmt::print(stderr, "live_viewers: {}\n", error.what());
    return 2;
  }
}
