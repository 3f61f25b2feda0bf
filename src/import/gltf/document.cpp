#include "import/gltf/document.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fmt/format.h>
#include <meshoptimizer.h>

namespace imgeo::gltf {

namespace {

/// The member of a buffer view that says how it is compressed; a null value where it is not.
Value meshoptOf(const Value& view) {
  const Value extensions = view["extensions"];
  const Value draft = extensions["KHR_meshopt_compression"];
  return draft.isAbsent() ? extensions["EXT_meshopt_compression"] : draft;
}

// Component types, as the specification names them.
constexpr std::uint32_t byteType = 5120, unsignedByte = 5121, shortType = 5122, unsignedShort = 5123,
                        unsignedInt = 5125, floatType = 5126;

/// The budget of decoded data: compression and shared accessors expand the source, but not without limit.
constexpr std::uint64_t bytesPerSourceByte = 256, minBudgetBytes = std::uint64_t{64} << 20;

std::uint32_t sizeOfComponent(const Value& type) {
  switch (type.whole()) {
  case byteType:
  case unsignedByte:
    return 1;
  case shortType:
  case unsignedShort:
    return 2;
  case unsignedInt:
  case floatType:
    return 4;
  default:
    type.fail(ErrorKind::malformed, "is none of glTF's component types");
  }
}

struct Shape2d {
  std::uint32_t rows = 1, columns = 1;
};

Shape2d shapeOf(const Value& type) {
  const std::string name = type.text();
  static const std::map<std::string, Shape2d> shapes{{"SCALAR", {1, 1}}, {"VEC2", {2, 1}}, {"VEC3", {3, 1}},
                                                     {"VEC4", {4, 1}},   {"MAT2", {2, 2}}, {"MAT3", {3, 3}},
                                                     {"MAT4", {4, 4}}};
  const auto found = shapes.find(name);
  if (found == shapes.end())
    type.fail(ErrorKind::malformed, "is none of glTF's types");
  return found->second;
}

} // namespace

const std::uint8_t* Accessor::at(std::size_t element, std::uint32_t component) const {
  assert(element < count_ && component < components_);
  return begin_ + element * stride_ + std::size_t{component} * componentSize_;
}

ByteSpan Accessor::bytesOf(std::size_t element) const {
  return {at(element, 0), std::size_t{components_} * componentSize_};
}

double Accessor::real(std::size_t element, std::uint32_t component) const {
  const std::uint8_t* bytes = at(element, component);
  const auto scaled = [this](double value, double maximum) {
    return normalized_ ? std::max(value / maximum, -1.0) : value;
  };
  switch (componentType_) {
  case byteType:
    return scaled(static_cast<std::int8_t>(*bytes), 127);
  case unsignedByte:
    return scaled(*bytes, 255);
  case shortType:
    return scaled(loadLittle<std::int16_t>(bytes), 32767);
  case unsignedShort:
    return scaled(loadLittle<std::uint16_t>(bytes), 65535);
  case unsignedInt:
    return scaled(loadLittle<std::uint32_t>(bytes), 4294967295.0);
  default:
    return loadLittle<float>(bytes);
  }
}

std::uint32_t Accessor::whole(std::size_t element, std::uint32_t component) const {
  assert(isUnsigned());
  const std::uint8_t* bytes = at(element, component);
  return componentSize_ == 1   ? *bytes
         : componentSize_ == 2 ? loadLittle<std::uint16_t>(bytes)
                               : loadLittle<std::uint32_t>(bytes);
}

Document::Document(const Json& json, ByteSpan binary, const References& references, const std::string& name,
                   std::uint64_t sourceBytes)
    : root_(json, name, ", "), binary_(binary), references_(references),
      budget_(std::max(minBudgetBytes, sourceBytes * bytesPerSourceByte)) {}

void Document::spend(const Value& location, std::uint64_t bytes) {
  if (bytes > budget_)
    location.fail(ErrorKind::limit, "expands to more data than imgeo allows for a file of this size");
  budget_ -= bytes;
}

ByteSpan Document::checkedSubspan(const Value& value, ByteSpan bytes, std::uint64_t offset,
                                  std::uint64_t length) const {
  if (offset > bytes.size() || length > bytes.size() - offset)
    value.fail(ErrorKind::truncated,
               fmt::format("needs {} bytes from byte {} on, where {} are", length, offset, bytes.size()));
  return bytes.subspan(offset, length);
}

ByteSpan Document::buffer(std::size_t index) {
  if (const auto found = buffers_.find(index); found != buffers_.end())
    return found->second;
  const std::string uri = root_["buffers"][index]["uri"].text();
  if (uri.empty())
    return index == 0 ? binary_ : ByteSpan{};
  const Bytes& bytes = buffers_[index] = references_.fetch(uri);
  if (!isDataUrl(uri))
    budget_ += bytes.size() * bytesPerSourceByte;
  return bytes;
}

ByteSpan Document::view(std::size_t index) {
  const Value value = root_["bufferViews"][index];
  const Value compression = meshoptOf(value);
  if (!compression.isAbsent()) {
    const auto found = unpackedViews_.find(index);
    return found != unpackedViews_.end() ? found->second
                                         : unpackedViews_.emplace(index, unpacked(compression)).first->second;
  }
  const std::optional<std::size_t> buffer = value.index("buffer", root_["buffers"]);
  if (!buffer)
    value["buffer"].fail(ErrorKind::malformed, "is missing");
  return checkedSubspan(value, this->buffer(*buffer), value["byteOffset"].whole(0), value["byteLength"].whole());
}

/// Decompresses a view of EXT_meshopt_compression. The library's decoders are safe for untrusted bytes; their
/// preconditions on sizes are checked here.
Bytes Document::unpacked(const Value& value) {
  const std::optional<std::size_t> index = value.index("buffer", root_["buffers"]);
  if (!index)
    value["buffer"].fail(ErrorKind::malformed, "is missing");
  const ByteSpan packed =
      checkedSubspan(value, buffer(*index), value["byteOffset"].whole(0), value["byteLength"].whole());
  const std::uint64_t stride = value["byteStride"].whole(), count = value["count"].whole();
  const std::string mode = value["mode"].text(), filter = value["filter"].text("NONE");
  const bool isAttributes = mode == "ATTRIBUTES";
  const bool isGood = isAttributes ? stride >= 4 && stride <= 256 && stride % 4 == 0
                                   : (mode == "TRIANGLES" || mode == "INDICES") && (stride == 2 || stride == 4) &&
                                         (mode == "INDICES" || count % 3 == 0);
  if (!isGood || count > UINT32_MAX)
    value.fail(ErrorKind::malformed, "has a mode, stride or count that meshopt compression does not allow");
  spend(value, count * stride);
  Bytes bytes(count * stride);
  const int failure =
      isAttributes          ? meshopt_decodeVertexBuffer(bytes.data(), count, stride, packed.data(), packed.size())
      : mode == "TRIANGLES" ? meshopt_decodeIndexBuffer(bytes.data(), count, stride, packed.data(), packed.size())
                            : meshopt_decodeIndexSequence(bytes.data(), count, stride, packed.data(), packed.size());
  if (failure != 0)
    value.fail(ErrorKind::malformed, "holds data that meshoptimizer cannot decode");
  if (filter == "OCTAHEDRAL" && (stride == 4 || stride == 8))
    meshopt_decodeFilterOct(bytes.data(), count, stride);
  else if (filter == "QUATERNION" && stride == 8)
    meshopt_decodeFilterQuat(bytes.data(), count, stride);
  else if (filter == "EXPONENTIAL" && isAttributes)
    meshopt_decodeFilterExp(bytes.data(), count, stride);
  else if (filter != "NONE")
    value["filter"].fail(ErrorKind::malformed, "is no filter that meshoptimizer has");
  return bytes;
}

Accessor Document::accessor(std::size_t index) {
  const Value value = root_["accessors"][index];
  const Shape2d shape = shapeOf(value["type"]);
  Accessor accessor;
  accessor.components_ = shape.rows * shape.columns;
  accessor.componentSize_ = sizeOfComponent(value["componentType"]);
  accessor.componentType_ = static_cast<std::uint32_t>(value["componentType"].whole());
  accessor.normalized_ = value["normalized"].boolean(false);
  accessor.count_ = value["count"].whole();
  if (shape.columns > 1 && shape.rows * accessor.componentSize_ % 4 != 0)
    value.fail(ErrorKind::unsupported, "holds matrices with padded columns");
  const std::uint64_t elementSize = std::uint64_t{accessor.components_} * accessor.componentSize_;
  accessor.stride_ = elementSize;
  if (accessor.count_ > UINT32_MAX)
    value["count"].fail(ErrorKind::limit, "does not fit 32 bits");
  const std::optional<std::size_t> viewIndex = value.index("bufferView", root_["bufferViews"]);
  const bool isSparse = value.has("sparse");
  if (viewIndex) {
    const Value viewValue = root_["bufferViews"][*viewIndex];
    const Value compression = meshoptOf(viewValue);
    const std::uint64_t stride =
        (compression.isAbsent() ? viewValue["byteStride"] : compression["byteStride"]).whole(elementSize);
    if (stride < elementSize || stride > 65536)
      viewValue["byteStride"].fail(ErrorKind::malformed, "is less than an element of the accessor takes");
    accessor.stride_ = stride;
    const std::uint64_t bytes = accessor.count_ == 0 ? 0 : (accessor.count_ - 1) * stride + elementSize;
    accessor.begin_ = checkedSubspan(value, view(*viewIndex), value["byteOffset"].whole(0), bytes).data();
  }
  if (!viewIndex || isSparse) { // an accessor without a view holds zeros
    spend(value, accessor.count_ * elementSize);
    Bytes own(accessor.count_ * elementSize);
    for (std::size_t i = 0; viewIndex && i < accessor.count_; ++i)
      std::memcpy(own.data() + i * elementSize, accessor.begin_ + i * accessor.stride_, elementSize);
    accessor.own_ = std::move(own);
    accessor.begin_ = accessor.own_.data();
    accessor.stride_ = elementSize;
    if (isSparse)
      applySparse(value["sparse"], accessor);
  }
  return accessor;
}

void Document::applySparse(const Value& value, Accessor& accessor) {
  const std::uint64_t count = value["count"].whole();
  const auto arrayOf = [&](const char* name, std::uint64_t size) {
    const Value list = value[name];
    const std::optional<std::size_t> index = list.index("bufferView", root_["bufferViews"]);
    if (!index)
      list["bufferView"].fail(ErrorKind::malformed, "is missing");
    if (count > accessor.count_)
      value["count"].fail(ErrorKind::malformed, "is more than the accessor has elements");
    return checkedSubspan(list, view(*index), list["byteOffset"].whole(0), count * size);
  };
  const std::uint32_t indexSize = sizeOfComponent(value["indices"]["componentType"]);
  const ByteSpan indices = arrayOf("indices", indexSize), values = arrayOf("values", accessor.stride_);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t* at = indices.data() + i * indexSize;
    const std::uint32_t element = indexSize == 1   ? *at
                                  : indexSize == 2 ? loadLittle<std::uint16_t>(at)
                                                   : loadLittle<std::uint32_t>(at);
    if (element >= accessor.count_)
      value["indices"].fail(ErrorKind::malformed, fmt::format("names element {} of {}", element, accessor.count_));
    std::memcpy(accessor.own_.data() + element * accessor.stride_, values.data() + i * accessor.stride_,
                accessor.stride_);
  }
}

} // namespace imgeo::gltf
