#include "import/e57/description.h"

#include "base/error.h"
#include "scene/transform.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <pugixml.hpp>
#include <string_view>

namespace imgeo::e57 {

namespace {

using pugi::xml_node;

constexpr std::uint64_t maxValuesPerByte = 64;
constexpr std::array colorLimitNames{"colorRed", "colorGreen", "colorBlue"};

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == text.npos)
    return {};
  text = text.substr(first, text.find_last_not_of(blanks) + 1 - first);
  return text.starts_with('+') ? text.substr(1) : text;
}

class DescriptionReader {
public:
  DescriptionReader(PagedFile& file, const std::string& name) : file_(file), name_(name) {}

  Description read() {
    parse();
    const xml_node root = document_.document_element();
    if (std::string_view(root.name()) != "e57Root")
      fail(root, ErrorKind::malformed, fmt::format("the XML section is one of '{}', not of 'e57Root'", root.name()));
    description_.wkt = std::string(trimmed(root.child("coordinateMetadata").text().get()));
    for (const xml_node image : root.child("images2D").children())
      description_.images += image.type() == pugi::node_element;
    for (const xml_node scan : root.child("data3D").children())
      if (scan.type() == pugi::node_element)
        readScan(scan);
    return std::move(description_);
  }

private:
  [[noreturn]] void fail(xml_node node, ErrorKind kind, const std::string& message) const {
    const auto offset = std::max<std::ptrdiff_t>(node.offset_debug(), 0);
    throw Error(kind, file_.locationOf(file_.xmlStart() + static_cast<std::uint64_t>(offset)), message);
  }

  void parse() {
    std::string text(file_.xmlBytes(), '\0');
    file_.read(file_.xmlStart(), {reinterpret_cast<std::uint8_t*>(text.data()), text.size()});
    const pugi::xml_parse_result result = document_.load_buffer(text.data(), text.size());
    if (!result)
      throw Error(
          ErrorKind::malformed,
          file_.locationOf(file_.xmlStart() + static_cast<std::uint64_t>(std::max<std::ptrdiff_t>(result.offset, 0))),
          fmt::format("the XML section cannot be read: {}", result.description()));
  }

  template <typename T> T numberOf(xml_node node, std::string_view text, T absent) const {
    text = trimmed(text);
    if (text.empty())
      return absent;
    T number{};
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (fault != std::errc() || end != text.data() + text.size())
      fail(node, ErrorKind::malformed, fmt::format("'{}' of '{}' is not a number", text, node.name()));
    return number;
  }

  /// The value of a Float, Integer or ScaledInteger; `absent` where there is no such element.
  double valueOf(xml_node node, double absent) const {
    if (!node)
      return absent;
    const double number = numberOf<double>(node, node.text().get(), 0);
    const bool isScaled = std::string_view(node.attribute("type").value()) == "ScaledInteger";
    const double value = isScaled ? number * numberOf<double>(node, node.attribute("scale").value(), 1) +
                                        numberOf<double>(node, node.attribute("offset").value(), 0)
                                  : number;
    if (!std::isfinite(value))
      fail(node, ErrorKind::malformed, fmt::format("'{}' is no finite number", node.name()));
    return value;
  }

  void readScan(xml_node node) {
    const xml_node points = node.child("points");
    if (!points)
      fail(node, ErrorKind::malformed, "a scan has no points element");
    Scan scan;
    scan.name = std::string(trimmed(node.child("name").text().get()));
    scan.recordCount = numberOf<std::uint64_t>(points, points.attribute("recordCount").value(), 0);
    if (scan.recordCount == 0)
      return;
    readCodecs(points.child("codecs"));
    readFields(points.child("prototype"), scan);
    checkCount(points, scan);
    readPose(node.child("pose"), scan);
    for (std::size_t n = 0; n < 3; ++n)
      scan.colorLimits[n] = limitsOf(node.child("colorLimits"), colorLimitNames[n]);
    scan.intensityLimits = limitsOf(node.child("intensityLimits"), "intensity");
    const std::string_view offset = points.attribute("fileOffset").value();
    scan.section = file_.logicalOf(numberOf<std::uint64_t>(points, offset, 0), "the offset of a scan's points");
    description_.scans.push_back(std::move(scan));
  }

  /// All that E57 1.0 defines is the coding that is used where nothing is stated.
  void readCodecs(xml_node codecs) const {
    for (const xml_node codec : codecs.children())
      for (const xml_node part : codec.children())
        if (const std::string_view name = part.name(); !name.empty() && name != "inputs" && name != "bitPackCodec")
          fail(part, ErrorKind::unsupported, fmt::format("points are coded by '{}', which is not read", name));
  }

