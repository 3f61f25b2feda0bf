#include "cli/live_options.h"

#include <cstdlib>

namespace imgeo::cli {

std::string publishTokenOf(const Arguments& arguments) {
  if (!arguments.text("token").empty())
    return arguments.text("token");
  const char* token = std::getenv("IMGEO_TOKEN");
  return token ? token : "";
}

live::ServerOptions serverOptionsOf(const Arguments& arguments) {
  live::ServerOptions options;
  options.host = arguments.text("host");
  options.port = static_cast<std::uint16_t>(arguments.integer("port"));
  options.directory = arguments.text("site");
  options.publishToken = publishTokenOf(arguments);
  options.viewToken = arguments.text("view-token");
  return options;
}

} // namespace imgeo::cli
