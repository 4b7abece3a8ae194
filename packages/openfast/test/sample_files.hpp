/// Small files in the formats of OpenFAST, with numbers of our own.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace culm::openfast {

/// A folder of its own for each test.
class SampleFiles : public testing::Test {
 protected:
  SampleFiles() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) /
              (std::string("openfast ") + info->test_suite_name() + " " + info->name());
    std::filesystem::create_directories(folder_);
  }
  ~SampleFiles() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }

  std::filesystem::path path_of(const std::string& name) const { return folder_ / name; }

  /// The text with the one place where `old` stands replaced.
  static std::string change(std::string text, const std::string& old, const std::string& by) {
    const std::size_t at = text.find(old);
    EXPECT_NE(at, std::string::npos) << old;
    EXPECT_EQ(text.find(old, at + 1), std::string::npos) << old << " stands there twice";
    return text.replace(at, old.size(), by);
  }

 private:
  std::filesystem::path folder_;
};

}  // namespace culm::openfast
