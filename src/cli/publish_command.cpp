// `imgeo publish`: frames of vertices from a pipe or from files become a live stream.
#include "base/error.h"
#include "cli/commands.h"
#include "cli/frame_input.h"
#include "cli/interruption.h"
#include "cli/live_options.h"
#include "cli/terminal.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <optional>
#include <thread>

namespace imgeo::cli {

namespace {

/// Frames of files that are published per second where --rate does not say.
constexpr double fileRate = 30;

[[noreturn]] void refuse(const std::string& message) {
  throw Error(ErrorKind::usage, "", message);
}

/// The numbers of "1,2,3".
std::vector<double> numbersOf(const std::string& text, const std::string& flag) {
  std::vector<double> numbers;
  const char *at = text.data(), *end = text.data() + text.size();
  while (at < end) {
    double number = 0;
    const auto [next, failure] = std::from_chars(at, end, number);
    if (failure != std::errc() || !std::isfinite(number) || (next < end && (*next != ',' || next + 1 == end)))
      refuse(fmt::format("--{}: \"{}\" are no numbers with commas between them", flag, text));
    numbers.push_back(number);
    at = next < end ? next + 1 : end;
  }
  return numbers;
}

/// "128x96": the grid; "5000": vertices without a grid.
live::Topology topologyOf(const std::string& text) {
  std::uint32_t first = 0, second = 0;
  const char* end = text.data() + text.size();
  const auto [cross, failure] = std::from_chars(text.data(), end, first);
  if (failure == std::errc() && cross == end && first > 0)
    return live::Topology::order(first);
  const bool hasTwo = failure == std::errc() && *cross == 'x';
  const auto [last, secondFailure] = hasTwo ? std::from_chars(cross + 1, end, second) : std::from_chars_result{};
  if (!hasTwo || secondFailure != std::errc() || last != end || first == 0 || second == 0 ||
      std::uint64_t{first} * second > UINT32_MAX)
    refuse(fmt::format("--vertices: \"{}\" is neither a number of vertices nor COLUMNSxROWS", text));
  return live::Topology::grid(first, second);
}

live::PublisherOptions streamOptionsOf(const Arguments& arguments) {
  live::PublisherOptions options;
  options.name = arguments.text("name");
  if (!arguments.text("vertices").empty())
    options.topology = topologyOf(arguments.text("vertices"));
  const std::vector<double> box = numbersOf(arguments.text("box"), "box");
  if (box.size() != 6)
    refuse("--box has six numbers: the smallest x,y,z and the largest");
  options.box = {{box[0], box[1], box[2]}, {box[3], box[4], box[5]}};
  options.bits = static_cast<std::uint32_t>(arguments.integer("bits"));
  options.normals = static_cast<std::uint32_t>(arguments.integer("normals"));
  options.colors = static_cast<std::uint32_t>(arguments.integer("colors"));
  const std::vector<double> ranges = numbersOf(arguments.text("values"), "values");
  if (ranges.size() % 2 != 0)
    refuse("--values has two numbers for each component: the smallest and the largest");
  for (std::size_t i = 0; i < ranges.size(); i += 2)
    options.values.push_back({ranges[i], ranges[i + 1]});
  options.rate = static_cast<double>(arguments.integer("rate"));
  options.host = arguments.text("host");
  options.port = static_cast<std::uint16_t>(arguments.integer("port"));
  options.to = arguments.text("to");
  options.token = publishTokenOf(arguments);
  options.viewToken = arguments.text("view-token");
  return options;
}

/// Says on standard error why frames do not arrive, once for each reason.
void reportFailure(const std::string& failure, std::string& reported) {
  if (!failure.empty() && failure != reported)
    fmt::print(stderr, "imgeo: warning: {}; trying again\n", failure);
  reported = failure;
}

/// What the options say of frames.
FrameContent contentOf(const live::PublisherOptions& options, const Arguments& arguments) {
  return {options.topology.vertices, options.normals > 0, options.colors,
          static_cast<std::uint32_t>(options.values.size()), arguments.text("attribute")};
}

/// Publishes frames of one input after another.
class FramePublisher {
public:
  FramePublisher(const live::PublisherOptions& options, FrameContent content)
      : options_(options), content_(std::move(content)) {
    // PLY files tell the number of vertices.
    if (content_.vertices > 0)
      begin();
  }

  /// Publishes all frames of an input, `rate` of them a second; 0: as they come.
  void publish(const std::string& file, double rate) {
    FrameInput input(file);
    FrameArrays frame;
    const std::uint64_t first = read_;
    while (input.read(content_, frame, read_)) {
      throwIfInterrupted();
      if (!publisher_)
        begin();
      if (rate > 0)
        waitUntilDue(rate);
      publisher_->publish(frame.positions, frame.normals, frame.colors, frame.values);
      ++read_;
      reportFailure(publisher_->totals().failure, reported_);
    }
    if (read_ == first && file != "-")
      throw Error(ErrorKind::truncated, file, "there is no frame");
  }

  void reportTotals() const {
    const live::PublisherTotals totals = publisher_ ? publisher_->totals() : live::PublisherTotals();
    fmt::print("{} frames, {} dropped, {} values clamped\n", grouped(read_), grouped(totals.dropped),
               grouped(totals.clamped));
  }

private:
  using Clock = std::chrono::steady_clock;

  void begin() {
    if (options_.topology.vertices == 0)
      options_.topology = live::Topology::order(content_.vertices);
    publisher_.emplace(options_);
    fmt::print("{} (Ctrl-C stops it)\n", publisher_->url());
    std::fflush(stdout);
  }

  void waitUntilDue(double rate) {
    due_ = std::max(due_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / rate)),
                    Clock::now());
    std::this_thread::sleep_until(due_);
  }

  live::PublisherOptions options_;
  FrameContent content_;
  std::optional<live::Publisher> publisher_;
  std::uint64_t read_ = 0;
  std::string reported_;
  Clock::time_point due_;
};

} // namespace

int runPublish(const Arguments& arguments) {
  handleSignals();
  live::PublisherOptions options = streamOptionsOf(arguments);
  const std::vector<std::string>& files = arguments.list("input");
  if (options.values.empty() != arguments.text("attribute").empty() && !arguments.text("attribute").empty())
    refuse("--attribute needs --values, the smallest and the largest value");
  if (arguments.has("loop") && files.empty())
    refuse("--loop repeats files, and none is given");
  // Files are all there at once; their frames come as the stream's rate says.
  if (!files.empty() && options.rate == 0)
    options.rate = fileRate;
  FramePublisher publisher(options, contentOf(options, arguments));
  if (files.empty())
    publisher.publish("-", 0);
  do
    for (const std::string& file : files)
      publisher.publish(file, options.rate);
  while (arguments.has("loop"));
  publisher.reportTotals();
  return 0;
}

} // namespace imgeo::cli
