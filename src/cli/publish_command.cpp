// `imgeo publish`: frames of floats from a pipe become a live stream.
#include "base/error.h"
#include "cli/commands.h"
#include "cli/interruption.h"
#include "cli/live_options.h"
#include "cli/terminal.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>

namespace imgeo::cli {

namespace {

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
  return options;
}

/// Reads the floats of a frame from standard input, little-endian. False where the input ends before the first.
bool readFrame(std::vector<float>& frame, std::uint64_t number) {
  const std::size_t count = std::fread(frame.data(), sizeof(float), frame.size(), stdin);
  if (std::ferror(stdin))
    throw Error(ErrorKind::io, "standard input", "cannot be read");
  if (count == 0)
    return false;
  if (count < frame.size())
    throw Error(ErrorKind::truncated, "standard input",
                fmt::format("ends within frame {}: it has {} floats instead of {}", number, count, frame.size()));
  static_assert(std::endian::native == std::endian::little);
  return true;
}

/// Cuts the arrays of a frame: positions, normals, colours and values follow one another.
class FrameReader {
public:
  explicit FrameReader(const live::PublisherOptions& options)
      : vertices_(options.topology.vertices), components_{3, options.normals > 0 ? std::size_t{3} : 0, options.colors,
                                                          options.values.size()} {}

  std::size_t floats() const { return vertices_ * (components_[0] + components_[1] + components_[2] + components_[3]); }

  live::PublishReport publish(live::Publisher& publisher, std::span<const float> frame) const {
    std::array<std::span<const float>, 4> arrays;
    for (std::size_t i = 0; i < arrays.size(); ++i) {
      arrays[i] = frame.first(vertices_ * components_[i]);
      frame = frame.subspan(arrays[i].size());
    }
    return publisher.publish(arrays[0], arrays[1], arrays[2], arrays[3]);
  }

private:
  std::size_t vertices_;
  std::array<std::size_t, 4> components_;
};

/// Says on standard error why frames do not arrive, once for each reason.
void reportFailure(const std::string& failure, std::string& reported) {
  if (!failure.empty() && failure != reported)
    fmt::print(stderr, "imgeo: warning: {}; trying again\n", failure);
  reported = failure;
}

} // namespace

int runPublish(const Arguments& arguments) {
  handleSignals();
  const live::PublisherOptions options = streamOptionsOf(arguments);
  const FrameReader reader(options);
  live::Publisher publisher(options);
  fmt::print("{} (Ctrl-C stops it)\n", publisher.url());
  std::fflush(stdout);
  std::vector<float> frame(reader.floats());
  std::string reported;
  std::uint64_t read = 0;
  for (; readFrame(frame, read); ++read) {
    throwIfInterrupted();
    reader.publish(publisher, frame);
    reportFailure(publisher.totals().failure, reported);
  }
  const live::PublisherTotals totals = publisher.totals();
  fmt::print("{} frames, {} dropped, {} values clamped\n", grouped(read), grouped(totals.dropped),
             grouped(totals.clamped));
  return 0;
}

} // namespace imgeo::cli
