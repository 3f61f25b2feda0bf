#include "documents/document_warnings.h"

#include "documents/documents.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

TEST(DocumentWarnings, HasEachSentenceOnceHoweverManyAreBetween) {
  std::vector<std::string> sentences{"Of another reader."};
  DocumentWarnings warnings(sentences);
  for (int repetition = 0; repetition < 2; ++repetition)
    for (int n = 0; n < 50; ++n)
      warnings.add(fmt::format("Fault {}.", n));
  ASSERT_EQ(sentences.size(), 51u);
  EXPECT_EQ(sentences[50], "Fault 49.");
}

TEST(DocumentWarnings, SaysOnceThatFurtherFaultsAreNotListed) {
  std::vector<std::string> sentences;
  DocumentWarnings warnings(sentences);
  for (int repetition = 0; repetition < 2; ++repetition)
    for (std::size_t n = 0; n < DocumentWarnings::maxSentences + 100; ++n)
      warnings.add(fmt::format("Fault {}.", n));
  ASSERT_EQ(sentences.size(), DocumentWarnings::maxSentences + 1);
  EXPECT_EQ(sentences[DocumentWarnings::maxSentences - 1], "Fault 999.");
  EXPECT_EQ(sentences.back(), DocumentWarnings::lastSentence);
}

TEST(DocumentWarnings, AddsSentencesAgainThatWereRemoved) {
  std::vector<std::string> sentences;
  DocumentWarnings warnings(sentences);
  warnings.add("A.");
  const std::size_t count = warnings.count();
  warnings.add("B.");
  warnings.keepFirst(count);
  EXPECT_EQ(sentences, std::vector<std::string>{"A."});
  warnings.add("A.");
  warnings.add("B.");
  EXPECT_EQ(sentences, (std::vector<std::string>{"A.", "B."}));
}

/// Forty faulty nodes, each drawn twice: the second reading of a node comes after forty other faults.
TEST(DocumentWarnings, OfADocumentAreNotRepeatedByItsUses) {
  std::string text = "<X3D><Scene>\n";
  for (const char* name : {"DEF", "USE"})
    for (int n = 0; n < 40; ++n)
      text += fmt::format("<Shape><Appearance {}='a{}'>{}</Appearance></Shape>\n", name, n,
                          name[0] == 'D' ? "<Material shininess='much'/>" : "");
  EXPECT_EQ(readScene(text + "</Scene></X3D>", "s.x3d").warnings.size(), 40u);
  std::string many = "<X3D><Scene>\n";
  for (std::size_t n = 0; n < DocumentWarnings::maxSentences + 5; ++n)
    many += "<Shape><Appearance><Material shininess='much'/></Appearance></Shape>\n";
  const std::vector<std::string> warnings = readScene(many + "</Scene></X3D>", "s.x3d").warnings;
  ASSERT_EQ(warnings.size(), DocumentWarnings::maxSentences + 1);
  EXPECT_EQ(warnings.back(), DocumentWarnings::lastSentence);
}

} // namespace
} // namespace imgeo
