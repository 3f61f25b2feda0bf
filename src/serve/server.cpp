#include "serve/serve.h"

#include "base/error.h"
#include "serve/session.h"

#include <algorithm>
#include <atomic>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <csignal>
#include <fmt/format.h>
#include <set>
#include <sys/resource.h>
#include <thread>
#include <vector>

namespace imgeo {

namespace asio = boost::asio;
namespace fs = std::filesystem;
using asio::ip::tcp;
using ErrorCode = boost::system::error_code;

namespace {

constexpr std::size_t codingCacheBytes = std::size_t{128} << 20;
constexpr auto retryDelay = std::chrono::milliseconds(100);

/// Every connection needs a file descriptor, and the default soft limit is often 1024.
void raiseOpenFileLimit() {
  struct rlimit limit {};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0)
    return;
  limit.rlim_cur = limit.rlim_max;
  setrlimit(RLIMIT_NOFILE, &limit);
}

fs::path canonicalDirectory(const fs::path& directory) {
  if (directory.empty())
    return {};
  std::error_code failure;
  fs::path root = fs::canonical(directory, failure);
  if (failure)
    throw Error(ErrorKind::io, directory.string(), fmt::format("cannot be served: {}", failure.message()));
  if (!fs::is_directory(root, failure))
    throw Error(ErrorKind::io, directory.string(), "is no directory");
  return root;
}

tcp::acceptor listenOn(asio::io_context& context, const std::string& host, std::uint16_t port) {
  const std::string location = fmt::format("{}:{}", host, port);
  ErrorCode failure;
  const auto addresses = tcp::resolver(context).resolve(host, std::to_string(port), tcp::resolver::passive, failure);
  if (failure)
    throw Error(ErrorKind::io, host, fmt::format("is no address to listen on: {}", failure.message()));
  const tcp::endpoint endpoint = addresses.begin()->endpoint();
  tcp::acceptor acceptor(asio::make_strand(context));
  acceptor.open(endpoint.protocol());
  // Allows rebinding a port immediately after its last server has ended.
  acceptor.set_option(tcp::acceptor::reuse_address(true));
  acceptor.bind(endpoint, failure);
  if (!failure)
    acceptor.listen(tcp::acceptor::max_listen_connections, failure);
  if (failure == asio::error::address_in_use)
    throw Error(ErrorKind::io, location, "the port is in use already");
  if (failure)
    throw Error(ErrorKind::io, location, fmt::format("cannot listen: {}", failure.message()));
  return acceptor;
}

unsigned threadCount(unsigned requested) {
  return requested > 0 ? requested : std::clamp(std::thread::hardware_concurrency(), 1u, 4u);
}

} // namespace

struct Server::State {
  explicit State(const ServeOptions& o)
      : options(o), codings(codingCacheBytes), site{canonicalDirectory(o.directory), codings},
        acceptor(listenOn(context, o.host, o.port)), endpoint(acceptor.local_endpoint()),
        signals(acceptor.get_executor()), stopTimer(acceptor.get_executor()), retryTimer(acceptor.get_executor()) {
    // Publishers hand the calls of waiting viewers over and go on.
    if (options.streams)
      options.streams->setRunner([this](std::vector<std::function<void()>> calls) {
        asio::post(context, [calls = std::move(calls)] {
          for (const auto& call : calls)
            call();
        });
      });
  }
  ~State() {
    if (options.streams)
      options.streams->setRunner([](const auto&) {});
  }

  asio::awaitable<void> acceptConnections();
  void startSession(tcp::socket socket);
  void beginStop();
  void endSession(const std::shared_ptr<Session>& session);

  const ServeOptions options;
  CodingCache codings;
  Site site;
  asio::io_context context;
  // The acceptor, the timers and the set of sessions belong to the acceptor's strand.
  tcp::acceptor acceptor;
  const tcp::endpoint endpoint;
  asio::signal_set signals;
  asio::steady_timer stopTimer, retryTimer;
  std::set<std::shared_ptr<Session>> sessions;
  bool isStopping = false;
};

asio::awaitable<void> Server::State::acceptConnections() {
  while (!isStopping) {
    ErrorCode failure;
    tcp::socket socket =
        co_await acceptor.async_accept(asio::make_strand(context), asio::redirect_error(asio::use_awaitable, failure));
    if (!failure && !isStopping)
      startSession(std::move(socket));
    if (failure && !isStopping) {
      // Probably out of file descriptors: waits until other connections close, while new ones stay in the queue.
      retryTimer.expires_after(retryDelay);
      co_await retryTimer.async_wait(asio::redirect_error(asio::use_awaitable, failure));
    }
  }
}

void Server::State::startSession(tcp::socket socket) {
  const auto session = std::make_shared<Session>(boost::beast::tcp_stream(std::move(socket)), site, options.streams,
                                                 SessionLimits{options.headTimeoutMs, options.writeTimeoutMs});
  sessions.insert(session);
  asio::co_spawn(
      session->executor(), [session] { return session->run(); },
      [this, session](const std::exception_ptr&) {
        asio::dispatch(acceptor.get_executor(), [this, session] { endSession(session); });
      });
}

void Server::State::endSession(const std::shared_ptr<Session>& session) {
  sessions.erase(session);
  if (isStopping && sessions.empty())
    stopTimer.cancel();
}

void Server::State::beginStop() {
  if (isStopping)
    return;
  isStopping = true;
  ErrorCode ignored;
  acceptor.close(ignored);
  signals.cancel(ignored);
  retryTimer.cancel();
  for (const auto& session : sessions)
    asio::post(session->executor(), [session] { session->finish(); });
  if (sessions.empty())
    return;
  stopTimer.expires_after(std::chrono::milliseconds(options.stopTimeoutMs));
  stopTimer.async_wait([this](ErrorCode cancelled) {
    if (cancelled)
      return;
    for (const auto& session : sessions)
      asio::post(session->executor(), [session] { session->abort(); });
  });
}

Server::Server(const ServeOptions& options) : state_(std::make_unique<State>(options)) {
  raiseOpenFileLimit();
  // Registers the signals now, so that one that arrives before run() is not lost.
  if (options.stopOnSignals) {
    state_->signals.add(SIGINT);
    state_->signals.add(SIGTERM);
  }
}

Server::~Server() = default;

std::uint16_t Server::port() const {
  return state_->endpoint.port();
}

std::string Server::url() const {
  const asio::ip::address address = state_->endpoint.address();
  const std::string host = address.is_v6() ? fmt::format("[{}]", address.to_string()) : address.to_string();
  return fmt::format("http://{}:{}/", host, state_->endpoint.port());
}

void Server::run() {
  State& state = *state_;
  if (state.options.stopOnSignals)
    state.signals.async_wait([&state](ErrorCode cancelled, int) {
      if (!cancelled)
        state.beginStop();
    });
  asio::co_spawn(state.acceptor.get_executor(), state.acceptConnections(), asio::detached);
  std::vector<std::jthread> others(threadCount(state.options.threads) - 1);
  for (std::jthread& thread : others)
    thread = std::jthread([&state] { state.context.run(); });
  state.context.run();
}

void Server::stop() {
  asio::post(state_->acceptor.get_executor(), [state = state_.get()] { state->beginStop(); });
}

} // namespace imgeo
