#include "cli/commands.h"
#include "cli/help.h"
#include "imgeo/version.h"

#include <fmt/format.h>

namespace imgeo::cli {

int runManual(const Arguments&) {
  fmt::print("{}", manualPage(version()));
  return 0;
}

} // namespace imgeo::cli
