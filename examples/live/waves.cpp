// Publishes a surface in motion for ten minutes, or for as many frames as the first argument says. Viewers find it at
// the address that is printed.
// Usage: waves [FRAMES [PORT]]

#include <imgeo/live.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <vector>

namespace {

constexpr unsigned columns = 128, rows = 128, framesPerSecond = 30;

/// x y z of each vertex, row by row.
std::vector<float> positionsAt(double seconds) {
  std::vector<float> positions;
  for (unsigned row = 0; row < rows; ++row)
    for (unsigned column = 0; column < columns; ++column) {
      const double x = 2.0 * column / (columns - 1) - 1, z = 2.0 * row / (rows - 1) - 1;
      const double y = 0.2 * std::sin(5 * x + 2 * seconds) * std::cos(4 * z - seconds);
      positions.insert(positions.end(), {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
    }
  return positions;
}

} // namespace

int main(int argumentCount, char** arguments) {
  const int frames = argumentCount > 1 ? std::atoi(arguments[1]) : 600 * framesPerSecond;
  try {
    imgeo::live::PublisherOptions options;
    options.name = "waves";
    options.box = {{-1, -0.25, -1}, {1, 0.25, 1}};
    options.topology = imgeo::live::Topology::grid(columns, rows);
    options.rate = framesPerSecond;
    if (argumentCount > 2)
      options.port = static_cast<std::uint16_t>(std::atoi(arguments[2]));
    imgeo::live::Publisher publisher(options);
    std::printf("%s\n", publisher.url().c_str());
    std::fflush(stdout);

    const auto start = std::chrono::steady_clock::now();
    for (int frame = 0; frame < frames; ++frame) {
      std::this_thread::sleep_until(start + frame * std::chrono::microseconds(1'000'000 / framesPerSecond));
      publisher.publish(positionsAt(static_cast<double>(frame) / framesPerSecond));
    }
    const imgeo::live::PublisherTotals totals = publisher.totals();
    std::printf("%llu frames, %llu bytes each\n", static_cast<unsigned long long>(totals.published),
                static_cast<unsigned long long>(totals.published > 0 ? totals.bytes / totals.published : 0));
    return 0;
  } catch (const imgeo::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
