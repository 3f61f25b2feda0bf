#pragma once
// For tests: a client that sends raw bytes over a connection of its own.

#include <arpa/inet.h>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <string_view>
#include <sys/socket.h>
#include <unistd.h>

namespace imgeo::testing {

/// A client of one connection that sends raw bytes, also invalid requests.
class Client {
public:
  explicit Client(std::uint16_t port, int receiveBuffer = 0) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    if (receiveBuffer > 0)
      setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receiveBuffer, sizeof receiveBuffer);
    const timeval patience{10, 0};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    isConnected_ = ::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }
  ~Client() { ::close(socket_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  bool isConnected() const { return isConnected_; }
  bool send(std::string_view text) const {
    return ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(text.size());
  }
  void sendEnd() const { ::shutdown(socket_, SHUT_WR); }
  /// All bytes up to the end of the connection.
  std::string receiveAll() const {
    std::string all;
    while (const std::optional<std::string> more = receiveSome())
      all += *more;
    return all;
  }
  /// One response with a Content-Length.
  std::string receiveAnswer() const {
    std::string answer;
    for (;;) {
      const std::size_t headEnd = answer.find("\r\n\r\n"), length = answer.find("Content-Length: ");
      if (headEnd != std::string::npos && length < headEnd &&
          answer.size() >= headEnd + 4 + std::stoul(answer.substr(length + 16)))
        return answer;
      const std::optional<std::string> more = receiveSome(1);
      if (!more)
        return answer;
      answer += *more;
    }
  }

private:
  /// Empty at the end of the connection, or after ten seconds without bytes.
  std::optional<std::string> receiveSome(std::size_t maxBytes = 1 << 16) const {
    std::string received(maxBytes, '\0');
    const ssize_t got = ::recv(socket_, received.data(), received.size(), 0);
    if (got <= 0)
      return std::nullopt;
    received.resize(static_cast<std::size_t>(got));
    return received;
  }

  int socket_;
  bool isConnected_ = false;
};

inline std::string requestFor(std::string_view target, std::string_view fields = "") {
  return fmt::format("GET {} HTTP/1.1\r\nHost: test\r\n{}\r\n", target, fields);
}

constexpr const char* lastRequest = "Connection: close\r\n";

} // namespace imgeo::testing
