#pragma once
// The faults of a document that is read nevertheless, as sentences.

#include <cstddef>
#include <string>
#include <unordered_set>
#include <vector>

namespace imgeo {

/// Adds sentences to a list that others may add to as well: each once, since a node is read again for each of its USEs
/// and instances. Memory stays bounded: after `maxSentences` different ones a last sentence says that further faults
/// are not listed.
class DocumentWarnings {
public:
  static constexpr std::size_t maxSentences = 1000;
  static constexpr const char* lastSentence = "Further faults of fields are not listed.";

  /// `sentences` must outlive this.
  explicit DocumentWarnings(std::vector<std::string>& sentences) : sentences_(sentences) {}

  void add(std::string sentence);

  std::size_t count() const { return sentences_.size(); }

  /// Removes all sentences but the first `count` of the list; those that are removed can be added again.
  void keepFirst(std::size_t count);

private:
  std::vector<std::string>& sentences_;
  std::unordered_set<std::string> known_;
};

} // namespace imgeo
