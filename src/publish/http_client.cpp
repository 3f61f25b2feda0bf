#include "publish/http_client.h"

#include "base/error.h"

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/http/vector_body.hpp>
#include <boost/beast/http/write.hpp>
#include <chrono>
#include <fmt/format.h>
#include <optional>

namespace imgeo::live {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using asio::ip::tcp;

namespace {

constexpr auto timeout = std::chrono::seconds(10);
constexpr std::uint64_t maxAnswerBytes = std::uint64_t{1} << 20;

} // namespace

ServerAddress parseServerAddress(const std::string& url) {
  constexpr std::string_view scheme = "http://";
  std::string_view rest = url;
  if (!rest.starts_with(scheme))
    throw Error(ErrorKind::usage, url, "is no address of a server: it does not begin with http://");
  rest.remove_prefix(scheme.size());
  if (rest.ends_with('/'))
    rest.remove_suffix(1);
  if (rest.empty() || rest.find_first_of("/?#@ ") != std::string_view::npos)
    throw Error(ErrorKind::usage, url, "is no address of a server: http://HOST:PORT");
  const std::size_t bracket = rest.find(']'), colon = rest.rfind(':');
  const bool hasPort = colon != std::string_view::npos && (bracket == std::string_view::npos || colon > bracket);
  std::string_view host = rest.substr(0, hasPort ? colon : rest.size());
  if (host.starts_with('[') && host.ends_with(']'))
    host = host.substr(1, host.size() - 2);
  return {std::string(host), hasPort ? std::string(rest.substr(colon + 1)) : "80"};
}

struct HttpClient::State {
  ServerAddress address;
  asio::io_context context;
  std::optional<beast::tcp_stream> stream;

  /// Runs one asynchronous operation to its end: only those have time limits.
  void finish() {
    context.restart();
    context.run();
  }

  beast::error_code connect() {
    beast::error_code failure;
    const auto addresses = tcp::resolver(context).resolve(address.host, address.port, failure);
    if (failure)
      return failure;
    stream.emplace(context);
    stream->expires_after(timeout);
    stream->async_connect(addresses, [&](beast::error_code result, const tcp::endpoint&) { failure = result; });
    finish();
    if (!failure)
      stream->socket().set_option(tcp::no_delay(true), failure);
    return failure;
  }

  beast::error_code exchange(const http::request<http::vector_body<std::uint8_t>>& request, Answer& answer) {
    beast::error_code failure;
    stream->expires_after(timeout);
    http::async_write(*stream, request, [&](beast::error_code result, std::size_t) { failure = result; });
    finish();
    if (failure)
      return failure;
    beast::flat_buffer buffer;
    http::response_parser<http::string_body> parser;
    parser.body_limit(maxAnswerBytes);
    http::async_read(*stream, buffer, parser, [&](beast::error_code result, std::size_t) { failure = result; });
    finish();
    if (failure)
      return failure;
    answer = {parser.get().result_int(), parser.get().body()};
    if (!parser.keep_alive())
      stream.reset();
    return {};
  }
};

HttpClient::HttpClient(ServerAddress address) : state_(std::make_unique<State>()) {
  state_->address = std::move(address);
}

HttpClient::~HttpClient() = default;

HttpClient::Answer HttpClient::send(const std::string& method, const std::string& target,
                                    const std::string& contentType, const std::string& token, const Bytes& body) {
  http::request<http::vector_body<std::uint8_t>> request;
  request.method_string(method);
  request.target(target);
  request.set(http::field::host, fmt::format("{}:{}", state_->address.host, state_->address.port));
  request.set(http::field::content_type, contentType);
  if (!token.empty())
    request.set(http::field::authorization, "Bearer " + token);
  request.body() = body;
  request.prepare_payload();

  Answer answer;
  const bool wasConnected = state_->stream.has_value();
  beast::error_code failure;
  if (wasConnected)
    failure = state_->exchange(request, answer);
  // The server may have closed an idle connection: that is no failure yet.
  if (!wasConnected || failure) {
    failure = state_->connect();
    if (!failure)
      failure = state_->exchange(request, answer);
  }
  if (!failure)
    return answer;
  state_->stream.reset();
  throw Error(ErrorKind::io, fmt::format("http://{}:{}", state_->address.host, state_->address.port),
              fmt::format("does not answer: {}", failure.message()));
}

} // namespace imgeo::live
