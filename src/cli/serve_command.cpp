#include "cli/commands.h"
#include "serve/serve.h"

#include <cstdio>
#include <fmt/format.h>

namespace imgeo::cli {

int runServe(const Arguments& arguments) {
  ServeOptions options;
  options.directory = arguments.text("site");
  options.host = arguments.text("host");
  options.port = static_cast<std::uint16_t>(arguments.integer("port"));
  options.stopOnSignals = true;
  Server server(options);
  fmt::print("Serving {} at {} (Ctrl-C stops it)\n", arguments.text("site"), server.url());
  std::fflush(stdout);
  server.run();
  return 0;
}

} // namespace imgeo::cli
