#include "import/ply_content.h"

#include "import/ply_cursor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace imgeo {

namespace {

enum Slot : std::uint8_t { x, y, z, nx, ny, nz, u, v, red, green, blue, alpha, unknown, slotCount };

constexpr std::array<std::pair<const char*, Slot>, 22> kVertexProperties{
    {{"x", x},         {"y", y},
     {"z", z},         {"nx", nx},
     {"ny", ny},       {"nz", nz},
     {"u", u},         {"v", v},
     {"s", u},         {"t", v},
     {"texture_u", u}, {"texture_v", v},
     {"texture_s", u}, {"texture_t", v},
     {"red", red},     {"diffuse_red", red},
     {"green", green}, {"diffuse_green", green},
     {"blue", blue},   {"diffuse_blue", blue},
     {"alpha", alpha}, {"diffuse_alpha", alpha}}};

Slot slotOf(const PlyProperty& property) {
  if (!property.isList())
    for (const auto& [name, slot] : kVertexProperties)
      if (property.name == name)
        return slot;
  return unknown;
}

bool isIndexList(const PlyProperty& property) {
  return property.isList() && (property.name == "vertex_indices" || property.name == "vertex_index");
}
bool isTexCoordList(const PlyProperty& property) {
  return property.isList() && property.name == "texcoord";
}

/// Which of a vertex's properties are there, and where.
struct VertexPlan {
  std::vector<Slot> slots; ///< per property
  std::array<PlyType, slotCount> types{};
  std::array<bool, slotCount> present{};

