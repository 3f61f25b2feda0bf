#include "publish/server.h"

namespace imgeo::live {

namespace {

StreamLimits limitsOf(const ServerOptions& options) {
  StreamLimits limits;
  limits.streams = options.maxStreams;
  limits.history = {options.history, options.historyBytes};
  limits.rate = options.maxRate;
  limits.viewToken = options.viewToken;
  limits.publishToken = options.publishToken;
  return limits;
}

ServeOptions serveOptionsOf(const ServerOptions& options, const std::shared_ptr<Streams>& streams) {
  ServeOptions serve;
  serve.directory = options.directory;
  serve.host = options.host;
  serve.port = options.port;
  serve.streams = streams;
  return serve;
}

} // namespace

Server::State::State(const ServerOptions& options)
    : streams(std::make_shared<Streams>(limitsOf(options))), server(serveOptionsOf(options, streams)),
      thread([this] { server.run(); }) {}

Server::State::~State() {
  server.stop();
}

Server::Server(const ServerOptions& options) : state_(std::make_unique<State>(options)) {}

Server::~Server() = default;

std::uint16_t Server::port() const {
  return state_->server.port();
}

std::string Server::url() const {
  return state_->server.url();
}

} // namespace imgeo::live
