#include "src/scene/read_xml.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/unit/scene_folder.h"

namespace lemma {
namespace {

constexpr std::string_view kAttributes = R"(<?xml version="1.0" encoding="utf-8"?>
<camera type="perspective" width="1280" height="720" fovy="20.1143">
  <!-- where it stands -->
  <eye x="28.2792" y="5.2" z="1.23612e-06"/>
  <lookat x="0.0" y="2.8" z="0.0"/>
  <up x="0.0" y="2.0" z="0.0"/>
</camera>
<light mtlname="light1" radiance="300,300,300"/>
<light mtlname="light2" radiance="34.0, 24.0, 8.0 "/>
<light mtlname="light3" radiance="2.5,
                1.5,
                0.5"/>
)";

constexpr std::string_view kChildren = R"(<camera type="perspective">
	<eye value=" 28.2792, 5.2, 1.23612e-06"/>
	<lookat value="0, 2.8, 0"/>
	<up value="0, 2, 0"/>
	<fovy value="20.1143"/>
	<width value="1280"/>
	<height>720</height>
</camera>
<light mtlname="light1"><radiance value="300, 300, 300"/></light>
)";

class ReadXml : public testing::Test {
 protected:
  XmlScene read(std::string_view text) { return read_xml(folder_.write("a.xml", text), warnings_); }

  std::string error_of(std::string_view text) {
    return folder_.error_of([&] { (void)read(text); });
  }

  /// The error of the attribute dialect, one part of it replaced.
  std::string error_with(std::string_view part, std::string_view replacement) {
    std::string text(kAttributes);
    text.replace(text.find(part), part.size(), replacement);
    return error_of(text);
  }

  std::vector<std::string> plain_warnings() const {
    std::vector<std::string> plain;
    for (const std::string& warning : warnings_) plain.push_back(folder_.plain(warning));
    return plain;
  }

  test::SceneFolder folder_;
  Warnings warnings_;
};

void expect_view(const CameraView& view) {
  EXPECT_EQ(view.eye, Vec3(28.2792f, 5.2f, 1.23612e-06f));
  EXPECT_EQ(view.look_at, Vec3(0, 2.8f, 0));
  EXPECT_EQ(view.up, Vec3(0, 2, 0));
  EXPECT_EQ(view.fovy, 20.1143);
  EXPECT_EQ(view.width, 1280);
  EXPECT_EQ(view.height, 720);
}

TEST_F(ReadXml, AttributeDialect) {
  const XmlScene scene = read(kAttributes);
  expect_view(scene.view);
  EXPECT_EQ(scene.dialect, "XML, no root, attributes");
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_EQ(scene.lights[0].material, "light1");
  EXPECT_EQ(scene.lights[0].radiance, (Rgb{300, 300, 300}));
  EXPECT_EQ(scene.lights[1].radiance, (Rgb{34, 24, 8}));
  EXPECT_EQ(scene.lights[2].radiance, (Rgb{2.5f, 1.5f, 0.5f})) << "line breaks inside of the attribute";
  EXPECT_EQ(scene.lights[2].where.line, 10);
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(ReadXml, ChildDialect) {
  const XmlScene scene = read(kChildren);
  expect_view(scene.view);
  EXPECT_EQ(scene.dialect, "XML, no root, children with values");
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].radiance, (Rgb{300, 300, 300}));
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(ReadXml, RootElementsAreOptional) {
  for (const std::string root : {"scene", "root"}) {
    const XmlScene scene = read(fmt::format("<{0}>\r\n{1}</{0}>", root, kChildren));
    expect_view(scene.view);
    EXPECT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.dialect, fmt::format("XML, <{}>, children with values", root));
  }
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(ReadXml, ByteOrderMark) {
  expect_view(read(std::string("\xEF\xBB\xBF").append(kAttributes)).view);
}

TEST_F(ReadXml, UnknownNamesAreWarnedOfOnce) {
  read(std::string("<scene>").append(kChildren) +
       "<render spp=\"1\"/><render spp=\"2\"/><scene/>\n<light mtlname=\"b\" radiance=\"1,1,1\" "
       "power=\"3\"/></scene>");
  EXPECT_EQ(plain_warnings(),
            (Warnings{"FOLDER/a.xml:10:1: warning: <render> is unknown and left out",
                      "FOLDER/a.xml:10:35: warning: <scene> is unknown and left out",
                      "FOLDER/a.xml:11:1: warning: power of <light> is unknown and left out"}));
  warnings_.clear();
  read(R"(<camera width="1" height="1" fovy="9" near="1"><eye x="0" y="0" z="0" w="0"/><lookat value="1 0 0"/>
<up value="0 1 0"/><lens/></camera>)");
  EXPECT_EQ(plain_warnings(),
            (Warnings{"FOLDER/a.xml:1:1: warning: near of <camera> is unknown and left out",
                      "FOLDER/a.xml:1:48: warning: w of <eye> is unknown and left out",
                      "FOLDER/a.xml:2:20: warning: <lens> in <camera> is unknown and left out"}));
}