  explicit VertexPlan(const PlyElement& element) {
    for (const PlyProperty& property : element.properties) {
      Slot slot = slotOf(property);
      if (present[slot])
        slot = unknown; // both s and u: the first counts
      slots.push_back(slot);
      if (slot == unknown)
        continue;
      present[slot] = true;
      types[slot] = property.type;
    }
  }
  bool has(std::initializer_list<Slot> all) const {
    return std::ranges::all_of(all, [&](Slot slot) { return present[slot]; });
  }
};

/// A colour channel by its type: 16 bits spread over 0 .. 65,535, fractions over
/// 0 .. 1, all others hold 0 .. 255.
std::uint8_t channel(double value, PlyType type) {
  const double scale = type == PlyType::uint16 ? 1 / 257.0 : isInteger(type) ? 1 : 255;
  const double scaled = value * scale;
  return static_cast<std::uint8_t>(scaled > 0 ? std::lround(std::min(scaled, 255.0)) : 0); // NaN is 0
}

template <typename Cursor> class Body {
public:
  Body(Cursor cursor, const PlyHeader& header) : cursor_(cursor), header_(header) {}

  PlyContent read() {
    for (const PlyElement& element : header_.elements)
      if (element.name == "vertex")
        vertexCount_ = element.count;
    if (vertexCount_ > std::numeric_limits<std::uint32_t>::max())
      cursor_.fail(ErrorKind::limit, "more vertices than 32-bit indices can name");
    for (const PlyElement& element : header_.elements) {
      checkCount(element);
      if (element.properties.empty())
        continue; // its records have no bytes
      if (element.name == "vertex")
        readVertices(element);
      else if (element.name == "face")
        readFaces(element);
      else if (element.name == "tristrips")
        readStrips(element);
      else
        skipElement(element);
    }
    if (!content_.cornerTexCoords.empty())
      content_.cornerTexCoords.resize(content_.indices.size());
    return std::move(content_);
  }

private:
  /// A promised count that the bytes left cannot hold is found here, before any
  /// memory is asked for.
  void checkCount(const PlyElement& element) {
    const std::size_t record = smallestRecord(element, header_.encoding);
    if (record > 0 && element.count > cursor_.bytesLeft() / record)
      cursor_.fail(
          ErrorKind::truncated,
          fmt::format("the header promises {} of '{}', at least {} bytes each, but only {} bytes are left",
                      element.count, element.name, record, cursor_.bytesLeft()));
  }

  /// Calls body(record number) between the begin and the end of each record.
  template <typename Function> void forEachRecord(const PlyElement& element, Function body) {
    for (std::uint64_t i = 0; i < element.count; ++i) {
      cursor_.beginRecord({&element, i});
      body();
      cursor_.endRecord();
    }
  }

  std::size_t listCount(const PlyProperty& list) {
    const double count = cursor_.scalar(*list.countType);
    if (count < 0)
      cursor_.fail(ErrorKind::malformed, "a list has a negative count");
    const std::size_t each = header_.encoding == PlyEncoding::ascii ? 2 : byteSizeOf(list.type);
    if (count > static_cast<double>(cursor_.bytesLeft() / each))
      cursor_.fail(ErrorKind::truncated, fmt::format("a list promises {} values, but only {} bytes are left",
                                                     count, cursor_.bytesLeft()));
    return static_cast<std::size_t>(count);
  }

  std::span<const double> list(const PlyProperty& property) {
    scratch_.resize(listCount(property));
    cursor_.values(property.type, scratch_);
    return scratch_;
  }

  void skipProperty(const PlyProperty& property) {
    cursor_.skip(property.type, property.isList() ? listCount(property) : 1);
  }

  void skipElement(const PlyElement& element) {
    if (element.count > 0)
      content_.ignored.push_back(fmt::format("element '{}'", element.name));
    forEachRecord(element,
                  [&] { std::ranges::for_each(element.properties, [&](auto& p) { skipProperty(p); }); });
  }

  void noteIgnored(const PlyElement& element, const PlyProperty& property) {
    if (element.count > 0)
      content_.ignored.push_back(fmt::format("'{}' of '{}'", property.name, element.name));
  }

  void readVertices(const PlyElement& element) {
    const VertexPlan plan(element);
    if (!plan.has({x, y, z}))
      cursor_.fail(ErrorKind::malformed, "the vertices have no x, y and z");
    for (std::size_t p = 0; p < plan.slots.size(); ++p)
      if (plan.slots[p] == unknown)
        noteIgnored(element, element.properties[p]);
    const bool isDouble = std::ranges::any_of(std::span(plan.types).first(3),
                                              [](PlyType type) { return type == PlyType::float64; });
    content_.hasVertices = true;
    content_.positions.reserve(element.count);
    if (plan.has({nx, ny, nz}))
      content_.normals.reserve(element.count);
    if (plan.has({u, v}))
      content_.texCoords.reserve(element.count);
    if (plan.has({red, green, blue}))
      content_.colors.reserve(element.count);

    std::array<double, slotCount> values{};
    forEachRecord(element, [&] {
      for (std::size_t p = 0; p < plan.slots.size(); ++p) {
        const PlyProperty& property = element.properties[p];
        if (property.isList())
          skipProperty(property);
        else
          values[plan.slots[p]] = cursor_.scalar(property.type);
      }
      addVertex(plan, values);
      if (isDouble)
        noteRounding(values);
    });
  }

  void addVertex(const VertexPlan& plan, const std::array<double, slotCount>& values) {
    const auto f = [&](Slot slot) { return static_cast<float>(values[slot]); };
    const auto isFinite = [&](Slot slot) { return std::isfinite(f(slot)); };
    if (!isFinite(x) || !isFinite(y) || !isFinite(z))
      cursor_.fail(ErrorKind::malformed, "a coordinate is not a number or beyond single precision");
    content_.positions.push_back({f(x), f(y), f(z)});
    if (plan.has({nx, ny, nz}))
      content_.normals.push_back({f(nx), f(ny), f(nz)});
    if (plan.has({u, v})) {
      if (!isFinite(u) || !isFinite(v))
        cursor_.fail(ErrorKind::malformed, "a texture coordinate is not a number");
      content_.texCoords.push_back({f(u), f(v)});
    }
    if (plan.has({red, green, blue})) {
      const auto c = [&](Slot slot) { return channel(values[slot], plan.types[slot]); };
      content_.colors.push_back(
          {c(red), c(green), c(blue), plan.present[alpha] ? c(alpha) : std::uint8_t{255}});
      content_.hasAlpha |= content_.colors.back().a < 255;
    }
  }

  void noteRounding(const std::array<double, slotCount>& values) {
    for (const Slot slot : {x, y, z})
      content_.largestRounding =
          std::max(content_.largestRounding,
                   std::abs(values[slot] - static_cast<double>(static_cast<float>(values[slot]))));
  }

  void checkIndexList(const PlyElement& element) {
    const auto found = std::ranges::find_if(element.properties, isIndexList);
    if (found == element.properties.end())
      cursor_.fail(ErrorKind::malformed, fmt::format("'{}' has no list 'vertex_indices'", element.name));
    if (!isInteger(found->type))
      cursor_.fail(ErrorKind::malformed, "vertex_indices are of a type that has fractions");
  }

  std::uint32_t vertex(double index) {
    if (!(index >= 0 && index < static_cast<double>(vertexCount_)))
      cursor_.fail(ErrorKind::malformed,
                   fmt::format("vertex {} is named, but there are only {}", index, vertexCount_));
    return static_cast<std::uint32_t>(index);
  }

  void readFaces(const PlyElement& element) {
    content_.hasFaces = true;
    checkIndexList(element);
    for (const PlyProperty& property : element.properties)
      if (!isIndexList(property) && !isTexCoordList(property))
        noteIgnored(element, property);
    content_.indices.reserve(
        std::min<std::uint64_t>(3 * element.count, cursor_.bytesLeft() / Cursor::kSmallestValue));

    std::vector<Vec2f> texCoords;
    forEachRecord(element, [&] {
      std::size_t corners = 0;
      texCoords.clear();
      bool hasTexCoords = false;
      for (const PlyProperty& property : element.properties) {
        if (isIndexList(property)) {
          corners = addPolygon(list(property));
        } else if (isTexCoordList(property)) {
          hasTexCoords = true;
          readTexCoords(property, texCoords);
        } else {
          skipProperty(property);
        }
      }
      if (hasTexCoords)
        addTexCoords(texCoords, corners);
    });
  }

  /// The corners added: none for what is no polygon.
  std::size_t addPolygon(std::span<const double> polygon) {
    for (const double index : polygon)
      vertex(index);
    if (polygon.size() < 3) {
      ++content_.facesTooSmall;
      return 0;
    }
    if (polygon.size() != 3 && content_.sizes.empty())
      content_.sizes.assign(content_.indices.size() / 3, 3);
    for (const double index : polygon)
      content_.indices.push_back(static_cast<std::uint32_t>(index));
    if (polygon.size() != 3 || !content_.sizes.empty())
      content_.sizes.push_back(static_cast<std::uint32_t>(polygon.size()));
    return polygon.size();
  }

  void readTexCoords(const PlyProperty& property, std::vector<Vec2f>& texCoords) {
    const std::span<const double> numbers = list(property);
    for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) {
      texCoords.push_back({static_cast<float>(numbers[i]), static_cast<float>(numbers[i + 1])});
      if (!std::isfinite(texCoords.back().x) || !std::isfinite(texCoords.back().y))
        cursor_.fail(ErrorKind::malformed, "a texture coordinate is not a number");
    }
  }

