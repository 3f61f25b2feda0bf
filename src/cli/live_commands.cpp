// Commands that publish live streams: docs/live.md.
#include "cli/commands.h"
#include "cli/interruption.h"
#include "cli/live_options.h"
#include "cli/terminal.h"
#include "imgeo/live.h"
#include "motions/motion.h"
#include "transcode/sample/live_page.h"

#include "base/error.h"
#include "base/unfinished_files.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <optional>
#include <thread>

namespace imgeo::cli {

namespace {

using Clock = std::chrono::steady_clock;

static_assert(sizeof(Vec3f) == 3 * sizeof(float));

live::PublisherOptions streamOf(const Motion& motion, const Arguments& arguments) {
  live::PublisherOptions stream;
  stream.name = arguments.text("sample");
  const Box3d& box = motion.box();
  stream.box = {{box.min.x, box.min.y, box.min.z}, {box.max.x, box.max.y, box.max.z}};
  stream.topology = {static_cast<std::uint32_t>(motion.positions().size()), motion.columns()};
  stream.bits = static_cast<std::uint32_t>(arguments.integer("bits"));
  stream.rate = static_cast<double>(arguments.integer("rate"));
  stream.values = {{0, 1}};
  stream.valueBits = 8;
  return stream;
}

/// Publishes frames in real time until `count` have been published; 0: until the process is interrupted.
void publishInRealTime(live::Publisher& publisher, Motion& motion, double rate, std::int64_t count) {
  const auto interval = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / rate));
  auto due = Clock::now();
  for (std::int64_t frame = 0; count == 0 || frame < count; ++frame) {
    throwIfInterrupted();
    motion.advance(std::min(0.1, 1 / rate));
    const auto positions = motion.positions();
    publisher.publish({&positions.front().x, 3 * positions.size()}, {}, {}, motion.values());
    // A simulation that is slower than real time runs as fast as it can; it does not catch up later.
    due = std::max(due + interval, Clock::now());
    std::this_thread::sleep_until(due);
  }
}

/// A new folder, removed at the end of its scope and by signals.
class TemporaryFolder {
public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "imgeo-live-XXXXXX").string();
    if (!mkdtemp(pattern.data()))
      throw Error(ErrorKind::io, pattern, "cannot be created");
    path_ = pattern;
    registered_.emplace(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
  std::optional<UnfinishedFile> registered_;
};

} // namespace

int runLiveSample(const Arguments& arguments) {
  const auto motion = makeMotion(arguments.text("sample"), static_cast<std::uint32_t>(arguments.integer("grid")),
                                 static_cast<std::uint32_t>(arguments.integer("seed")));
  if (!motion)
    throw Error(ErrorKind::usage, arguments.text("sample"), "is no motion: --live takes cloth, water or turntable");
  live::ServerOptions options = serverOptionsOf(arguments);
  std::optional<TemporaryFolder> page;
  if (options.directory.empty()) {
    page.emplace();
    writeLivePage(page->path(), arguments.text("sample"), motion->box(), options.viewToken);
    options.directory = page->path();
  }
  live::Server server(options);
  live::Publisher publisher(server, streamOf(*motion, arguments));
  fmt::print("{} vertices at {} frames per second: {}\nThe page: {} (Ctrl-C stops it)\n",
             grouped(motion->positions().size()), arguments.integer("rate"), publisher.url(), server.url());
  std::fflush(stdout);
  publishInRealTime(publisher, *motion, static_cast<double>(arguments.integer("rate")), arguments.integer("frames"));
  const live::PublisherTotals totals = publisher.totals();
  fmt::print("{} frames, {} each, {} values clamped\n", grouped(totals.published),
             byteSize(totals.bytes / std::max<std::uint64_t>(1, totals.published)), grouped(totals.clamped));
  return 0;
}

} // namespace imgeo::cli
