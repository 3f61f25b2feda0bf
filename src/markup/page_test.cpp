// Pages as people and tools write them: what browsers make of their <x3d> elements. The expected trees are those of the
// DOM in browsers.

#include "base/error.h"
#include "base/soak_testing.h"
#include "markup/x3d_element.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

/// "name(child child(...))" for an element; attributes are left out.
std::string outlineOf(pugi::xml_node element) {
  std::string children;
  for (const pugi::xml_node& child : element.children())
    if (child.type() == pugi::node_element)
      children += (children.empty() ? "" : " ") + outlineOf(child);
  return element.name() + (children.empty() ? "" : "(" + children + ")");
}

std::string outlineOf(const std::string& html) {
  return outlineOf(parsePage(html, "a.html").root());
}

Error errorOf(const std::string& html) {
  try {
    parsePage(html, "folder/a.html");
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "was read: " << html;
  return {ErrorKind::usage, "", ""};
}

TEST(Page, IsReadWithAllThatHtmlAllows) {
  const X3dElement x3d = parsePage(R"(<!doctype html>
<meta charset=utf-8><title> The
hall </title><link rel=stylesheet href=x3dom.css>
<script>if (a<b) document.write("<x3d><scene></scene></x3d>")</script>
<body onload=init() hidden>
<p>Unclosed<br><img src=a.png>
<!-- <x3d> -->
<div title="<x3d>"><ul><li>one<li>two</ul>
<X3D id=hall showStat=false WIDTH='600px'>
  <scene>
    <Shape DEF="a&amp;b" render><appearance></appearance><!-- a comment --><box size='1 2 3'></box></shape>
  </scene>
</X3D>
</div><table><tr><td>1</table>)",
                                   "a.html");
  EXPECT_EQ(outlineOf(x3d.root()), "X3D(scene(Shape(appearance box)))");
  const pugi::xml_node shape = x3d.root().child("scene").child("Shape");
  EXPECT_STREQ(shape.attribute("DEF").value(), "a&b");
  EXPECT_TRUE(shape.attribute("render"));
  EXPECT_STREQ(shape.child("box").attribute("size").value(), "1 2 3");
  EXPECT_STREQ(x3d.root().attribute("WIDTH").value(), "600px");
  EXPECT_EQ(shape.child("box").previous_sibling().type(), pugi::node_comment);
  EXPECT_EQ(x3d.pageTitle, "The\nhall");
  EXPECT_TRUE(x3d.warnings.empty()) << x3d.warnings[0];
}

TEST(Page, NestsElementsThatHtmlDoesNotKnowByTheirNames) {
  EXPECT_EQ(
      outlineOf("<x3d><scene><shape><appearance><material></appearance><box></box></shape><group></group></scene>"),
      "x3d(scene(shape(appearance(material) box) group))");
  EXPECT_EQ(outlineOf("<x3d><scene><transform><shape><box></transform><sphere></sphere></scene></x3d>"),
            "x3d(scene(transform(shape(box)) sphere))");
  EXPECT_EQ(outlineOf("<x3d><scene></shape></foo><box></box></scene></x3d><group></group>"), "x3d(scene(box))");
  EXPECT_EQ(outlineOf("<div><x3d><scene></foo> </bar> </scene> </x3d> <p> <box></box></div>"), "x3d(scene)");
  EXPECT_EQ(outlineOf("<x3d><scene><param name=a><meta name=b content=c><box></box></scene></x3d>"),
            "x3d(scene(param meta box))");
}

TEST(Page, HasItsScriptsAndCommentsAsNoMarkup) {
  EXPECT_EQ(outlineOf("<x3d><scene><script>'</x3d>' <a> </script><!-- </scene> <!-- --><box></box></scene></x3d>"),
            "x3d(scene(script box))");
  EXPECT_EQ(outlineOf("<x3d><scene><?instruction </scene ?><![CDATA[ </x ]]><box a='</scene>' b=\">\"></box></scene>"),
            "x3d(scene(box))");
}

