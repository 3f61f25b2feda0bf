#include "serve/session.h"

#include "base/error.h"

#include <array>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/status.hpp>
#include <chrono>
#include <ctime>
#include <fmt/chrono.h>
#include <fmt/format.h>

namespace imgeo {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;

namespace {

constexpr std::uint32_t maxHeadBytes = 16 * 1024;
constexpr std::size_t chunkBytes = std::size_t{64} << 10;
constexpr std::size_t maxDrainedBytes = std::size_t{1} << 20;
constexpr auto drainTimeout = std::chrono::seconds(2);

std::string_view view(boost::string_view text) {
  return {text.data(), text.size()};
}

RequestHead headOf(const http::request<http::empty_body>& request) {
  RequestHead head;
  head.method = view(request.method_string());
  head.target = view(request.target());
  head.acceptEncoding = view(request[http::field::accept_encoding]);
  head.ifNoneMatch = view(request[http::field::if_none_match]);
  head.ifRange = view(request[http::field::if_range]);
  head.range = view(request[http::field::range]);
  return head;
}

std::string formatHead(const Response& response, bool keepAlive) {
  const auto reason = http::obsolete_reason(http::int_to_status(response.status));
  std::string head = fmt::format("HTTP/1.1 {} {}\r\nServer: imgeo\r\nDate: {:%a, %d %b %Y %H:%M:%S GMT}\r\n",
                                 response.status, view(reason), fmt::gmtime(std::time(nullptr)));
  for (const auto& [name, value] : response.fields)
    head += fmt::format("{}: {}\r\n", name, value);
  head += keepAlive ? "\r\n" : "Connection: close\r\n\r\n";
  return head;
}

Response refusalOf(beast::error_code failure) {
  if (failure == http::error::header_limit || failure == http::error::buffer_overflow)
    return plainResponse(431, "The request head is too long.");
  if (failure == http::error::bad_version)
    return plainResponse(505, "Only HTTP/1.0 and HTTP/1.1 are spoken here.");
  return plainResponse(400, "The request is malformed.");
}

/// Whether the request is malformed, which the session answers, as opposed to a failure of the network.
bool isParseError(beast::error_code failure) {
  return failure.category() == make_error_code(http::error::bad_method).category() &&
         failure != http::error::end_of_stream && failure != http::error::partial_message;
}

} // namespace

Session::Session(beast::tcp_stream stream, const Site& site, SessionLimits limits)
    : stream_(std::move(stream)), site_(site), limits_(limits), received_(maxHeadBytes) {}

asio::awaitable<void> Session::run() {
  try {
    co_await serveRequests();
  } catch (const boost::system::system_error&) {
    // The client has disconnected or is too slow.
  } catch (const Error&) {
    // A file could not be read after the head was sent. The client sees a body shorter than Content-Length.
  }
  beast::error_code ignored;
  stream_.socket().shutdown(asio::ip::tcp::socket::shutdown_both, ignored);
  stream_.socket().close(ignored);
}

asio::awaitable<void> Session::serveRequests() {
  // Responses may be smaller than a packet; they must not wait for more data.
  stream_.socket().set_option(asio::ip::tcp::no_delay(true));
  for (bool keepAlive = true; keepAlive && !isFinishing_;) {
    Parser parser;
    if (!co_await readHead(parser))
      co_return;
    const auto& request = parser.get();
    // Request bodies are not read, so the connection closes: its next bytes could be mistaken for a request.
    const bool hasBody = parser.chunked() || parser.content_length().value_or(0) > 0;
    const bool isHttp11 = request.version() >= 11;
    keepAlive = isHttp11 && request.keep_alive() && !hasBody && !isFinishing_;
    const bool lacksHost = isHttp11 && request.find(http::field::host) == request.end();
    const Response response =
        lacksHost ? plainResponse(400, "The request names no host.") : respond(site_, headOf(request));
    co_await write(response, keepAlive);
    isAnswering_ = false;
  }
  co_await drain();
}

/// Reads the next request head; false if there is none.
asio::awaitable<bool> Session::readHead(Parser& parser) {
  parser.header_limit(maxHeadBytes);
  // One deadline for the whole head: sending single bytes slowly does not extend it.
  stream_.expires_after(std::chrono::milliseconds(limits_.headTimeoutMs));
  beast::error_code failure;
  co_await http::async_read_header(stream_, received_, parser, asio::redirect_error(asio::use_awaitable, failure));
  if (failure && !isParseError(failure))
    co_return false;
  isAnswering_ = true;
  if (!failure)
    co_return true;
  co_await write(refusalOf(failure), false);
  isAnswering_ = false;
  co_await drain();
  co_return false;
}

asio::awaitable<void> Session::write(const Response& response, bool keepAlive) {
  const std::string head = formatHead(response, keepAlive);
  const auto limit = std::chrono::milliseconds(limits_.writeTimeoutMs);
  // The first bytes of the body leave with the head.
  Bytes chunk;
  std::uint64_t sent = 0;
  const std::uint64_t count = response.content ? response.content->size() : response.file ? response.fileCount : 0;
  do {
    const std::size_t length = static_cast<std::size_t>(std::min<std::uint64_t>(count - sent, chunkBytes));
    asio::const_buffer body;
    if (response.content) {
      body = asio::buffer(response.content->data() + sent, length);
    } else if (response.file) {
      chunk.resize(length);
      if (response.file->readAt(response.fileFirst + sent, chunk) < length)
        throw Error(ErrorKind::truncated, "", "a file became shorter while it was sent");
      body = asio::buffer(chunk);
    }
    const std::array<asio::const_buffer, 2> buffers{sent == 0 ? asio::buffer(head) : asio::const_buffer(), body};
    stream_.expires_after(limit);
    co_await asio::async_write(stream_, buffers, asio::use_awaitable);
    sent += length;
  } while (sent < count);
}

/// Lets the client read the last response: closing while received bytes are unread would reset the connection and
/// discard what the client has not yet received (RFC 9112, section 9.6).
asio::awaitable<void> Session::drain() {
  beast::error_code failure;
  stream_.socket().shutdown(asio::ip::tcp::socket::shutdown_send, failure);
  if (isFinishing_ && received_.size() == 0 && stream_.socket().available(failure) == 0)
    co_return;
  stream_.expires_after(drainTimeout);
  Bytes discarded(4096);
  for (std::size_t total = 0; !failure && total < maxDrainedBytes;)
    total +=
        co_await stream_.async_read_some(asio::buffer(discarded), asio::redirect_error(asio::use_awaitable, failure));
}

void Session::finish() {
  isFinishing_ = true;
  if (!isAnswering_)
    abort();
}

void Session::abort() {
  stream_.close();
}

} // namespace imgeo
