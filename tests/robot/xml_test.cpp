#include "robot/files/xml.h"

#include <gtest/gtest.h>

#include "prohull/error.h"
#include "robot_testing.h"

namespace prohull::robot::of_xml {
namespace {

std::string message_of(const std::string& text) {
  return refusal_of([&] { const XmlDocument document(text, "arm.urdf"); });
}

TEST(XmlDocument, KnowsWhereEachElementStands) {
  const std::string text =
      "<?xml version=\"1.0\"?>\n<robot name='a&amp;b'>\n  <link name=\"l\"/>\n  <joint>x</joint>\n</robot>\n";
  const XmlDocument document(text, "arm.urdf");
  EXPECT_EQ(*document.root().attribute("name"), "a&b");
  ASSERT_EQ(document.root().children.size(), 2U);
  const XmlElement &link = *document.root().children[0], &joint = *document.root().children[1];
  EXPECT_EQ(document[link.whole], "<link name=\"l\"/>");
  EXPECT_TRUE(link.is_empty_tag());
  EXPECT_EQ(link.line, 3U);
  EXPECT_EQ(document.indentation(link), "  ");
  EXPECT_EQ(document[joint.whole], "<joint>x</joint>");
  EXPECT_EQ(document[joint.start_tag], "<joint>");
  EXPECT_EQ(joint.content, "x");
  EXPECT_EQ(document[document.root().whole], text.substr(22, text.size() - 23));
}

TEST(XmlDocument, ReadsADeclarationAfterBlankLines) {
  const std::string text = "\n \n<?xml version='1.0'?>\n<robot>\n<link/></robot>";
  const XmlDocument document(text, "arm.urdf");
  const XmlElement& link = *document.root().children.at(0);
  EXPECT_EQ(link.line, 5U);
  EXPECT_EQ(document[link.whole], "<link/>");
  EXPECT_EQ(document.text(), text);
  EXPECT_TRUE(message_of("\n<?xml version='1.0'?>\n<robot>\n<").starts_with("arm.urdf: line 4: no XML"));
}

TEST(XmlDocument, ReadsNoEntitiesOfTheDocument) {
  const std::string bomb =
      "<!DOCTYPE r [<!ENTITY a \"aaaa\"><!ENTITY b \"&a;&a;&a;\">]>\n<robot name=\"r\">&b;</robot>";
  EXPECT_NE(message_of(bomb).find("arm.urdf: line 1: the document declares an entity of its own, a"),
            std::string::npos);
  EXPECT_NE(message_of("<!DOCTYPE r [<!ENTITY a SYSTEM \"file:///etc/passwd\">]><r>&a;</r>").find("entity"),
            std::string::npos);
}

TEST(XmlDocument, RefusesWhatIsNoXmlWithTheLine) {
  EXPECT_EQ(message_of("<robot>\n<link>\n</robot>"), "arm.urdf: line 3: no XML: mismatched tag");
  EXPECT_EQ(message_of("<robot>\n<link>\n"), "arm.urdf: line 3: no XML: the file ends before </link>: it was cut off");
  EXPECT_EQ(message_of("<robot>\n<link"), "arm.urdf: line 2: no XML: the file ends before </robot>: it was cut off");
  EXPECT_NE(message_of(""), "");
  std::string deep;
  for (int i = 0; i < 100'000; ++i) deep += "<a>";
  EXPECT_NE(message_of(deep).find("nested more than 200 deep"), std::string::npos);
  EXPECT_NE(message_of(std::string("\xff\xfe<\0r\0", 6)).find("UTF-16"), std::string::npos);
}

TEST(XmlDocument, ReadsNumbers) {
  const XmlDocument document("<a xyz=' 1 -2e-3\t+3 ' bad='1 2 x' two='1 2' inf='inf'/>", "arm.urdf");
  EXPECT_EQ(document.vector(document.root(), "xyz", {}), (Vec3{1, -2e-3, 3}));
  EXPECT_EQ(document.vector(document.root(), "none", {4, 5, 6}), (Vec3{4, 5, 6}));
  EXPECT_THROW(document.vector(document.root(), "bad", {}), InputError);
  EXPECT_THROW(document.vector(document.root(), "two", {}), InputError);
  EXPECT_THROW(document.number(document.root(), "two", 0), InputError);
  EXPECT_THROW(document.number(document.root(), "inf", 0), InputError);
}

TEST(WithEdits, KeepsAllOtherBytes) {
  EXPECT_EQ(with_edits("0123456789", {{{6, 8}, "ab"}, {{2, 2}, "x"}, {{2, 2}, "y"}}), "01xy2345ab89");
}

}  // namespace
}  // namespace prohull::robot::of_xml
