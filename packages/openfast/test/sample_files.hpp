/// Small files in the formats of OpenFAST, with numbers of our own.
#pragma once

#include <culm_kit/temporary_folder.hpp>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace culm::openfast {

/// A folder of its own for each test.
class SampleFiles : public testing::Test {
 protected:
  SampleFiles() { std::filesystem::create_directories(folder_); }

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
  kit::TemporaryFolder temporary_;
  // Names of real folders have blanks.
  std::filesystem::path folder_ = temporary_ / "sample files";
};

}  // namespace culm::openfast
