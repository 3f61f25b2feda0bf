#pragma once
// One connection: requests are read and answered in order until either side closes it.

#include "serve/live_requests.h"

#include <utility> // missed by Boost 1.74's awaitable.hpp

#include <boost/asio/awaitable.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <chrono>

namespace imgeo {

struct SessionLimits {
  unsigned headTimeoutMs = 0, writeTimeoutMs = 0;
};

/// Every member runs on the strand of the stream.
class Session {
public:
  /// `streams`: nullptr if the server has no live streams.
  Session(boost::beast::tcp_stream stream, const Site& site, std::shared_ptr<live::Streams> streams,
          SessionLimits limits);

  boost::beast::tcp_stream::executor_type executor() { return stream_.get_executor(); }
  /// Serves the connection to its end. Does not throw: a connection that fails is closed.
  boost::asio::awaitable<void> run();
  /// Closes the connection after the current response; immediately where there is none.
  void finish();
  /// Closes the connection immediately.
  void abort();

private:
  using Parser = boost::beast::http::request_parser<boost::beast::http::empty_body>;
  using TimePoint = std::chrono::steady_clock::time_point;

  /// Ends a wait, from any thread for as long as the session lives.
  struct Waiter {
    boost::asio::steady_timer timer;
    bool isWoken = false;
  };

  boost::asio::awaitable<void> serveRequests();
  boost::asio::awaitable<bool> readHead(Parser& parser);
  boost::asio::awaitable<bool> answerLive(Parser& parser, bool keepAlive);
  boost::asio::awaitable<bool> waitForChange(std::shared_ptr<live::Stream> stream, std::uint64_t version,
                                             TimePoint deadline);
  boost::asio::awaitable<bool> receive(Parser& parser, Publication publication, bool keepAlive);
  boost::asio::awaitable<void> writeImages(std::shared_ptr<live::Stream> stream);
  boost::asio::awaitable<void> write(const Response& response, bool keepAlive);
  boost::asio::awaitable<void> writeAll(std::string head, std::shared_ptr<const Bytes> content);
  boost::asio::awaitable<void> writeChunks(const std::string& head, const Response& response);
  boost::asio::awaitable<void> drain();

  boost::beast::tcp_stream stream_;
  Site site_;
  std::shared_ptr<live::Streams> streams_;
  SessionLimits limits_;
  boost::beast::flat_buffer received_;
  std::shared_ptr<Waiter> waiter_; ///< while the session waits for a stream
  bool isAnswering_ = false, isFinishing_ = false;
};

} // namespace imgeo
