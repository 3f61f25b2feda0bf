#include "publish/destination.h"

namespace imgeo::live {

namespace {

class LocalDestination final : public Destination {
public:
  LocalDestination(std::shared_ptr<Stream> stream, std::string url)
      : stream_(std::move(stream)), url_(std::move(url)) {}
  ~LocalDestination() override { stream_->end(); }

  void beginEpoch(const Description& description) override { epoch_ = stream_->beginEpoch(description); }
  bool isDue() override { return stream_->isDue(); }
  void countClamped(std::uint64_t values) override { stream_->countClamped(values); }

  PublishReport publish(Frame frame) override {
    frame.epoch = epoch_;
    frame.number = stream_->state().next;
    Bytes bytes = encodeFrame(frame);
    const std::size_t size = bytes.size();
    const FrameHeader header = readFrameHeader(bytes, stream_->name());
    stream_->add(header, std::move(bytes));
    ++published_;
    bytes_ += size;
    return {frame.number, size, 0};
  }

  PublisherTotals totals() const override {
    return {published_, stream_->droppedCount(), stream_->clampedCount(), bytes_, {}};
  }
  std::string url() const override { return url_; }

private:
  std::shared_ptr<Stream> stream_;
  std::string url_;
  std::uint64_t epoch_ = 0, published_ = 0, bytes_ = 0;
};

} // namespace

std::unique_ptr<Destination> makeLocalDestination(std::shared_ptr<Stream> stream, std::string url) {
  return std::make_unique<LocalDestination>(std::move(stream), std::move(url));
}

} // namespace imgeo::live
