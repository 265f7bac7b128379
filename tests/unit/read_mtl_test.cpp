#include "src/scene/read_mtl.h"

#include <gtest/gtest.h>

#include "tests/unit/scene_folder.h"

namespace lemma {
namespace {

class ReadMtl : public testing::Test {
 protected:
  std::vector<MtlMaterial> read(std::string_view text) {
    return read_mtl(folder_.write("a.mtl", text), warnings_);
  }

  std::string error_of(std::string_view text) {
    return folder_.error_of([&] { (void)read(text); });
  }

  test::SceneFolder folder_;
  Warnings warnings_;
};

TEST_F(ReadMtl, TakesColoursExponentIndexAndTexture) {
  const auto materials = read(
      "Kd 9 9 9\n newmtl  odd name \nKa .1 .2 .3\n\tKd 0.5 0.25 0.125 # red\r\nKs 0.1 0.2 0.3\nKe 17 12 "
      "4\nNs 5000\n"
      "Ni 1.5\nillum 2\nTr 1 1 1\nd 0.5\nmap_Kd -s 1 1 1 wood 5.jpg\nnewmtl b\n");
  ASSERT_EQ(materials.size(), 2u);
  const MtlMaterial& m = materials[0];
  EXPECT_EQ(m.name, "odd name");
  EXPECT_EQ(m.where.line, 2);
  EXPECT_EQ(m.ka, (Rgb{.1f, .2f, .3f}));
  EXPECT_EQ(m.kd, (Rgb{0.5f, 0.25f, 0.125f}));
  EXPECT_EQ(m.ks, (Rgb{0.1f, 0.2f, 0.3f}));
  EXPECT_EQ(m.ke, (Rgb{17, 12, 4}));
  EXPECT_EQ(m.ns, 5000.0f);
  EXPECT_EQ(m.ni, 1.5f);
  EXPECT_EQ(m.map_kd, "wood 5.jpg");
  EXPECT_EQ(m.map_kd_where.line, 12);
  EXPECT_EQ(m.tr, (std::vector<float>{1, 1, 1}));
  EXPECT_EQ(m.d, std::vector<float>{0.5f});
  EXPECT_EQ(m.illum, std::vector<float>{2});
  EXPECT_EQ(materials[1].kd, Rgb{});
  EXPECT_EQ(materials[1].ns, 1.0f);
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(ReadMtl, TransparencyThatMakesNoSenseIsLeftOutWithAWarning) {
  const auto materials = read("newmtl a\nTr 0.9\nd -halo 0.25\nnewmtl b\nTr 1 2\nd 1.5\nillum glass\n");
  EXPECT_EQ(materials[0].tr, std::vector<float>{0.9f});
  EXPECT_EQ(materials[0].d, std::vector<float>{0.25f});
  EXPECT_TRUE(materials[1].tr.empty() && materials[1].d.empty() && materials[1].illum.empty());
  for (std::string& warning : warnings_) warning = folder_.plain(warning);
  EXPECT_EQ(
      warnings_,
      (Warnings{
          "FOLDER/a.mtl:5: warning: \"Tr 1 2\" is left out: one or three numbers from 0 to 1 are needed",
          "FOLDER/a.mtl:6: warning: \"d 1.5\" is left out: one or three numbers from 0 to 1 are needed",
          "FOLDER/a.mtl:7: warning: \"illum glass\" is left out: one or three numbers from 0 to 10 are "
          "needed"}));
}

TEST_F(ReadMtl, IndexOfRefraction) {
  EXPECT_EQ(read("newmtl a\nNi 0\n")[0].ni, 1.0f) << "some exporters write 0 for what is no glass";
  EXPECT_EQ(error_of("newmtl a\nNi -1.5\n"),
            "FOLDER/a.mtl:2: error: \"Ni -1.5\": an index of refraction is not negative\n  hint: for example "
            "Ni 1.5");
}

TEST_F(ReadMtl, OneNumberIsAGrey) {
  EXPECT_EQ(read("newmtl a\nKd 0.5\n")[0].kd, (Rgb{0.5f, 0.5f, 0.5f}));
}

TEST_F(ReadMtl, ExponentIsClampedWithAWarning) {
  const auto materials = read("newmtl a\nNs 2e7\nnewmtl b\nNs -3\n");
  EXPECT_EQ(materials[0].ns, 1e6f);
  EXPECT_EQ(materials[1].ns, 0.0f);
  ASSERT_EQ(warnings_.size(), 2u);
  EXPECT_EQ(folder_.plain(warnings_[0]),
            "FOLDER/a.mtl:2: warning: Ns 20000000 is outside of [0, 1e6]: 1000000 is used");
}

TEST_F(ReadMtl, OfTwoDefinitionsTheFirstIsUsed) {
  read("newmtl a\nKd 1 1 1\nnewmtl a\n");
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_EQ(folder_.plain(warnings_[0]),
            "FOLDER/a.mtl:3: warning: material \"a\" is defined in line 1 already; that one is used");
}

TEST_F(ReadMtl, BadNumbers) {
  const auto error = [&](const std::string& line) { return error_of("newmtl a\n\n" + line + "\n"); };
  const std::string colour = "\n  hint: for example Kd 0.5 0.5 0.5";
  EXPECT_EQ(error("Kd 1 2"), "FOLDER/a.mtl:3: error: \"Kd 1 2\": three numbers are needed" + colour);
  EXPECT_EQ(error("Kd"), "FOLDER/a.mtl:3: error: \"Kd \": three numbers are needed" + colour);
  EXPECT_EQ(error("Kd red"), "FOLDER/a.mtl:3: error: \"Kd red\": three numbers are needed" + colour);
  EXPECT_EQ(error("Kd 0 -1 0"), "FOLDER/a.mtl:3: error: \"Kd 0 -1 0\": no colour is negative" + colour);
  EXPECT_EQ(error("Kd 0 nan 0"), "FOLDER/a.mtl:3: error: \"Kd 0 nan 0\": a number is not finite" + colour);
  EXPECT_EQ(
      error("Ks 1e39 0 0"),
      "FOLDER/a.mtl:3: error: \"Ks 1e39 0 0\": a number is not finite\n  hint: for example Ks 0.5 0.5 0.5");
  EXPECT_EQ(error("Ns nan"),
            "FOLDER/a.mtl:3: error: \"Ns nan\": a number is not finite\n  hint: for example Ns 1.5");
  EXPECT_EQ(error("Ns x"), "FOLDER/a.mtl:3: error: \"Ns x\": a number is needed\n  hint: for example Ns 1.5");
}

}  // namespace
}  // namespace lemma
