#pragma once
// An array that is a file without a name: it grows beyond what the machine's memory holds.

#include "base/scratch_file.h"

#include <algorithm>
#include <type_traits>

namespace imgeo {

template <typename T> class ScratchArray {
  static_assert(std::is_trivially_copyable_v<T>);

public:
  /// An empty array on the disk of `folder`. Throws as ScratchFile does.
  explicit ScratchArray(const std::filesystem::path& folder) : file_(folder) {}

  /// Throws Error{io} where the disk has no room.
  void append(const T& value) {
    if (size_ == room_) {
      room_ += std::clamp<std::size_t>(room_, firstRoom, maxGrowth);
      values_ = reinterpret_cast<T*>(file_.resize(room_ * sizeof(T)).data());
    }
    values_[size_++] = value;
  }
  /// Lets it have so many values, all of which are to be set. Throws as append() does.
  void resize(std::size_t size) {
    size_ = size;
    shrink();
  }
  /// Gives back the room that is not in use.
  void shrink() {
    room_ = size_;
    values_ = reinterpret_cast<T*>(file_.resize(room_ * sizeof(T)).data());
  }

  std::size_t size() const { return size_; }
  const T& operator[](std::size_t i) const { return values_[i]; }
  T& operator[](std::size_t i) { return values_[i]; }
  std::span<const T> values() const { return {values_, size_}; } ///< until the next append or shrink

private:
  static constexpr std::size_t firstRoom = 1024, maxGrowth = (std::size_t{64} << 20) / sizeof(T);

  ScratchFile file_;
  T* values_ = nullptr;
  std::size_t size_ = 0, room_ = 0;
};

} // namespace imgeo
