#include <culm/base/error.hpp>
#include <culm/parallel/shared_file.hpp>

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace culm::parallel {
namespace {

// One name on all ranks, of a file that is there and empty.
std::filesystem::path make_file(const Comm& comm) {
  std::string name;
  if (comm.is_root()) {
    name = (std::filesystem::temp_directory_path() /
            ("culm_shared_file_" + std::to_string(::getpid())))
               .string();
    std::ofstream(name).close();
  }
  return comm.broadcast(name);
}

std::vector<double> read_numbers(const std::filesystem::path& path, std::size_t count) {
  std::vector<double> numbers(count, -1.0);
  std::ifstream(path, std::ios::binary)
      .read(reinterpret_cast<char*>(numbers.data()),
            static_cast<std::streamsize>(count * sizeof(double)));
  return numbers;
}

TEST(SharedFile, RowsOfAllRanksComeToTheirPlaces) {
  const Comm comm;
  const std::filesystem::path path = make_file(comm);
  constexpr std::size_t rows = 13, width = 3, before = 5;
  RowRanges own;
  std::vector<double> numbers;
  for (std::size_t row = 0; row < rows; ++row) {
    // in pairs, and none for the last rank of three
    if (static_cast<int>(row / 2 % 2) % comm.size() != comm.rank()) continue;
    append_row(own, row);
    for (std::size_t i = 0; i < width; ++i) numbers.push_back(static_cast<double>(row * width + i));
  }
  {
    SharedFile file(comm, path);
    file.write(before * sizeof(double), width, own, numbers);
    file.sync();
  }
  if (comm.is_root()) {
    EXPECT_EQ(std::filesystem::file_size(path), (before + rows * width) * sizeof(double));
    const std::vector<double> all = read_numbers(path, before + rows * width);
    for (std::size_t i = 0; i < rows * width; ++i) {
      EXPECT_EQ(all[before + i], static_cast<double>(i));
    }
    std::filesystem::remove(path);
  }
}

TEST(SharedFile, AMissingFileIsAFileErrorOnAllRanks) {
  const Comm comm;
  try {
    const SharedFile file(comm, "missing/file");
    FAIL() << "no error";
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("missing/file: cannot open file: "),
              std::string::npos);
  }
}

}  // namespace
}  // namespace culm::parallel
