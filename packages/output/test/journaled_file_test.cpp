#include "../src/journaled_file.hpp"

#include "read_back.hpp"
#include "sample_model.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <csignal>
#include <fstream>
#include <string>

namespace culm::output {
namespace {

std::span<const std::byte> bytes(const std::string& text) { return std::as_bytes(std::span(text)); }

TEST(JournaledFile, ChangesAppearWithTheCommitOnly) {
  const TemporaryFolder folder;
  JournaledFile file(folder / "f");
  file.start_journal(folder / "f");
  file.write(0, bytes("old text"));
  file.commit();
  file.write(4, bytes("data, more"));
  EXPECT_EQ(read_text_file(folder / "f").substr(0, 8), "old text");
  std::string seen(14, ' ');
  file.read(0, std::as_writable_bytes(std::span(seen)));
  EXPECT_EQ(seen, "old data, more");
  file.commit();
  EXPECT_EQ(read_text_file(folder / "f"), "old data, more");
  file.resize(8);
  file.commit();
  EXPECT_EQ(read_text_file(folder / "f"), "old data");
}

TEST(JournaledFile, JournalIsGoneAfterwards) {
  const TemporaryFolder folder;
  {
    JournaledFile file(folder / "f");
    file.start_journal(folder / "f");
    EXPECT_TRUE(std::filesystem::exists(JournaledFile::journal_path(folder / "f")));
    EXPECT_FALSE(JournaledFile::recover(folder / "f"));  // in use
    EXPECT_TRUE(std::filesystem::exists(JournaledFile::journal_path(folder / "f")));
  }
  EXPECT_FALSE(std::filesystem::exists(JournaledFile::journal_path(folder / "f")));
}

TEST(JournaledFile, IncompleteJournalIsNotApplied) {
  const TemporaryFolder folder;
  std::ofstream(folder / "f") << "content";
  std::ofstream(JournaledFile::journal_path(folder / "f")) << "CULMJNL1 torn off here, no more";
  EXPECT_FALSE(JournaledFile::recover(folder / "f"));
  EXPECT_EQ(read_text_file(folder / "f"), "content");
}

constexpr std::size_t record_count = 8;
constexpr std::size_t record_distance = 5000;

// Writes the same number into eight places far apart, commits, counts on, until it is killed.
[[noreturn]] void count_forever(const std::filesystem::path& path) {
  JournaledFile file(path);
  file.write(0, std::vector<std::byte>(record_count * record_distance));
  file.commit();
  file.start_journal(path);
  for (std::uint64_t number = 1;; ++number) {
    for (std::size_t r = 0; r < record_count; ++r) {
      file.write(r * record_distance, std::as_bytes(std::span(&number, 1)));
    }
    file.commit();
  }
}

TEST(JournaledFile, KilledCommitsAreWholeOrNothing) {
  for (int round = 0; round < 20; ++round) {
    const TemporaryFolder folder;
    const pid_t child = ::fork();
    if (child == 0) count_forever(folder / "f");
    // before, nothing is promised; on a busy machine that may take long
    while (!std::filesystem::exists(JournaledFile::journal_path(folder / "f"))) ::usleep(100);
    ::usleep(997 * static_cast<useconds_t>(round));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    JournaledFile::recover(folder / "f");
    const std::string text = read_text_file(folder / "f");
    for (std::size_t r = 1; r < record_count && !text.empty(); ++r) {
      EXPECT_EQ(text.substr(0, 8), text.substr(r * record_distance, 8)) << "round " << round;
    }
    EXPECT_FALSE(std::filesystem::exists(JournaledFile::journal_path(folder / "f")));
  }
}

}  // namespace
}  // namespace culm::output
