#pragma once
// The streams of a file, each with one coder for all patches. A coder is made when the first patch uses it.

#include "base/error.h"
#include "containers/compact/code_attributes.h"
#include "containers/compact/code_positions.h"
#include "containers/compact/segments.h"
#include "containers/compact/sizes.h"
#include "containers/compact/wedges.h"

#include <optional>

namespace imgeo::compact {

/// Number of models of a stream.
inline std::size_t modelsOf(std::size_t stream, Version version) {
  const std::size_t models[] = {sizeModels::count, connectivityModels, segmentModels::count,
                                positionModelsOf(version).count, wedgeModels::count};
  return stream < std::size(models) ? models[stream] : attributeModels::count;
}

inline std::size_t streamOf(StreamName name) {
  return static_cast<std::size_t>(name);
}
/// The stream of the attribute with this index in the header.
inline std::size_t streamOfAttribute(std::size_t attribute) {
  return streamOf(StreamName::attributes) + attribute;
}

class StreamEncoders {
public:
  StreamEncoders(std::size_t count, Version version) : encoders_(count), version_(version) {}

  RangeEncoder& operator[](std::size_t stream) {
    std::optional<RangeEncoder>& encoder = encoders_[stream];
    return encoder ? *encoder : encoder.emplace(modelsOf(stream, version_));
  }
  RangeEncoder& operator[](StreamName name) { return (*this)[streamOf(name)]; }

  /// The bytes of each stream; empty for streams that no patch used.
  std::vector<Bytes> finish() {
    std::vector<Bytes> streams;
    for (std::optional<RangeEncoder>& encoder : encoders_)
      streams.push_back(encoder ? encoder->finish() : Bytes{});
    return streams;
  }

private:
  std::vector<std::optional<RangeEncoder>> encoders_;
  Version version_;
};

class StreamDecoders {
public:
  /// `bytes` begin with the streams of `header`, which lie within them; they and `location` outlive the decoders.
  StreamDecoders(ByteSpan bytes, const FileHeader& header, const std::string& location)
      : decoders_(header.streamCount()), version_(header.version), location_(location) {
    for (const std::uint32_t length : header.streamLengths) {
      streams_.push_back(bytes.first(length));
      bytes = bytes.subspan(length);
    }
  }

  RangeDecoder& operator[](std::size_t stream) {
    std::optional<RangeDecoder>& decoder = decoders_[stream];
    return decoder ? *decoder : decoder.emplace(streams_[stream], modelsOf(stream, version_), location_);
  }
  RangeDecoder& operator[](StreamName name) { return (*this)[streamOf(name)]; }

  /// Throws Error{malformed} unless all bytes of the stream have been decoded. To be called after the last patch.
  void finish(std::size_t stream) const {
    if (decoders_[stream])
      decoders_[stream]->finish();
    else if (!streams_[stream].empty())
      throw Error(ErrorKind::malformed, location_, "a stream is not as long as what it holds");
  }
  void finish() const {
    for (std::size_t stream = 0; stream < decoders_.size(); ++stream)
      finish(stream);
  }

private:
  std::vector<std::optional<RangeDecoder>> decoders_;
  std::vector<ByteSpan> streams_;
  Version version_;
  const std::string& location_;
};

} // namespace imgeo::compact
