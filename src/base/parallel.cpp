#include "base/parallel.h"

#include <algorithm>
#include <memory>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>

namespace imgeo {

void parallelFor(std::size_t count, const std::function<void(std::size_t)>& body) {
  oneapi::tbb::parallel_for(std::size_t{0}, count, body);
}

void parallelForBlocks(std::size_t count, const std::function<void(std::size_t, std::size_t)>& body) {
  constexpr std::size_t blockSize = 4096;
  parallelFor((count + blockSize - 1) / blockSize,
              [&](std::size_t block) { body(block * blockSize, std::min(count, (block + 1) * blockSize)); });
}

void limitThreads(std::size_t count) {
  using oneapi::tbb::global_control;
  static std::unique_ptr<global_control> limit;
  limit.reset();
  if (count > 0)
    limit = std::make_unique<global_control>(global_control::max_allowed_parallelism, count);
}

} // namespace imgeo
