/// Small files in the formats of OpenFAST, with numbers of our own.
#pragma once

#include <culm_kit/temporary_folder.hpp>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

namespace culm::openfast {

/// As a deck has it.
inline std::string parameter(const std::string& name, const std::string& value) {
  return "<Parameter name=\"" + name + "\" value=\"" + value + "\"/>";
}

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
  // Thousands of small files: in memory, where the system has such a place.
  static std::filesystem::path parent() {
    const std::filesystem::path memory = "/dev/shm";
    std::error_code ignored;  // what is not there is no folder
    return std::filesystem::is_directory(memory, ignored) ? memory
                                                          : std::filesystem::temp_directory_path();
  }

  kit::TemporaryFolder temporary_{parent()};
  // Names of real folders have blanks.
  std::filesystem::path folder_ = temporary_ / "sample files";
};

}  // namespace culm::openfast