TEST_F(ReadXml, OfTwoLightsOfOneMaterialTheLaterCounts) {
  const XmlScene scene = read(std::string(kChildren) + R"(<light mtlname="light1" radiance="1,2,3"/>)");
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].radiance, (Rgb{1, 2, 3}));
  EXPECT_EQ(
      plain_warnings(),
      Warnings{"FOLDER/a.xml:10:1: warning: light \"light1\" is given in line 9 already; this one is used"});
}

TEST_F(ReadXml, SyntaxErrorsHaveLineAndColumn) {
  EXPECT_EQ(error_of("<camera>\n  <eye x=\"1\"/>\n</camara>\n"),
            "FOLDER/a.xml:3:3: error: Start-end tags mismatch\n  hint: the file must be well-formed XML");
  EXPECT_EQ(
      error_of("<camera>\n\n  <eye x=1/>\n</camera>\n"),
      "FOLDER/a.xml:3:10: error: Error parsing element attribute\n  hint: the file must be well-formed XML");
}

TEST_F(ReadXml, NoCamera) {
  const std::string hint = "\n  hint: for example " + std::string(kCameraExample);
  EXPECT_EQ(error_of(" \n"), "FOLDER/a.xml: error: there is no <camera>" + hint);
  EXPECT_EQ(error_of("<a><camera/></a>"), "FOLDER/a.xml: error: there is no <camera>" + hint);
}

TEST_F(ReadXml, TwoCameras) {
  EXPECT_EQ(error_of(std::string(kAttributes) + "<camera/>"),
            "FOLDER/a.xml:13:1: error: a second <camera>; the first is in line 2\n  hint: keep one of them");
}

TEST_F(ReadXml, MissingAndDoubledProperties) {
  EXPECT_EQ(error_with(R"( fovy="20.1143")", ""),
            "FOLDER/a.xml:2:1: error: <camera> has no fovy\n  hint: for example fovy=\"40\"");
  EXPECT_EQ(error_with(R"(<up x="0.0" y="2.0" z="0.0"/>)", ""),
            "FOLDER/a.xml:2:1: error: <camera> has no up\n  hint: for example <up x=\"0\" y=\"1\" z=\"0\"/>");
  EXPECT_EQ(error_with("<up ", "<fovy value=\"3\"/> <up "),
            "FOLDER/a.xml:6:3: error: fovy is given twice\n  hint: keep one of them");
  EXPECT_EQ(error_with("<up ", "<eye value=\"3\"/> <up "),
            "FOLDER/a.xml:6:3: error: eye is given twice\n  hint: keep one of them");
  EXPECT_EQ(error_with(R"(mtlname="light2" )", ""),
            "FOLDER/a.xml:9:1: error: <light> has no mtlname\n  hint: for example mtlname=\"Light\"");
  EXPECT_EQ(error_with(R"(radiance="300,300,300")", ""),
            "FOLDER/a.xml:8:1: error: <light> has no radiance\n  hint: for example radiance=\"17, 12, 4\"");
}

TEST_F(ReadXml, ImageSize) {
  for (const std::string width : {"0", "-1", "65537", "1e99", "nan", "12.5"}) {
    EXPECT_EQ(error_with("1280", width), "FOLDER/a.xml:2:1: error: width is \"" + width +
                                             "\": a whole number from 1 to 65536 is needed\n"
                                             "  hint: for example width=\"1280\"");
  }
  EXPECT_EQ(
      error_with("\"720\"", "\"tall\""),
      "FOLDER/a.xml:2:1: error: height is \"tall\": a number is needed\n  hint: for example height=\"720\"");
}

TEST_F(ReadXml, FieldOfView) {
  for (const std::string fovy : {"0", "-20", "180", "inf"}) {
    EXPECT_EQ(error_with("20.1143", fovy), "FOLDER/a.xml:2:1: error: fovy is \"" + fovy +
                                               "\": an angle between 0 and 180 degrees is needed\n"
                                               "  hint: for example fovy=\"40\"");
  }
}

TEST_F(ReadXml, Directions) {
  EXPECT_EQ(error_with(R"(x="0.0" y="2.8" z="0.0")", R"(x="28.2792" y="5.2" z="1.23612e-06")"),
            "FOLDER/a.xml:5:3: error: lookat is the same point as eye: the camera looks nowhere\n"
            "  hint: set lookat to a point in front of the camera");
  const std::string no_up =
      "FOLDER/a.xml:6:3: error: up is zero or along the line from eye to lookat\n"
      "  hint: set up to the direction that is upwards in the image";
  EXPECT_EQ(error_with(R"(x="0.0" y="2.0" z="0.0")", R"(x="0" y="0" z="0")"), no_up);
  EXPECT_EQ(error_with(R"(x="0.0" y="2.0" z="0.0")", R"(x="-28.2792" y="-2.4" z="0")"), no_up);
}

