#pragma once
// A static file server over HTTP/1.1, for a desk and for many slow viewers: one
// coroutine per connection on a few threads. It knows names, ranges, ETags and
// encodings, and no geometry.
//
// - GET and HEAD; If-None-Match, one Range with If-Range; keep-alive, pipelining.
// - A directory's path answers with its index.html.
// - Files whose stem ends in the 16 hex digits of their content's hash may be
//   cached for ever; everything else is checked again by its ETag each time.
// - Text is sent as brotli or gzip where the client takes it.
// - Every page runs under `Content-Security-Policy: default-src 'self'`.
// - Nothing outside the directory is served, neither by ".." nor through symbolic
//   links, and no name that starts with a dot. Safe for untrusted requests.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace imgeo {

struct ServeOptions {
  std::filesystem::path directory;
  std::string host = "127.0.0.1";   ///< an address or a name to listen on
  std::uint16_t port = 8080;        ///< 0: any that is free, see Server::port
  unsigned threads = 0;             ///< 0: as many as the machine has, at most 4
  bool stopOnSignals = false;       ///< SIGINT and SIGTERM call stop()
  unsigned headTimeoutMs = 15'000;  ///< for a whole request head to arrive, and between requests
  unsigned writeTimeoutMs = 30'000; ///< for each 64 KiB of an answer to be taken
  unsigned stopTimeoutMs = 3'000;   ///< for running answers after stop()
};

class Server {
public:
  /// Binds and listens; clients may connect from here on. Raises the process's
  /// limit of open files as far as the system allows.
  /// Throws Error{io} if the directory cannot be read or the address not be had.
  explicit Server(const ServeOptions& options);
  ~Server();

  /// The port that was bound.
  std::uint16_t port() const;
  /// "http://127.0.0.1:8080/"
  std::string url() const;

  /// Serves until stop(), then finishes the answers that are under way. Once.
  void run();
  /// Makes run() return; from any thread, at any time, any number of times.
  void stop();

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace imgeo
