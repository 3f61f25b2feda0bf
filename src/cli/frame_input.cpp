#include "cli/frame_input.h"

#include "base/error.h"
#include "import/ply/ply.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace imgeo::cli {

namespace {

constexpr std::size_t magicBytes = 4;

int opened(const std::string& file) {
  const int opened = file == "-" ? STDIN_FILENO : ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (opened < 0)
    throw Error(ErrorKind::io, file, fmt::format("cannot be opened: {}", std::strerror(errno)));
  return opened;
}

void append(std::vector<float>& numbers, const std::vector<Vec3f>& vectors) {
  for (const Vec3f& vector : vectors)
    numbers.insert(numbers.end(), {vector.x, vector.y, vector.z});
}

void appendColors(std::vector<float>& numbers, const std::vector<Rgba>& colors, std::uint32_t components) {
  for (const Rgba& color : colors) {
    const float channels[] = {color.r, color.g, color.b, color.a};
    for (std::uint32_t i = 0; i < components; ++i)
      numbers.push_back(channels[i]);
  }
}

/// The values of a PLY frame.
std::vector<float> valuesOf(const PlyContent& ply, const FrameContent& content, const std::string& location) {
  if (content.attribute.empty())
    throw Error(ErrorKind::usage, location, "--attribute is missing: it names the property that has the values");
  for (const NamedAttribute& attribute : ply.attributes.namedAttributes)
    if (attribute.name == content.attribute) {
      if (attribute.components != content.valueComponents)
        throw Error(ErrorKind::malformed, location,
                    fmt::format("\"{}\" has {} components, --values has {}", attribute.name, attribute.components,
                                content.valueComponents));
      return attribute.values;
    }
  throw Error(ErrorKind::malformed, location, fmt::format("the vertices have no \"{}\"", content.attribute));
}

} // namespace

FrameInput::FrameInput(const std::string& file) : name_(file == "-" ? "standard input" : file), file_(opened(file)) {}

FrameInput::~FrameInput() {
  if (file_ != STDIN_FILENO)
    ::close(file_);
}

/// Reads what has arrived, at least one byte; 0 at the end.
std::size_t FrameInput::readSome(std::span<std::uint8_t> out) {
  if (!begin_.empty()) {
    const std::size_t count = std::min(begin_.size(), out.size());
    std::copy_n(begin_.begin(), count, out.begin());
    begin_.erase(begin_.begin(), begin_.begin() + static_cast<std::ptrdiff_t>(count));
    return count;
  }
  for (;;) {
    const ssize_t count = ::read(file_, out.data(), out.size());
    if (count >= 0)
      return static_cast<std::size_t>(count);
    if (errno != EINTR)
      throw Error(ErrorKind::io, name_, fmt::format("cannot be read: {}", std::strerror(errno)));
  }
}

/// Reads until `out` is full; less at the end.
std::size_t FrameInput::readAll(std::span<std::uint8_t> out) {
  std::size_t count = 0;
  while (count < out.size()) {
    const std::size_t more = readSome(out.subspan(count));
    if (more == 0)
      break;
    count += more;
  }
  return count;
}

bool FrameInput::isPly() {
  Bytes magic(magicBytes);
  magic.resize(readAll(magic));
  begin_ = magic;
  return imgeo::isPly(begin_);
}

bool FrameInput::read(FrameContent& content, FrameArrays& frame, std::uint64_t number) {
  if (!isKnown_ && isPly())
    ply_.emplace([this](std::span<std::uint8_t> out) { return readSome(out); });
  isKnown_ = true;
  const std::string location = fmt::format("{}, frame {}", name_, number);
  return ply_ ? readPly(content, frame, location) : readRaw(content, frame, location);
}

/// Positions, normals, colours and values follow one another, as floats in little-endian order.
bool FrameInput::readRaw(const FrameContent& content, FrameArrays& frame, const std::string& location) {
  if (content.vertices == 0)
    throw Error(ErrorKind::usage, name_, "--vertices is missing: frames of floats do not state their number");
  const std::size_t vertices = content.vertices;
  frame.positions.resize(3 * vertices);
  frame.normals.resize(content.hasNormals ? 3 * vertices : 0);
  frame.colors.resize(content.colorComponents * vertices);
  frame.values.resize(content.valueComponents * vertices);
  static_assert(std::endian::native == std::endian::little);
  std::size_t total = 0, expected = 0;
  for (std::vector<float>* array : {&frame.positions, &frame.normals, &frame.colors, &frame.values}) {
    const auto bytes = std::span(reinterpret_cast<std::uint8_t*>(array->data()), array->size() * sizeof(float));
    expected += bytes.size();
    total += readAll(bytes);
  }
  if (total == 0)
    return false;
  if (total < expected)
    throw Error(ErrorKind::truncated, location,
                fmt::format("the input ends within the frame: it has {} floats instead of {}", total / sizeof(float),
                            expected / sizeof(float)));
  return true;
}

bool FrameInput::readPly(FrameContent& content, FrameArrays& frame, const std::string& location) {
  AttributeChoice kept;
  if (content.valueComponents > 0)
    kept.names.insert(content.attribute);
  const std::optional<PlyContent> ply = ply_->next(location, kept);
  if (!ply)
    return false;
  if (ply->positions.empty())
    throw Error(ErrorKind::malformed, location, "there are no vertices");
  if (content.vertices == 0)
    content.vertices = static_cast<std::uint32_t>(ply->positions.size());
  if (ply->positions.size() != content.vertices)
    throw Error(ErrorKind::malformed, location,
                fmt::format("there are {} vertices; the stream has {}", ply->positions.size(), content.vertices));
  if (content.hasNormals && ply->attributes.normals.empty())
    throw Error(ErrorKind::malformed, location, "the vertices have no normals, which --normals asks for");
  if (content.colorComponents > 0 && ply->attributes.colors.empty())
    throw Error(ErrorKind::malformed, location, "the vertices have no colours, which --colors asks for");
  frame = {};
  append(frame.positions, ply->positions);
  if (content.hasNormals)
    append(frame.normals, ply->attributes.normals);
  appendColors(frame.colors, ply->attributes.colors, content.colorComponents);
  if (content.valueComponents > 0)
    frame.values = valuesOf(*ply, content, location);
  return true;
}

} // namespace imgeo::cli