TEST_F(ReadXml, VectorsAndOtherCameras) {
  EXPECT_EQ(error_with(R"(y="5.2" z="1.23612e-06")", ""),
            "FOLDER/a.xml:4:3: error: eye is \"28.2792 \": three numbers are needed\n"
            "  hint: for example <eye x=\"0\" y=\"1\" z=\"5\"/>");
  EXPECT_EQ(
      error_with("28.2792", "2e18"),
      "FOLDER/a.xml:4:3: error: eye is \"2e18 5.2 1.23612e-06 \": numbers from -1e+18 to 1e+18 are needed\n"
      "  hint: for example <eye x=\"0\" y=\"1\" z=\"5\"/>");
  EXPECT_EQ(error_with("perspective", "orthographic"),
            "FOLDER/a.xml:2:1: error: type is \"orthographic\": only perspective cameras are supported\n"
            "  hint: for example type=\"perspective\"");
}

TEST_F(ReadXml, Radiance) {
  const std::string where = "FOLDER/a.xml:8:1: error: radiance is ",
                    hint = "\n  hint: for example radiance=\"17, 12, 4\"";
  EXPECT_EQ(error_with("300,300,300", "300"), where + "\"300\": three numbers are needed" + hint);
  EXPECT_EQ(error_with("300,300,300", "1,2,x"), where + "\"1,2,x\": three numbers are needed" + hint);
  for (const std::string bad : {"1,-2,3", "1,nan,3", "1,inf,3", "1e39,1,1"}) {
    EXPECT_EQ(error_with("300,300,300", bad),
              fmt::format("{}\"{}\": numbers from 0 to 3.40282e+38 are needed{}", where, bad, hint));
  }
  EXPECT_EQ(error_with("light1", ""),
            "FOLDER/a.xml:8:1: error: mtlname is \"\": the name of a material is needed\n"
            "  hint: for example mtlname=\"Light\"");
}

TEST_F(ReadXml, LineEndsTabsAndMissingLastLineEnd) {
  std::string text(kAttributes);
  for (auto at = text.find('\n'); at != text.npos; at = text.find('\n', at + 2)) text.insert(at, 1, '\r');
  const XmlScene windows = read(text);
  expect_view(windows.view);
  EXPECT_EQ(windows.lights[2].where.line, 10);
  text = kChildren;
  text.pop_back();
  expect_view(read(text).view);
}

TEST_F(ReadXml, TruncatedFiles) {
  EXPECT_EQ(
      error_of(kAttributes.substr(0, 150)),
      "FOLDER/a.xml:4:11: error: Error parsing element attribute\n  hint: the file must be well-formed XML");
  EXPECT_EQ(error_of(kChildren.substr(0, 70)),
            "FOLDER/a.xml:2:42: error: Start-end tags mismatch\n  hint: the file must be well-formed XML");
}

TEST_F(ReadXml, DeeplyNestedElements) {
  std::string deep;
  for (int i = 0; i < 200000; ++i) deep += "<a>";
  for (int i = 0; i < 200000; ++i) deep += "</a>";
  EXPECT_EQ(read(deep + std::string(kChildren)).lights.size(), 1u);
  EXPECT_EQ(plain_warnings(), Warnings{"FOLDER/a.xml:1:1: warning: <a> is unknown and left out"});
}

TEST_F(ReadXml, ManyUnknownNamesAreCounted) {
  std::string many(kChildren);
  for (int i = 0; i < 1000; ++i) many += fmt::format("<a{}/>\n", i);
  read(many);
  ASSERT_EQ(warnings_.size(), 21u);
  EXPECT_EQ(plain_warnings().back(), "FOLDER/a.xml: warning: 980 more names are unknown and left out");
}

TEST_F(ReadXml, ManyLightsTakeNoLongTime) {
  std::string many(kChildren);
  for (int i = 0; i < 100000; ++i) many += fmt::format("<light mtlname=\"m{}\" radiance=\"1,1,1\"/>\n", i);
  const XmlScene scene = read(many);
  EXPECT_EQ(scene.lights.size(), 100001u);
  EXPECT_EQ(scene.lights.back().where.line, 9 + 100000);
}

