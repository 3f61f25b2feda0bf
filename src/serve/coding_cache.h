#pragma once
// A cache of compressed files in memory.

#include "content/content_coding.h"

#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>

namespace imgeo {

/// Evicts the least recently used entries first. Safe to use from several threads.
class CodingCache {
public:
  /// Holds at most `limitBytes` of encoded content; larger content is returned but not kept.
  explicit CodingCache(std::size_t limitBytes) : limitBytes_(limitBytes) {}

  /// The encoded content for `key`, which names one version of a file and a coding; calls `encode` if the cache lacks
  /// it. Two threads that miss at the same time both encode.
  std::shared_ptr<const Bytes> get(const std::string& key, const std::function<Bytes()>& encode);

  /// Bytes of content in the cache.
  std::size_t heldBytes() const;

private:
  struct Entry {
    std::string key;
    std::shared_ptr<const Bytes> content;
  };

  std::size_t limitBytes_;
  mutable std::mutex mutex_;
  std::size_t heldBytes_ = 0;
  std::list<Entry> entries_; ///< most recently used first
  std::unordered_map<std::string, std::list<Entry>::iterator> byKey_;
};

} // namespace imgeo