  void addTexCoords(std::vector<Vec2f>& texCoords, std::size_t corners) {
    if (corners == 0)
      return;
    if (!texCoords.empty() && texCoords.size() != corners)
      cursor_.fail(ErrorKind::malformed,
                   fmt::format("a face of {} corners has {} texture coordinates", corners, texCoords.size()));
    texCoords.resize(corners); // a face without: (0, 0)
    content_.cornerTexCoords.insert(content_.cornerTexCoords.end(), texCoords.begin(), texCoords.end());
  }

  void readStrips(const PlyElement& element) {
    content_.hasFaces = true;
    checkIndexList(element);
    for (const PlyProperty& property : element.properties)
      if (!isIndexList(property))
        noteIgnored(element, property);
    forEachRecord(element, [&] {
      for (const PlyProperty& property : element.properties)
        if (isIndexList(property))
          addStrips(list(property));
        else
          skipProperty(property);
    });
  }

  /// Strips, one after the other, each ended by -1; every second triangle of a
  /// strip turns the other way. Triangles with two equal corners only join.
  void addStrips(std::span<const double> indices) {
    std::size_t begin = 0;
    for (std::size_t i = 0; i < indices.size(); ++i) {
      if (indices[i] == -1) {
        begin = i + 1;
        continue;
      }
      const double c = vertex(indices[i]);
      if (i < begin + 2)
        continue;
      const bool isOdd = (i - begin) % 2 == 1;
      const double a = indices[i - (isOdd ? 1 : 2)], b = indices[i - (isOdd ? 2 : 1)];
      const std::array<double, 3> triangle{a, b, c};
      if (a != b && b != c && a != c)
        addPolygon(triangle);
    }
  }

  Cursor cursor_;
  const PlyHeader& header_;
  std::uint64_t vertexCount_ = 0;
  PlyContent content_;
  std::vector<double> scratch_;
};

} // namespace

PlyContent readPlyContent(ByteSpan bytes, const PlyHeader& header, const std::string& name) {
  const std::size_t from = header.bodyOffset;
  switch (header.encoding) {
  case PlyEncoding::ascii:
    return Body(AsciiPlyCursor(bytes, name, from), header).read();
  case PlyEncoding::littleEndian:
    return Body(BinaryPlyCursor<std::endian::little>(bytes, name, from), header).read();
  case PlyEncoding::bigEndian:
    break;
  }
  return Body(BinaryPlyCursor<std::endian::big>(bytes, name, from), header).read();
}

} // namespace imgeo
