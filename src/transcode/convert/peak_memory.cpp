#include "transcode/convert/peak_memory.h"

#include <fstream>
#include <string>

namespace imgeo {

std::uint64_t peakMemoryBytes() {
  // getrusage would include the peak of the process before exec, that is, of the parent.
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:"))
      return std::stoull(line.substr(6)) * 1024;
  return 0;
}

} // namespace imgeo
