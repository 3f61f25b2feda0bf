#pragma once
// An LRU cache of values by url.

#include "base/error.h"

#include <algorithm>
#include <exception>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace imgeo {

/// Keeps the four most recently used values, or the reasons why there are none, so that a broken file is not decoded
/// for each of its patches. Safe to call from any thread: several callers of one url wait for the first, which makes
/// the value.
template <typename Value> class LruCache {
public:
  /// The value of a url: the cached one, or else make(url). Passes on exceptions of `make`.
  template <typename Make> std::shared_ptr<const Value> get(const std::string& url, Make make) {
    const std::shared_ptr<Entry> entry = entryOf(url);
    const std::lock_guard lock(entry->mutex);
    if (!entry->value && !entry->failure)
      try {
        entry->value = std::make_shared<const Value>(make(url));
      } catch (const Error&) {
        entry->failure = std::current_exception();
      }
    if (entry->failure)
      std::rethrow_exception(entry->failure);
    return entry->value;
  }

private:
  struct Entry {
    std::string url;
    std::mutex mutex;
    std::shared_ptr<const Value> value;
    std::exception_ptr failure; ///< the Error of `make`
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
