#include "cli/commands.h"
#include "cli/help.h"

#include <fmt/format.h>

namespace imgeo::cli {

int runManual(const Arguments&) {
  fmt::print("{}", manualPage(IMGEO_VERSION));
  return 0;
}

} // namespace imgeo::cli
