#pragma once
// An LRU cache of values by url.

#include <algorithm>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace imgeo {

/// Keeps the four most recently used values. Safe to call from any thread: several callers of one url wait for the
/// first, which makes the value.
template <typename Value> class LruCache {
public:
  /// The value of a url: the cached one, or else make(url). Passes on exceptions of `make`.
  template <typename Make> std::shared_ptr<const Value> get(const std::string& url, Make make) {
    const std::shared_ptr<Entry> entry = entryOf(url);
    const std::lock_guard lock(entry->mutex);
    if (!entry->value)
      entry->value = std::make_shared<const Value>(make(url));
    return entry->value;
  }

private:
  struct Entry {
    std::string url;
    std::mutex mutex;
    std::shared_ptr<const Value> value;
  };

  std::shared_ptr<Entry> entryOf(const std::string& url) {
    const std::lock_guard lock(mutex_);
    auto found = std::ranges::find(entries_, url, [](const auto& entry) { return entry->url; });
    if (found == entries_.end()) {
      auto entry = std::make_shared<Entry>();
      entry->url = url;
      entries_.push_front(std::move(entry));
      if (entries_.size() > maxEntries)
        entries_.pop_back();
    } else {
      entries_.splice(entries_.begin(), entries_, found);
    }
    return entries_.front();
  }

  static constexpr std::size_t maxEntries = 4;
  std::mutex mutex_;
  std::list<std::shared_ptr<Entry>> entries_; ///< most recently used first
};

} // namespace imgeo
