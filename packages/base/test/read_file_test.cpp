#include <culm/base/error.hpp>
#include <culm/base/read_file.hpp>

#include <culm_kit/temporary_folder.hpp>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

namespace culm {
namespace {

class ReadFile : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  kit::TemporaryFolder folder_;
};

TEST_F(ReadFile, GivesWhatIsThere) {
  std::ofstream(path("file"), std::ios::binary) << std::string("a\0b\n", 4);
  EXPECT_EQ(read_file(path("file")), std::string("a\0b\n", 4));
  std::filesystem::create_symlink("file", path("link"));
  EXPECT_EQ(read_file(path("link")), std::string("a\0b\n", 4));
}

TEST_F(ReadFile, ObjectsToWhatIsNoFile) {
  EXPECT_EQ(find_text(path("none")).objection, "there is no such file");
  EXPECT_EQ(find_text(folder_.path().string()).objection, "is a folder");
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  EXPECT_EQ(find_text(path("pipe")).objection, "is a pipe, not a file");
  EXPECT_EQ(find_text("/dev/zero").objection, "is a device, not a file");
  std::filesystem::create_symlink("loop", path("loop"));
  EXPECT_EQ(find_text(path("loop")).objection, "cannot be read: Too many levels of symbolic links");
  EXPECT_EQ(find_text(std::string(5000, 'x')).objection, "cannot be read: File name too long");
  EXPECT_EQ(find_text(path("none/below")).objection, "there is no such file");
}

TEST_F(ReadFile, StopsAtALimit) {
  std::ofstream(path("file")) << std::string(1000, 'x');
  EXPECT_EQ(find_text(path("file"), 1000).objection, "");
  EXPECT_EQ(find_text(path("file"), 999).objection, "is larger than 999 bytes");
  EXPECT_EQ(find_text(path("file"), 1000).text.size(), 1000U);
}

TEST_F(ReadFile, ErrorsNameThePathAndWhoAsks) {
  const auto message = [](const auto& action) -> std::string {
    try {
      action();
    } catch (const FileError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message([&] { read_file(path("none")); }), path("none") + ": there is no such file");
  EXPECT_EQ(message([&] {
              read_file(path("none"), Where{"deck.xml", 3, "A / File Name"});
            }),
            path("none") + ": there is no such file; deck.xml:3: A / File Name asks for it");
}

}  // namespace
}  // namespace culm