TEST_F(ReadXml, Spheres) {
  const XmlScene scene =
      read(std::string(kChildren) + "<sphere mtlname=\"light1\" center=\"0.0, 1.0, 2\" radius=\"0.5\"/>");
  ASSERT_EQ(scene.spheres.size(), 1u);
  EXPECT_EQ(scene.spheres[0].material, "light1");
  EXPECT_EQ(scene.spheres[0].centre, Vec3(0, 1, 2));
  EXPECT_EQ(scene.spheres[0].radius, 0.5);
  EXPECT_TRUE(warnings_.empty());
  for (const std::string radius : {"0", "-1", "nan", "2e18"}) {
    EXPECT_EQ(
        error_of(fmt::format("{}<sphere mtlname=\"a\" center=\"0 0 0\" radius=\"{}\"/>", kChildren, radius)),
        fmt::format("FOLDER/a.xml:10:1: error: radius is \"{}\": a number above 0, at most 1e+18, is needed\n"
                    "  hint: for example radius=\"0.1\"",
                    radius));
  }
  EXPECT_EQ(error_of(std::string(kChildren) + "<sphere mtlname=\"a\" radius=\"1\"/>"),
            "FOLDER/a.xml:10:1: error: <sphere> has no center\n  hint: for example center=\"0, 1, 0\"");
}

constexpr std::string_view kPlain =
    "# camera\ntype perspective\nwidth 1280\nheight 720\nfovy 20.1143\neye 28.2792 5.2 1.23612e-06\n"
    "lookat 0.0 2.8 0.0\nup 0 2 0\n\n# light\nmtlname light1 300 300 300\nmtlname a b 50 20 10";

TEST_F(ReadXml, PlainTextDialect) {
  for (const std::string& text : {std::string(kPlain), "\xEF\xBB\xBF" + std::string(kPlain) + "\r\n"}) {
    const XmlScene scene = read(text);
    expect_view(scene.view);
    EXPECT_EQ(scene.dialect, "plain text");
    ASSERT_EQ(scene.lights.size(), 2u);
    EXPECT_EQ(scene.lights[0].material, "light1");
    EXPECT_EQ(scene.lights[0].radiance, (Rgb{300, 300, 300}));
    EXPECT_EQ(scene.lights[1].material, "a b") << "names may hold blanks";
    EXPECT_EQ(scene.lights[1].where.line, 12);
  }
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(ReadXml, PlainTextErrors) {
  const auto error = [&](std::string_view part, std::string_view replacement) {
    std::string text(kPlain);
    text.replace(text.find(part), part.size(), replacement);
    return error_of(text);
  };
  EXPECT_EQ(error("up 0 2 0", ""), "FOLDER/a.xml: error: the camera has no up\n  hint: for example up 0 1 0");
  EXPECT_EQ(error("1280", "wide"),
            "FOLDER/a.xml:3: error: width is \"wide\": a number is needed\n  hint: for example width 1280");
  EXPECT_EQ(error("up 0 2 0", "up 0 2"),
            "FOLDER/a.xml:8: error: up is \"0 2\": three numbers are needed\n  hint: for example up 0 1 0");
  EXPECT_EQ(error("up 0 2 0", "up 0 0 0"),
            "FOLDER/a.xml:8: error: up is zero or along the line from eye to lookat\n"
            "  hint: set up to the direction that is upwards in the image");
  EXPECT_EQ(error("up 0 2 0", "eye 0 2 0"),
            "FOLDER/a.xml:8: error: eye is given twice\n  hint: keep one of them");
  EXPECT_EQ(error("light1 300 300 300", "light1 300 -1 300"),
            "FOLDER/a.xml:11: error: radiance is \" 300 -1 300\": numbers from 0 to 3.40282e+38 are needed\n"
            "  hint: for example mtlname Light 17 12 4");
  EXPECT_EQ(error("light1 300 300 300", "light1 300 300"),
            "FOLDER/a.xml:11: error: mtlname is \"\": the name of a material is needed\n"
            "  hint: for example mtlname Light 17 12 4");
  EXPECT_EQ(error("perspective", "thinlens"),
            "FOLDER/a.xml:2: error: type is \"thinlens\": only perspective cameras are supported\n"
            "  hint: for example type perspective");
}

TEST_F(ReadXml, NeitherXmlNorPlainText) {
  EXPECT_EQ(error_of("{\"camera\": 1}\n"),
            "FOLDER/a.xml: error: this is neither XML nor the plain text of a scene\n"
            "  hint: XML starts with '<'; plain text has lines such as width 1280 and mtlname Light 17 12 4");
  EXPECT_EQ(error_of("# camera\nwidth 500\n"),
            "FOLDER/a.xml: error: the camera has no eye\n  hint: for example eye 0 1 5");
}

TEST_F(ReadXml, UnknownWordsOfPlainTextAreWarnedOf) {
  read(std::string(kPlain) + "\nspp 10\nfog 1\n");
  EXPECT_EQ(plain_warnings(), Warnings{"FOLDER/a.xml:13: warning: \"spp\" is unknown and left out"});
}

}  // namespace
}  // namespace lemma
