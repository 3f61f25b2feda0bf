#include "documents/page_sanitizer.h"

#include "documents/documents.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

TEST(PageSanitizer, AllowsNodesOfX3dAndNoActiveElement) {
  for (const char* node : {"Transform", "Switch", "LOD", "TimeSensor", "ROUTE", "IndexedFaceSet", "Text"})
    EXPECT_TRUE(isAllowedInPage(node)) << node;
  for (const char* element : {"Script", "script", "SCRIPT", "iframe", "img", "svg", "style", "link", "meta", "base",
                              "form", "template", "ProtoDeclare", "x-y", ""})
    EXPECT_FALSE(isAllowedInPage(element)) << element;
}

TEST(PageSanitizer, RefusesAttributesOnWhichBrowsersAct) {
  for (const char* name : {"onload", "ONCLICK", "onx", "style", "src", "srcdoc", "href", "xlink:href", "Style", "is"})
    EXPECT_FALSE(isInertAttribute(name)) << name;
  for (const char* name : {"on", "id", "class", "translation", "url", "DEF", "whichChoice"})
    EXPECT_TRUE(isInertAttribute(name)) << name;
}

TEST(PageSanitizer, AllowsRelativeUrlsAndUrlsOfHttp) {
  for (const char* url : {"a.png", "../b/c.x3d", "http://a/b", "HTTPS://a", "?x:y", "#a:b"})
    EXPECT_TRUE(isSafeUrl(url)) << url;
  for (const char* url : {"javascript:alert(1)", " JavaScript:alert(1)", "java\nscript:alert(1)", "\x01javascript:1",
                          "data:text/html,<script>", "vbscript:x", "file:///etc/passwd", "ecmascript:x", ":x"})
    EXPECT_FALSE(isSafeUrl(url)) << url;
  EXPECT_EQ(safeUrls("\"javascript:1\" \"a.png\""), "\"a.png\"");
  EXPECT_EQ(safeUrls("\"data:,x\""), "");
}

std::size_t addGeneric(SceneGraph& graph, const std::string& element, std::vector<FieldText> fields,
                       std::vector<std::size_t> children = {}, const std::string& text = "") {
  return addNode(graph, {"", GenericNode{element, text, {}}, std::move(children), "", std::move(fields)});
}

/// A document with all kinds of active content that a hostile X3D source might have.
SceneDocument hostileDocument() {
  SceneDocument document;
  SceneGraph& graph = document.graph;
  graph.isComplete = true;
  const std::size_t inside = addGeneric(graph, "Viewpoint", {{"description", "\"><script>alert(1)</script>"}});
  graph.roots = {
      addGeneric(graph, "Script", {{"url", "javascript:alert(2)"}}, {}, "alert(3) </script> ]]>"),
      addGeneric(graph, "script", {{"src", "http://evil/x.js"}}, {}, "alert(4)"),
      addGeneric(graph, "iframe", {{"srcdoc", "<script>alert(5)</script>"}}, {inside}),
      addGeneric(graph, "TouchSensor", {{"onclick", "alert(6)"}, {"ONLOAD", "alert(7)"}, {"style", "x:url(//evil)"}}),
      addGeneric(graph, "Inline", {{"url", "\"java\tscript:alert(8)\" \"data:text/html,alert(9)\" \"part.x3d\""}}),
      addGeneric(graph, "AudioClip", {{"url", "data:audio/wav,alert(10)"}}),
      addGeneric(graph, "DirectionalLight", {{"on", "false"}})};
  graph.head.header = {addGeneric(graph, "meta", {{"http-equiv", "refresh"}, {"content", "0;url=//evil"}})};
  return document;
}

TEST(PageSanitizer, RemovesActiveContentOfAHostileDocument) {
  const std::string html = writeHtml(hostileDocument(), {"imgeo.js", "imgeo.css"});
  const std::string body = html.substr(html.find("<body>"));
  EXPECT_EQ(body.find("<script"), std::string::npos) << body;
  for (const char* never : {"<Script", "<iframe", "<meta", "onclick", "ONLOAD", "style=", "srcdoc", "javascript",
                            "script:", "data:", "evil", "alert(2)", "alert(3)", "alert(8)", "alert(9)"})
    EXPECT_EQ(body.find(never), std::string::npos) << never << "\n" << body;
  for (const char* kept : {"&lt;script", "url='\"part.x3d\"'", "<DirectionalLight on=\"false\">"})
    EXPECT_NE(body.find(kept), std::string::npos) << kept << "\n" << body;
}

TEST(PageSanitizer, WritesTheStyleOfFontsAsADataAttribute) {
  SceneDocument document;
  document.graph.roots = {addGeneric(document.graph, "FontStyle", {{"style", "BOLD"}, {"size", "2"}})};
  EXPECT_NE(writeHtml(document, {"imgeo.js", "imgeo.css"}).find("<FontStyle size=\"2\" data-style=\"BOLD\">"),
            std::string::npos);
  EXPECT_NE(writeX3d(document).find("<FontStyle style=\"BOLD\" size=\"2\">"), std::string::npos);
}

TEST(PageSanitizer, LeavesTheX3dFileUnchanged) {
  const std::string file = writeX3d(hostileDocument());
  for (const char* kept :
       {"<Script", "alert(3) &lt;/script&gt; ]]&gt;", "<meta", "<head>", "onclick", "javascript:alert(2)"})
    EXPECT_NE(file.find(kept), std::string::npos) << kept << "\n" << file;
}

} // namespace
} // namespace imgeo
