#include <culm/base/error.hpp>
#include <culm/output/folder_lock.hpp>

#include "sample_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <memory>

namespace culm::output {
namespace {

std::string refusal(const std::filesystem::path& folder) {
  try {
    const FolderLock lock(folder);
  } catch (const FileError& error) {
    return error.what();
  }
  return {};
}

TEST(FolderLock, HasOneOwnerAtATime) {
  const TemporaryFolder outer;
  const std::filesystem::path folder = outer / "results/run";
  auto first = std::make_unique<FolderLock>(folder);
  EXPECT_EQ(first->weakness(), "");
  char host[100] = {};
  ASSERT_EQ(::gethostname(host, sizeof host - 1), 0);
  EXPECT_EQ(refusal(folder), folder.string() + ": another run writes here: process " +
                                 std::to_string(::getpid()) + " on " + host +
                                 "; wait for its end, or take another folder");
  EXPECT_TRUE(std::filesystem::exists(folder / "run.lock"));
  first.reset();
  EXPECT_FALSE(std::filesystem::exists(folder / "run.lock"));
  EXPECT_EQ(refusal(folder), "");
}

TEST(FolderLock, OfAProcessThatWasKilledIsFree) {
  const TemporaryFolder folder;
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const FolderLock lock(folder.path());
    if (::write(ready[1], "x", 1) < 0) ::_exit(1);
    ::pause();
  }
  char ignored = 0;
  ASSERT_EQ(::read(ready[0], &ignored, 1), 1);
  EXPECT_THAT(refusal(folder.path()), ::testing::HasSubstr("process " + std::to_string(child)));
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "run.lock"));
  EXPECT_EQ(refusal(folder.path()), "");
}

TEST(FolderLock, NeedsAFolder) {
  const TemporaryFolder folder;
  std::ofstream(folder / "file") << "x";
  EXPECT_EQ(refusal(folder / "file/below"), (folder / "file/below").string() + ": Not a directory");
}

}  // namespace
}  // namespace culm::output
