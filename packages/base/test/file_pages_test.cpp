#include <culm/base/file_pages.hpp>

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>

namespace culm {
namespace {

// Far more than the test itself touches of its program and libraries.
constexpr std::size_t size = std::size_t{16} << 20;

// A file that is mapped.
class FilePages : public testing::Test {
 protected:
  FilePages() {
    file_ = ::mkstemp(name_.data());
    std::ofstream(name_, std::ios::binary) << std::string(size, 'a');
    bytes_ =
        static_cast<char*>(::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE, file_, 0));
  }
  ~FilePages() override {
    ::munmap(bytes_, size);
    ::close(file_);
    ::unlink(name_.c_str());
  }

  void protect() { ASSERT_EQ(::mprotect(bytes_, size, PROT_READ), 0); }
  std::size_t count(char letter) const {
    return static_cast<std::size_t>(std::count(bytes_, bytes_ + size, letter));
  }

  char* bytes_ = nullptr;

 private:
  std::string name_ = testing::TempDir() + "file_pages_XXXXXX";
  int file_ = -1;
};

TEST_F(FilePages, ComeAgainWhenTheyAreRead) {
  protect();
  ASSERT_EQ(count('a'), size);
  EXPECT_GE(give_back_file_pages(), size);
  EXPECT_LT(give_back_file_pages(), size) << "held although nobody has read it since";
  EXPECT_EQ(count('a'), size);
}

TEST_F(FilePages, StayWhereMemoryDiffersFromTheFile) {
  bytes_[size / 2] = 'b';
  protect();
  ASSERT_EQ(count('a'), size - 1);
  give_back_file_pages();
  EXPECT_EQ(count('b'), 1u);
}

}  // namespace
}  // namespace culm
