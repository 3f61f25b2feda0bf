#pragma once
// A static file server over HTTP/1.1, for local use and for many slow clients: one coroutine per connection on a few
// threads. With live streams (docs/live.md), requests below /live/ read and publish their frames.
//
// - GET and HEAD; If-None-Match, a single Range, If-Range; keep-alive, pipelining.
// - The path of a directory gives its index.html.
// - Files whose stem ends in the 16 hex digits of their content's hash may be cached indefinitely; all others are
//   revalidated by their ETag at each use.
// - Text is sent as brotli or gzip where the client accepts it.
// - Every page runs under `Content-Security-Policy: default-src 'self'; script-src 'self' 'wasm-unsafe-eval'`.
// - Nothing outside the directory is served, neither by ".." nor through symbolic links, and no name that starts with a
//   dot. Safe for untrusted requests.

#include "live/streams.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace imgeo {

struct ServeOptions {
  std::filesystem::path directory;          ///< empty: no files are served
  std::string host = "127.0.0.1";           ///< the address or host name to listen on
  std::uint16_t port = 8080;                ///< 0: any free port, see Server::port
  unsigned threads = 0;                     ///< 0: as many as the machine has, at most 4
  bool stopOnSignals = false;               ///< SIGINT and SIGTERM call stop()
  unsigned headTimeoutMs = 15'000;          ///< for a whole request head to arrive, and between requests
  unsigned writeTimeoutMs = 30'000;         ///< for the client to receive each 64 KiB of a response
  unsigned stopTimeoutMs = 3'000;           ///< for unfinished responses after stop()
  std::shared_ptr<live::Streams> streams{}; ///< nullptr: no live streams
};

class Server {
public:
  /// Binds and listens; clients may connect as soon as it returns. Raises the process's limit of open files as far as
  /// the system allows. Throws Error{io} where the directory cannot be read or the address cannot be bound.
  explicit Server(const ServeOptions& options);
  ~Server();

  /// The port that was bound.
  std::uint16_t port() const;
  /// "http://127.0.0.1:8080/"
  std::string url() const;

  /// Serves until stop(), then finishes the responses that have begun. May be called once.
  void run();
  /// Makes run() return. May be called from any thread, at any time, repeatedly.
  void stop();

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace imgeo
