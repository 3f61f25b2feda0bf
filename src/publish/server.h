#pragma once
// The state of imgeo::live::Server.

#include "imgeo/live.h"
#include "serve/serve.h"

#include <thread>

namespace imgeo::live {

struct Server::State {
  explicit State(const ServerOptions& options);
  ~State();

  std::shared_ptr<Streams> streams;
  imgeo::Server server;
  std::jthread thread;
};

} // namespace imgeo::live
