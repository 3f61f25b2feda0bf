#include "transcode/convert/peak_memory.h"

#include <fstream>
#include <string>

namespace imgeo {

std::uint64_t peakMemoryBytes() {
  // getrusage would keep the maximum of the process image before exec, that is, of the parent.
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:"))
      return std::stoull(line.substr(6)) * 1024;
  return 0;
}

} // namespace imgeo
