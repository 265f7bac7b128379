#include "src/scene/scene_files.h"

#include <gtest/gtest.h>

#include "src/scene/read_xml.h"
#include "tests/unit/scene_folder.h"

namespace lemma {
namespace {

namespace fs = std::filesystem;

class SceneFilesTest : public testing::Test {
 protected:
  void write(const std::vector<std::string>& names) const {
    for (const std::string& name : names) folder_.write(name, "x");
  }

  void expect_found(const std::string& scene, const std::string& xml, const std::string& obj) const {
    const SceneFiles files = find_scene_files(folder_.path() / scene);
    EXPECT_EQ(files.xml, folder_.path() / xml) << scene;
    EXPECT_EQ(files.obj, folder_.path() / obj) << scene;
  }

  std::string error_of(const std::string& scene) const {
    return folder_.error_of([&] { (void)find_scene_files(folder_.path() / scene); });
  }

  /// The MTL files for mtllib lines of a.obj, relative to the folder.
  std::vector<fs::path> mtl_files(const std::vector<std::string>& lines) {
    std::vector<ObjName> libraries;
    libraries.reserve(lines.size());
    for (const std::string& line : lines) libraries.push_back({line, {folder_.path() / "a.obj", 3}});
    warnings_.clear();
    std::vector<fs::path> files = find_mtl_files(folder_.path() / "a.obj", libraries, warnings_);
    for (fs::path& file : files) file = file.lexically_relative(folder_.path());
    for (std::string& warning : warnings_) warning = folder_.plain(warning);
    return files;
  }

