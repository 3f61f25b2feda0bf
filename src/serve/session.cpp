#include "serve/session.h"

#include "base/error.h"

#include <array>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/status.hpp>
#include <boost/beast/http/vector_body.hpp>
#include <chrono>
#include <ctime>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <limits>

namespace imgeo {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;

namespace {

constexpr std::uint32_t maxHeadBytes = 16 * 1024;
constexpr std::string_view continueHead = "HTTP/1.1 100 Continue\r\n\r\n";
constexpr std::string_view imagesHead =
    "HTTP/1.1 200 OK\r\nServer: imgeo\r\nContent-Type: multipart/x-mixed-replace; boundary=frame\r\n"
    "Cache-Control: no-store\r\nX-Accel-Buffering: no\r\nAccess-Control-Allow-Origin: *\r\nConnection: close\r\n\r\n"
    "--frame\r\n";
constexpr int imageBufferBytes = 128 * 1024;
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
  head.authorization = view(request[http::field::authorization]);
  head.isFromCache = !request[http::field::via].empty() || !request["CDN-Loop"].empty();
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

Response refusalOfLength(bool isStated, std::size_t maxBytes) {
  if (!isStated)
    return plainResponse(411, "The request does not state the length of its body.");
  return plainResponse(413, fmt::format("The body has more than {} bytes.", maxBytes));
}

/// Whether the request is malformed, which the session answers, as opposed to a failure of the network.
bool isParseError(beast::error_code failure) {
  return failure.category() == make_error_code(http::error::bad_method).category() &&
         failure != http::error::end_of_stream && failure != http::error::partial_message;
}

} // namespace

Session::Session(beast::tcp_stream stream, const Site& site, std::shared_ptr<live::Streams> streams,
                 SessionLimits limits)
    : stream_(std::move(stream)), site_(site), streams_(std::move(streams)), limits_(limits), received_(maxHeadBytes) {}

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
    // The sizes of bodies are checked where bodies are read.
    parser.body_limit(std::numeric_limits<std::uint64_t>::max());
    if (!co_await readHead(parser))
      co_return;
    const auto& request = parser.get();
    // Only publishers' bodies are read. After any other the connection closes: the next bytes could be mistaken for a
    // request.
    const bool hasBody = parser.chunked() || parser.content_length().value_or(0) > 0;
    const bool isHttp11 = request.version() >= 11;
    const bool isKept = isHttp11 && request.keep_alive() && !isFinishing_;
    keepAlive = isKept && !hasBody;
    const RequestHead head = headOf(request);
    const bool lacksHost = isHttp11 && request.find(http::field::host) == request.end();
    if (lacksHost)
      co_await write(plainResponse(400, "The request names no host."), keepAlive);
    else if (streams_ && isLiveTarget(head.target))
      keepAlive = co_await answerLive(parser, isKept);
    else
      co_await write(respond(site_, head), keepAlive);
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

/// Answers a request below /live/. Returns whether the connection stays open.
asio::awaitable<bool> Session::answerLive(Parser& parser, bool keepAlive) {
  const RequestHead head = headOf(parser.get());
  const bool hasBody = parser.chunked() || parser.content_length().value_or(0) > 0;
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(streams_->limits().waitMs);
  LiveReply reply = replyToLive(*streams_, head);
  while (const auto* wait = std::get_if<WaitForChange>(&reply)) {
    const auto stream = wait->stream;
    if (co_await waitForChange(stream, wait->version, deadline))
      reply = replyToLive(*streams_, head);
    else
      reply = answerAfterWaiting(*stream);
  }
  if (const auto* publication = std::get_if<Publication>(&reply))
    co_return co_await receive(parser, *publication, keepAlive);
  if (const auto* images = std::get_if<ImageSequence>(&reply)) {
    co_await writeImages(images->stream);
    co_return false;
  }
  Response& response = std::get<Response>(reply);
  if (head.method == "HEAD")
    response.content.reset();
  keepAlive = keepAlive && !hasBody && !isFinishing_;
  co_await write(response, keepAlive);
  co_return keepAlive;
}

/// Whether the stream is no longer `version`; false after the deadline, and where the server stops.
asio::awaitable<bool> Session::waitForChange(std::shared_ptr<live::Stream> stream, std::uint64_t version,
                                             TimePoint deadline) {
  waiter_ = std::make_shared<Waiter>(Waiter{asio::steady_timer(stream_.get_executor(), deadline)});
  const std::weak_ptr<Waiter> weak = waiter_;
  // The call must not keep the strand: streams outlive servers.
  const bool isWaiting = stream->callAtChange(version, weak, [weak] {
    if (const auto waiter = weak.lock())
      asio::post(waiter->timer.get_executor(), [waiter] {
        waiter->isWoken = true;
        waiter->timer.cancel();
      });
  });
  // The strand runs nothing between the registration and the wait, so that no call is missed.
  beast::error_code ignored;
  if (isWaiting && !isFinishing_)
    co_await waiter_->timer.async_wait(asio::redirect_error(asio::use_awaitable, ignored));
  const bool hasChanged = !isWaiting || waiter_->isWoken;
  waiter_.reset();
  co_return hasChanged;
}

/// Reads the body of a publisher's request and answers it. Returns whether the connection stays open.
asio::awaitable<bool> Session::receive(Parser& parser, Publication publication, bool keepAlive) {
  const auto length = parser.content_length();
  if (parser.chunked() || !length || *length > publication.maxBytes) {
    co_await write(refusalOfLength(length.has_value(), publication.maxBytes), false);
    co_return false;
  }
  stream_.expires_after(std::chrono::milliseconds(limits_.headTimeoutMs));
  if (beast::iequals(parser.get()[http::field::expect], "100-continue"))
    co_await asio::async_write(stream_, asio::buffer(continueHead), asio::use_awaitable);
  http::request_parser<http::vector_body<std::uint8_t>> body(std::move(parser));
  co_await http::async_read(stream_, received_, body, asio::use_awaitable);
  auto& request = body.get();
  const Response response =
      publish(*streams_, publication, view(request[http::field::content_type]), std::move(request.body()));
  co_await write(response, keepAlive);
  co_return keepAlive;
}

/// Sends the newest image of the stream, over and over, as fast as the viewer receives them.
asio::awaitable<void> Session::writeImages(std::shared_ptr<live::Stream> stream) {
  // What lies in the kernel's buffer is late already.
  stream_.socket().set_option(asio::socket_base::send_buffer_size(imageBufferBytes));
  co_await writeAll(std::string(imagesHead), nullptr);
  while (!isFinishing_) {
    const live::Stream::State state = stream->state();
    if (state.newest) {
      const auto image = state.newest->image();
      co_await writeAll(fmt::format("Content-Type: image/png\r\nContent-Length: {}\r\nImgeo-Newest: {}\r\n\r\n",
                                    image->size(), state.newest->number()),
                        image);
      // Browsers show an image when the boundary behind it has arrived.
      co_await writeAll(state.hasEnded ? "\r\n--frame--\r\n" : "\r\n--frame\r\n", nullptr);
    }
    if (state.hasEnded)
      co_return;
    // Without a new frame the last one is sent again after a while, to notice viewers who have vanished.
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(streams_->limits().waitMs);
    co_await waitForChange(stream, state.version, deadline);
  }
}

/// Writes `head` and then `content`, if there is any, within the time limit for each chunk.
asio::awaitable<void> Session::writeAll(std::string head, std::shared_ptr<const Bytes> content) {
  Response response;
  response.content = std::move(content);
  co_await writeChunks(head, response);
}

asio::awaitable<void> Session::write(const Response& response, bool keepAlive) {
  co_await writeChunks(formatHead(response, keepAlive), response);
}

asio::awaitable<void> Session::writeChunks(const std::string& head, const Response& response) {
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
  if (waiter_)
    waiter_->timer.cancel();
  if (!isAnswering_)
    abort();
}

void Session::abort() {
  if (waiter_)
    waiter_->timer.cancel();
  stream_.close();
}

} // namespace imgeo