  /// The elements without children of the prototype, depth first.
  void readFields(xml_node prototype, Scan& scan) const {
    if (!prototype)
      throw Error(ErrorKind::malformed, name_, "the points of a scan have no prototype");
    xml_node node = prototype.first_child();
    while (node && node != prototype) {
      const bool isStructure = std::string_view(node.attribute("type").value()) == "Structure";
      if (isStructure && node.first_child()) {
        node = node.first_child();
        continue;
      }
      if (node.type() == pugi::node_element && !isStructure)
        scan.fields.push_back(fieldOf(node));
      while (node != prototype && !node.next_sibling())
        node = node.parent();
      if (node != prototype)
        node = node.next_sibling();
    }
    if (scan.fields.empty() || scan.fields.size() > std::numeric_limits<std::uint16_t>::max())
      fail(prototype, ErrorKind::malformed, fmt::format("points of {} fields are not possible", scan.fields.size()));
  }

  Field fieldOf(xml_node node) const {
    Field field;
    field.name = node.name();
    const std::string_view type = node.attribute("type").value();
    if (type == "Float") {
      const bool isSingle = std::string_view(node.attribute("precision").value()) == "single";
      field.type = isSingle ? Field::Type::float32 : Field::Type::float64;
    } else if (type == "Integer" || type == "ScaledInteger") {
      using Integers = std::numeric_limits<std::int64_t>;
      field.type = Field::Type::integer;
      field.minimum = numberOf(node, node.attribute("minimum").value(), Integers::min());
      const std::int64_t maximum = numberOf(node, node.attribute("maximum").value(), Integers::max());
      if (maximum < field.minimum)
        fail(node, ErrorKind::malformed, fmt::format("'{}' ranges from {} to {}", field.name, field.minimum, maximum));
      field.range = static_cast<std::uint64_t>(maximum) - static_cast<std::uint64_t>(field.minimum);
      if (type == "ScaledInteger") {
        field.scale = numberOf<double>(node, node.attribute("scale").value(), 1);
        field.addend = numberOf<double>(node, node.attribute("offset").value(), 0);
      }
    } else if (type == "String") {
      field.type = Field::Type::text;
    } else {
      fail(node, ErrorKind::unsupported,
           fmt::format("'{}' of a point is of type '{}', which is not read", field.name, type));
    }
    return field;
  }

  /// Refuses counts that the file cannot hold, also where scans share bytes. A record of no bits counts as one; fields
  /// of no bits, whose values are all the same, are limited by the number of values for each byte of the file.
  void checkCount(xml_node points, const Scan& scan) {
    std::uint64_t bits = 0;
    for (const Field& field : scan.fields)
      bits += field.bits();
    bits = std::max<std::uint64_t>(bits, 1);
    const std::uint64_t valuesLeft = file_.logicalBytes() * maxValuesPerByte - usedValues_;
    if (scan.recordCount > bitsLeft() / bits || scan.recordCount > valuesLeft / scan.fields.size())
      fail(points, ErrorKind::truncated,
           fmt::format("a scan of {} points of {} bits is promised, but the file cannot hold them", scan.recordCount,
                       bits));
    usedBits_ += scan.recordCount * bits;
    usedValues_ += scan.recordCount * scan.fields.size();
    pointCount_ += scan.recordCount;
    if (pointCount_ > std::numeric_limits<std::uint32_t>::max())
      throw Error(ErrorKind::limit, name_, "more points than 32-bit indices can name");
  }

  std::uint64_t bitsLeft() const { return file_.logicalBytes() * 8 - usedBits_; }

  void readPose(xml_node pose, Scan& scan) const {
    const xml_node rotation = pose.child("rotation"), translation = pose.child("translation");
    Transform transform;
    if (rotation) {
      const double w = valueOf(rotation.child("w"), 1), x = valueOf(rotation.child("x"), 0),
                   y = valueOf(rotation.child("y"), 0), z = valueOf(rotation.child("z"), 0);
      if (const double square = w * w + x * x + y * y + z * z; !(square > 0 && std::isfinite(square)))
        fail(rotation, ErrorKind::malformed, "the rotation of a scan is no usable quaternion");
      transform.rotation = rotationOfQuaternion(x, y, z, w);
    }
    transform.translation = {valueOf(translation.child("x"), 0), valueOf(translation.child("y"), 0),
                             valueOf(translation.child("z"), 0)};
    scan.pose = affineOf(transform);
  }

  std::optional<Limits> limitsOf(xml_node limits, const std::string& of) const {
    const xml_node minimum = limits.child((of + "Minimum").c_str()), maximum = limits.child((of + "Maximum").c_str());
    if (!minimum || !maximum)
      return std::nullopt;
    return Limits{valueOf(minimum, 0), valueOf(maximum, 1)};
  }

  PagedFile& file_;
  const std::string& name_;
  pugi::xml_document document_;
  std::uint64_t usedBits_ = 0, usedValues_ = 0, pointCount_ = 0; ///< of the scans so far
  Description description_;
};

} // namespace

Description readDescription(PagedFile& file, const std::string& name) {
  return DescriptionReader(file, name).read();
}

} // namespace imgeo::e57