  test::SceneFolder folder_;
  Warnings warnings_;
};

using Paths = std::vector<fs::path>;

TEST_F(SceneFilesTest, XmlObjOrFolder) {
  write({"a.xml", "a.obj", "a.mtl", "a.jpg", ".hidden.xml"});
  expect_found("a.xml", "a.xml", "a.obj");
  expect_found("a.obj", "a.xml", "a.obj");
  expect_found("", "a.xml", "a.obj");
}

TEST_F(SceneFilesTest, OtherStemsIfThereIsNoChoice) {
  write({"staircase.XML", "stairscase.OBJ"});
  expect_found("staircase.XML", "staircase.XML", "stairscase.OBJ");
  expect_found("stairscase.OBJ", "staircase.XML", "stairscase.OBJ");
  expect_found("", "staircase.XML", "stairscase.OBJ");
}

TEST_F(SceneFilesTest, SameStemFirst) {
  write({"a.xml", "a.obj", "b.obj", "b.xml"});
  expect_found("a.xml", "a.xml", "a.obj");
  expect_found("b.obj", "b.xml", "b.obj");
}

TEST_F(SceneFilesTest, RelativeToTheCurrentFolder) {
  write({"a.xml", "b.obj"});
  const fs::path before = fs::current_path();
  fs::current_path(folder_.path());
  const SceneFiles files = find_scene_files("a.xml");
  fs::current_path(before);
  EXPECT_EQ(files.xml, "a.xml");
  EXPECT_EQ(files.obj, "b.obj");
}

TEST_F(SceneFilesTest, NothingToFind) {
  EXPECT_EQ(error_of("none.xml"),
            "FOLDER/none.xml: error: no such file or folder\n"
            "  hint: name the XML, the OBJ, or the folder that holds both");
  write({"a.txt", "b.xml", "c/a.obj"});
  EXPECT_EQ(error_of("a.txt"),
            "FOLDER/a.txt: error: this is neither XML nor OBJ\n"
            "  hint: name the XML, the OBJ, or the folder that holds both");
  EXPECT_EQ(error_of("b.xml"),
            "FOLDER/b.xml: error: there is no OBJ file with the geometry\n"
            "  hint: put it beside the XML");
  EXPECT_EQ(error_of("c/a.obj"),
            "FOLDER/c/a.obj: error: there is no XML file with camera and lights\n"
            "  hint: write one beside the OBJ, with the same stem: " +
                std::string(kCameraExample) + " " + std::string(kLightExample));
}

TEST_F(SceneFilesTest, TooMuchToChooseFrom) {
  write({"a.xml", "b.xml", "c.obj", "d.obj"});
  EXPECT_EQ(error_of("a.xml"),
            "FOLDER/a.xml: error: which obj file? There are c.obj, d.obj\n"
            "  hint: name the XML, and give the OBJ the same stem");
  EXPECT_EQ(error_of("c.obj"),
            "FOLDER/c.obj: error: which xml file? There are a.xml, b.xml\n"
            "  hint: name the XML, and give the OBJ the same stem");
}

TEST_F(SceneFilesTest, MtlAsWritten) {
  write({"a.mtl", "b c.mtl", "d/e.mtl", "f.mtl"});
  EXPECT_EQ(mtl_files({"a.mtl"}), Paths{"a.mtl"});
  EXPECT_EQ(mtl_files({"b c.mtl"}), Paths{"b c.mtl"});
  EXPECT_EQ(mtl_files({"d/e.mtl"}), Paths{"d/e.mtl"});
  EXPECT_EQ(mtl_files({"a.mtl f.mtl", "a.mtl"}), (Paths{"a.mtl", "f.mtl"}));
  EXPECT_EQ(mtl_files({"a.mtl b\\ c.mtl"}), (Paths{"a.mtl", "b c.mtl"}));
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(SceneFilesTest, MtlByGuess) {
  write({"A.mtl", "d/e.mtl", "f.mtl"});
  EXPECT_EQ(mtl_files({"d\\e.mtl"}), Paths{"d/e.mtl"});
  EXPECT_EQ(warnings_, Warnings{"FOLDER/a.obj:3: warning: there is no \"d\\e.mtl\"; e.mtl is used"});
  EXPECT_EQ(mtl_files({"C:\\scenes\\f.mtl"}), Paths{"f.mtl"});
  EXPECT_EQ(mtl_files({"scenes/old/a.MTL"}), Paths{"A.mtl"});
  EXPECT_EQ(warnings_, Warnings{"FOLDER/a.obj:3: warning: there is no \"scenes/old/a.MTL\"; A.mtl is used"});
}

TEST_F(SceneFilesTest, TheOnlyMtlOfTheFolder) {
  write({"stairscase.mtl"});
  EXPECT_EQ(mtl_files({"x.mtl"}), Paths{"stairscase.mtl"});
  EXPECT_EQ(warnings_, Warnings{"FOLDER/a.obj:3: warning: there is no \"x.mtl\"; stairscase.mtl is used"});
  EXPECT_EQ(mtl_files({}), Paths{"stairscase.mtl"});
  EXPECT_EQ(warnings_, Warnings{"FOLDER/a.obj: warning: there is no mtllib line; stairscase.mtl is used"});
}

TEST_F(SceneFilesTest, NoMtl) {
  EXPECT_EQ(mtl_files({"x.mtl"}), Paths{});
  EXPECT_EQ(warnings_, Warnings{"FOLDER/a.obj:3: warning: there is no \"x.mtl\""});
  write({"a.mtl"});
  EXPECT_EQ(mtl_files({"x.mtl a.mtl"}), Paths{"a.mtl"});
  EXPECT_EQ(warnings_, Warnings{"FOLDER/a.obj:3: warning: there is no \"x.mtl\""});
  write({"b.mtl"});
  EXPECT_EQ(mtl_files({"x.mtl"}), Paths{}) << "two to choose from";
  EXPECT_EQ(mtl_files({"x.mtl a.mtl"}), Paths{"a.mtl"});
  EXPECT_EQ(warnings_, Warnings{"FOLDER/a.obj:3: warning: there is no \"x.mtl\""});
}

}  // namespace
}  // namespace lemma
