#pragma once
// Compressed files kept in memory, so that each is compressed once.

#include "serve/content_coding.h"

#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>

namespace imgeo {

/// Least recently used entries go first. Safe to use from several threads.
class CodingCache {
public:
  /// Holds at most `limitBytes` of encoded content; one entry alone may be larger
  /// than that and is then not kept.
  explicit CodingCache(std::size_t limitBytes) : limitBytes_(limitBytes) {}

  /// The content under `key`, which names one version of a file and a coding;
  /// made by `encode` if it is not there. Two threads that miss at once both
  /// encode, which costs time and nothing else.
  std::shared_ptr<const Bytes> get(const std::string& key, const std::function<Bytes()>& encode);

  /// Bytes held now.
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
