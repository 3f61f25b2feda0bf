#include "base/parallel.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>

namespace imgeo {

namespace {

std::atomic<std::size_t> threadLimit = 0; ///< 0: no limit

} // namespace

void parallelFor(std::size_t count, const std::function<void(std::size_t)>& body) {
  // Starting TBB takes a millisecond, longer than converting many small meshes.
  if (count == 1 || threadLimit == 1)
    for (std::size_t i = 0; i < count; ++i)
      body(i);
  else if (count > 0) {
    // Without a context of its own, a loop that runs within the body of another ends early, and without an exception,
    // where another body of the outer loop throws: it would leave elements undone that the code after it relies on.
    using oneapi::tbb::task_group_context;
    task_group_context context(task_group_context::isolated);
    oneapi::tbb::parallel_for(std::size_t{0}, count, body, context);
  }
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
  threadLimit = count;
  if (count > 1)
    limit = std::make_unique<global_control>(global_control::max_allowed_parallelism, count);
}

} // namespace imgeo
