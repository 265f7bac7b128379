#include "src/render/image_file.h"

#include <gtest/gtest.h>

#include <fstream>

namespace lemma {
namespace {

namespace fs = std::filesystem;

class ImageFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
  static Image two_pixels() { return {2, 1, {{0.25f, 1e6f, 1e-6f}, {0, 0, 380}}}; }

  fs::path folder_;
};

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const FileError& error) {
    return error.what();
  }
  return "no error";
}

TEST_F(ImageFile, WritesEveryFormatAndLeavesNothingElse) {
  std::size_t count = 0;
  for (const char* name : {"a.exr", "a.png", "a.jpg", "a.tif", "a.hdr", "A.EXR"}) {
    check_writable(folder_ / name);
    write_image(folder_ / name, two_pixels(), nullptr, {}, {{"lemma:seed", "7"}});
    EXPECT_GT(fs::file_size(folder_ / name), 0u);
    EXPECT_EQ(files(), ++count);
  }
}

TEST_F(ImageFile, UnknownEndingsAreErrors) {
  EXPECT_EQ(message_of([&] { check_writable("picture.xyz"); }),
            "picture.xyz: error: no image format for the ending \".xyz\"\n"
            "  hint: use .exr for linear radiance, or .png, .jpg, .tif ... for a picture");
  EXPECT_EQ(message_of([&] { check_writable("picture"); }),
            "picture: error: no image format for the ending \"\"\n"
            "  hint: use .exr for linear radiance, or .png, .jpg, .tif ... for a picture");
}

TEST_F(ImageFile, MissingFoldersAreErrors) {
  const std::string name = (folder_ / "nowhere" / "a.png").string();
  EXPECT_EQ(message_of([&] { check_writable(name); }),
            name + ": error: cannot be written: the folder " + (folder_ / "nowhere").string() +
                " does not exist or takes no files\n  hint: make the folder, or choose another name");
}

TEST_F(ImageFile, AFailedWriteKeepsTheOldFile) {
  const fs::path name = folder_ / "a.png";
  std::ofstream(name) << "old";
  Image broken = two_pixels();
  broken.width = 0;  // no format takes an image without pixels
  EXPECT_NE(message_of([&] { write_image(name, broken, nullptr, {}, {}); }), "no error");
  std::string kept;
  std::ifstream(name) >> kept;
  EXPECT_EQ(kept, "old");
  EXPECT_EQ(files(), 1u);
}

}  // namespace
}  // namespace lemma