TEST(Page, SaysWhatBrowsersDoNotShowAsItIsWritten) {
  const auto warningsOf = [](const std::string& html) { return parsePage(html, "folder/a.html").warnings; };
  EXPECT_EQ(warningsOf("\n<x3d><scene><box></box></scene>"),
            std::vector<std::string>{"a.html:2: the <x3d> element has no end tag; the page may be cut off."});
  EXPECT_EQ(warningsOf("<div>\n<x3d><scene></scene></div><p>"),
            std::vector<std::string>{"a.html:2: the <x3d> element has no end tag; the page may be cut off."});
  EXPECT_EQ(
      warningsOf("<x3d><scene>\n<viewpoint/><shape></shape></scene></x3d>"),
      std::vector<std::string>{"a.html:2: an element ends with \"/>\", which HTML ignores: what follows lies inside."});
  EXPECT_TRUE(warningsOf("<x3d><scene><shape><appearance><material/></appearance></shape></scene></x3d>").empty());
  EXPECT_EQ(warningsOf("<x3d><scene></scene></x3d><X3D><scene></scene></X3D>"),
            std::vector<std::string>{"a.html:1: this is the first <x3d> element of 2; the others are not read."});
}

TEST(Page, HasTheLineOfEachElement) {
  const std::string html = "<!DOCTYPE html>\r\n<x3d>\r\n<scene>\n\t<shape\n><b><box></box></scene></x3d>";
  const X3dElement x3d = parsePage(html, "a.html");
  const pugi::xml_node shape = x3d.root().child("scene").child("shape");
  EXPECT_EQ(x3d.offsets.of(shape), html.find("<shape"));
  EXPECT_EQ(x3d.offsets.of(shape.child("b").child("box")), html.find("<box"));
}

TEST(Page, LeavesOutNamesThatXmlDoesNotAllow) {
  const X3dElement x3d = parsePage("<x3d><scene><box a\"b=1 <c=2 d='3'></box><a<b></scene></x3d>", "a.html");
  const pugi::xml_node box = x3d.root().child("scene").child("box");
  ASSERT_TRUE(box);
  EXPECT_STREQ(box.first_attribute().name(), "d");
  EXPECT_FALSE(box.first_attribute().next_attribute());
  EXPECT_EQ(outlineOf(x3d.root()), "x3d(scene(box))");
}

TEST(Page, IsRefusedWithItsNameAndLine) {
  EXPECT_EQ(errorOf("<p>no scene").message(), "there is no <X3D> element");
  EXPECT_EQ(errorOf("<!-- <x3d></x3d> -->").kind(), ErrorKind::malformed);
  std::string deep = "<x3d>\n";
  for (std::size_t i = 0; i <= maxPageDepth; ++i)
    deep += "<group>\n";
  EXPECT_EQ(errorOf(deep).kind(), ErrorKind::limit);
  EXPECT_EQ(errorOf(deep).location(), "folder/a.html:" + std::to_string(1 + maxPageDepth));
  EXPECT_EQ(errorOf(std::string(maxPageBytes + 1, ' ')).kind(), ErrorKind::limit);
}

void expectMayNest(int depth) { // the parser takes time that grows with the square of it
  std::string html;
  for (int i = 0; i < depth; ++i)
    html += "<div>";
  EXPECT_EQ(outlineOf(html + "<x3d></x3d>"), "x3d");
}

TEST(Page, MayNestItsOtherElementsDeeply) {
  expectMayNest(15000);
}

SOAK_TEST(Page, MayNestItsOtherElementsMoreDeeply) {
  expectMayNest(40000);
}

TEST(Text, IsAPageByItsNameOrItsBeginning) {
  EXPECT_TRUE(isHtml("<X3D>", "a.HTML"));
  EXPECT_TRUE(isHtml("<?xml version='1.0'?><html>", "a.htm")) << "as servers send it";
  EXPECT_FALSE(isHtml("<!DOCTYPE html><html>", "a.xhtml"));
  EXPECT_TRUE(isHtml(" <!-- a --> <!DOCTYPE HTML><X3D>", "standard input"));
  EXPECT_TRUE(isHtml("<html lang=en>", "index"));
  EXPECT_FALSE(isHtml("<?xml version='1.0'?><!DOCTYPE html><html xmlns='http://www.w3.org/1999/xhtml'>", "index"));
  EXPECT_FALSE(isHtml("<X3D>", "index"));
}

} // namespace
} // namespace imgeo
