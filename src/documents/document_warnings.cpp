#include "documents/document_warnings.h"

#include <utility>

namespace imgeo {

void DocumentWarnings::add(std::string sentence) {
  if (known_.size() > maxSentences || known_.contains(sentence))
    return;
  if (known_.size() == maxSentences)
    sentence = lastSentence;
  known_.insert(sentence);
  sentences_.push_back(std::move(sentence));
}

void DocumentWarnings::keepFirst(std::size_t count) {
  while (sentences_.size() > count) {
    known_.erase(sentences_.back());
    sentences_.pop_back();
  }
}

} // namespace imgeo
