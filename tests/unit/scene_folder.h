#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "src/scene/scene_error.h"

namespace lemma::test {

/// A folder of small files for one test, deleted with it.
class SceneFolder {
 public:
  SceneFolder() : path_(std::filesystem::path(testing::TempDir()) / ("lemma_" + test_name())) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~SceneFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  SceneFolder(const SceneFolder&) = delete;
  SceneFolder& operator=(const SceneFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Writes a file; folders in its name are made.
  std::filesystem::path write(const std::string& name, std::string_view text) const {
    std::filesystem::path file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }

  /// A message with FOLDER for this folder's path.
  [[nodiscard]] std::string plain(std::string message) const {
    for (auto at = message.find(path_.string()); at != std::string::npos; at = message.find(path_.string())) {
      message.replace(at, path_.string().size(), "FOLDER");
    }
    return message;
  }

  /// The message of the SceneError that `action` throws, with FOLDER for this folder's path.
  template <class Action>
  [[nodiscard]] std::string error_of(Action action) const {
    try {
      action();
    } catch (const SceneError& error) {
      return plain(error.what());
    }
    return "no error";
  }

 private:
  /// Tests of one program may run at the same time, each in its own process.
  static std::string test_name() {
    const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
    return std::string(test.test_suite_name()) + "_" + test.name();
  }

  std::filesystem::path path_;
};

}  // namespace lemma::test
