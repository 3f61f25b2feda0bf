#include "import/chunks/json_elements.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace imgeo {
namespace {

TEST(JsonElements, AreThoseThatAParserFinds) {
  const std::string text = R"( {"a" : [1,"]}\"\\",{"b":[]}, [ ] ,null] ,"c":{}, "d\"\u0061":-1.5e3 ,"e":"x,y:{",
    "a" : [ true , [[2],{"f":"["}] ]} )";
  const nlohmann::json whole = nlohmann::json::parse(text);
  nlohmann::json found = nlohmann::json::object(); // of members of one name the last counts
  for (const JsonMember& member : membersOf(text))
    found[member.name] = nlohmann::json::parse(member.value);
  EXPECT_EQ(found, whole);
  for (const JsonMember& member : membersOf(text)) {
    const nlohmann::json value = nlohmann::json::parse(member.value);
    const std::vector<std::string_view> elements = elementsOf(member.value);
    const JsonElements compact(member.value);
    ASSERT_EQ(elements.size(), value.is_array() ? value.size() : 0) << member.value;
    ASSERT_EQ(compact.size(), elements.size());
    for (std::size_t i = 0; i < elements.size(); ++i) {
      EXPECT_EQ(nlohmann::json::parse(elements[i]), value[i]);
      EXPECT_EQ(compact[i], elements[i]);
    }
  }
}

TEST(JsonElements, AreNoneOfEmptyAndOtherValues) {
  for (const char* text : {"{}", "[ ]", " { } ", "1", "\"[1]\"", "null"}) {
    EXPECT_TRUE(membersOf(text).empty()) << text;
    EXPECT_TRUE(elementsOf(text).empty()) << text;
    EXPECT_EQ(JsonElements(text).size(), 0u) << text;
  }
}

} // namespace
} // namespace imgeo
