#include <culm/base/error.hpp>
#include <culm/output/growing_file.hpp>

#include "read_back.hpp"
#include "sample_model.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <utility>

namespace culm::output {
namespace {

TEST(GrowingFile, IsCompleteAfterEveryEntryAndAtTheEnd) {
  const TemporaryFolder folder;
  std::string all;
  {
    GrowingFile file(folder / "f", "<", ">");
    EXPECT_EQ(read_text_file(folder / "f"), "<>");
    for (int i = 0; i < 100; ++i) {
      file.add("x");
      all += "x";
      const std::string text = read_text_file(folder / "f");
      EXPECT_EQ(text, "<" + all.substr(0, text.size() - 2) + ">");
    }
  }
  EXPECT_EQ(read_text_file(folder / "f"), "<" + all + ">");
}

TEST(GrowingFile, OnlyTheLastOwnerWrites) {
  const TemporaryFolder folder;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  {
    GrowingFile file(folder / "f", "<", ">");
    for (int i = 0; i < 50; ++i) file.add("x");
    file.add("y");
    const GrowingFile owner(std::move(file));
  }
  std::filesystem::current_path(before);
  EXPECT_EQ(read_text_file(folder / "f"), "<" + std::string(50, 'x') + "y>");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(GrowingFile, IsNotWrittenOverAFileOfSomebodyElse) {
  const TemporaryFolder folder;
  {
    GrowingFile file(folder / "f", "<", ">");
    std::filesystem::remove(folder / "f");
    EXPECT_THROW(file.write(), FileError);
    EXPECT_FALSE(std::filesystem::exists(folder / "f"));
    std::ofstream(folder / "f") << "mine";
    EXPECT_THROW(file.add("x"), FileError);
  }
  EXPECT_EQ(read_text_file(folder / "f"), "mine");
}

}  // namespace
}  // namespace culm::output
