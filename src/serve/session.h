#pragma once
// One connection: requests are read and answered in order until either side closes it.

#include "serve/respond.h"

#include <utility> // missed by Boost 1.74's awaitable.hpp

#include <boost/asio/awaitable.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>

namespace imgeo {

struct SessionLimits {
  unsigned headTimeoutMs = 0, writeTimeoutMs = 0;
};

/// Every member runs on the strand of the stream.
class Session {
public:
  Session(boost::beast::tcp_stream stream, const Site& site, SessionLimits limits);

  boost::beast::tcp_stream::executor_type executor() { return stream_.get_executor(); }
  /// Serves the connection to its end. Does not throw: a connection that fails is closed.
  boost::asio::awaitable<void> run();
  /// Closes the connection after the current response; immediately where there is none.
  void finish();
  /// Closes the connection immediately.
  void abort();

private:
  using Parser = boost::beast::http::request_parser<boost::beast::http::empty_body>;

  boost::asio::awaitable<void> serveRequests();
  boost::asio::awaitable<bool> readHead(Parser& parser);
  boost::asio::awaitable<void> write(const Response& response, bool keepAlive);
  boost::asio::awaitable<void> drain();

  boost::beast::tcp_stream stream_;
  Site site_;
  SessionLimits limits_;
  boost::beast::flat_buffer received_;
  bool isAnswering_ = false, isFinishing_ = false;
};

} // namespace imgeo
