#include "serve/coding_cache.h"

namespace imgeo {

std::shared_ptr<const Bytes> CodingCache::get(const std::string& key, const std::function<Bytes()>& encode) {
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = byKey_.find(key); found != byKey_.end()) {
      entries_.splice(entries_.begin(), entries_, found->second);
      return found->second->content;
    }
  }
  auto content = std::make_shared<const Bytes>(encode());
  const std::lock_guard lock(mutex_);
  if (content->size() > limitBytes_ || byKey_.contains(key))
    return content;
  entries_.push_front({key, content});
  byKey_[key] = entries_.begin();
  heldBytes_ += content->size();
  while (heldBytes_ > limitBytes_) {
    heldBytes_ -= entries_.back().content->size();
    byKey_.erase(entries_.back().key);
    entries_.pop_back();
  }
  return content;
}

std::size_t CodingCache::heldBytes() const {
  const std::lock_guard lock(mutex_);
  return heldBytes_;
}

} // namespace imgeo
