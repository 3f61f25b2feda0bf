#include "base/error.h"
#include "cli/commands.h"
#include "cli/live_options.h"
#include "serve/serve.h"

#include <cstdio>
#include <fmt/format.h>

namespace imgeo::cli {

namespace {

std::shared_ptr<live::Streams> streamsOf(const Arguments& arguments) {
  live::StreamLimits limits;
  limits.publishToken = publishTokenOf(arguments);
  limits.viewToken = arguments.text("view-token");
  limits.streams = static_cast<std::size_t>(arguments.integer("max-streams"));
  limits.frameBytes = static_cast<std::size_t>(arguments.integer("max-frame")) << 10;
  limits.rate = static_cast<double>(arguments.integer("max-rate"));
  return std::make_shared<live::Streams>(std::move(limits));
}

} // namespace

int runServe(const Arguments& arguments) {
  const bool isLive = arguments.has("live");
  const std::string& site = arguments.text("site");
  if (site.empty() && !isLive)
    throw Error(ErrorKind::usage, "", "DIR is missing: imgeo serve DIR");
  ServeOptions options;
  options.directory = site;
  options.host = arguments.text("host");
  options.port = static_cast<std::uint16_t>(arguments.integer("port"));
  options.stopOnSignals = true;
  if (isLive)
    options.streams = streamsOf(arguments);
  Server server(options);
  fmt::print("Serving {} at {} (Ctrl-C stops it)\n", site.empty() ? "live streams" : site, server.url());
  if (isLive && options.streams->limits().publishToken.empty())
    fmt::print(stderr, "imgeo: warning: without --token nobody may publish a stream\n");
  std::fflush(stdout);
  server.run();
  return 0;
}

} // namespace imgeo::cli
