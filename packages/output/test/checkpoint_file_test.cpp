#include <culm/base/error.hpp>
#include <culm/output/checkpoint_file.hpp>
#include <culm/output/checksum.hpp>

#include "read_back.hpp"
#include "sample_model.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <span>
#include <string>

namespace culm::output {
namespace {

std::string message(const std::filesystem::path& path) {
  try {
    read_checkpoint(path);
  } catch (const FileError& error) {
    return error.what();
  }
  return "no error";
}

void write(const std::filesystem::path& path, const std::string& content) {
  std::ofstream(path, std::ios::binary) << content;
}

TEST(CheckpointFile, TheLastTwoAreKept) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "run.checkpoint";
  const std::string first("one\0\n", 5);
  write_checkpoint(path, first);
  EXPECT_EQ(read_checkpoint(path), first);
  EXPECT_FALSE(std::filesystem::exists(previous_checkpoint(path)));
  write_checkpoint(path, "two");
  write_checkpoint(path, "");
  EXPECT_EQ(read_checkpoint(path), "");
  EXPECT_EQ(read_checkpoint(previous_checkpoint(path)), "two");
  const auto files = std::filesystem::directory_iterator(folder.path());
  EXPECT_EQ(std::distance(begin(files), end(files)), 2);
}

TEST(CheckpointFile, PiecesAreReadAsOneContent) {
  const TemporaryFolder folder;
  std::string whole;
  for (int i = 0; i < 700'000; ++i) whole += static_cast<char>(1LL * i * i % 251);
  write_checkpoint(folder / "whole", whole + whole + whole + "end");
  CheckpointFile file(folder / "pieces");
  for (int i = 0; i < 3; ++i) file.take(whole);
  for (const char* letter : {"e", "", "n", "d"}) file.take(letter);
  file.finish();
  EXPECT_EQ(read_text_file(folder / "whole"), read_text_file(folder / "pieces"));
  EXPECT_EQ(read_checkpoint(folder / "pieces"), whole + whole + whole + "end");
}

TEST(CheckpointFile, NumbersThatOthersWriteFollowTheContent) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "c";
  const std::array<double, 5> numbers{1.0, -0.0, 3.5, 1e300, 4.0};
  const auto write_them = [&](std::uint64_t sum) {
    CheckpointFile file(path);
    file.take("8 bytes.");
    const std::uint64_t place = file.make_room(numbers.size());
    std::fstream other(file.name(), std::ios::binary | std::ios::in | std::ios::out);
    other.seekp(static_cast<std::streamoff>(place));
    other.write(reinterpret_cast<const char*>(numbers.data()), sizeof numbers);
    other.close();
    file.finish(sum);
  };
  // in two pieces, of which the later one comes first
  const std::span all(numbers);
  write_them(sum_of_numbers(all.subspan(2), 2) + sum_of_numbers(all.first(2)));
  const std::string expected =
      "8 bytes." + std::string(reinterpret_cast<const char*>(numbers.data()), sizeof numbers);
  EXPECT_EQ(read_checkpoint(path), expected);
  const std::string sound = read_text_file(path);
  {
    CheckpointFile file(path);
    file.take("8 bytes.");
    file.make_room(numbers.size());
    file.fill_room(all.first(2));
    file.fill_room(all.subspan(2));
    file.finish(sum_of_numbers(all));
  }
  EXPECT_EQ(read_text_file(path), sound);
  for (std::size_t i = 0; i < sound.size(); ++i) {
    std::string damaged = sound;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    write(path, damaged);
    EXPECT_NE(message(path), "no error") << "byte " << i;
  }
  write_them(sum_of_numbers(all) + 1);
  EXPECT_EQ(message(path), path.string() + ": is damaged: its checksum is wrong");
}

TEST(CheckpointFile, WhatFailsHalfwayLeavesTheLastOne) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "c";
  write_checkpoint(path, "sound");
  const auto fail = [&] {
    CheckpointFile file(path);
    file.take("half");
    throw std::bad_alloc();
  };
  EXPECT_THROW(fail(), std::bad_alloc);
  EXPECT_EQ(read_checkpoint(path), "sound");
  const auto files = std::filesystem::directory_iterator(folder.path());
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
}

TEST(CheckpointFile, EveryChangedByteAndEveryLengthIsNoticed) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "c";
  write_checkpoint(path, "numbers of a run, and more of them");
  const std::string sound = read_text_file(path);
  for (std::size_t i = 0; i < sound.size(); ++i) {
    std::string damaged = sound;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    write(path, damaged);
    EXPECT_NE(message(path), "no error") << "byte " << i;
    write(path, sound.substr(0, i));
    EXPECT_NE(message(path), "no error") << "length " << i;
  }
  write(path, sound + "x");
  EXPECT_NE(message(path), "no error");
  write(path, sound.substr(0, sound.size() - 4));
  EXPECT_EQ(message(path), path.string() + ": was cut off: it holds 30 of 34 bytes");
  EXPECT_EQ(message(folder / "none"), (folder / "none").string() + ": there is no such file");
  EXPECT_EQ(message(folder.path()), folder.path().string() + ": is a folder");
}

TEST(CheckpointFile, UnwritablePlacesAreFileErrors) {
  const TemporaryFolder folder;
  try {
    write_checkpoint(folder / "missing/c", "x");
    FAIL() << "no error";
  } catch (const FileError& error) {
    EXPECT_EQ(std::string(error.what()),
              (folder / "missing/c.part").string() + ": cannot write: No such file or directory");
  }
}

TEST(CheckpointFile, OneIsWholeWheneverTheWriterIsKilled) {
  for (int round = 0; round < 10; ++round) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder / "c";
    const pid_t child = ::fork();
    if (child == 0) {
      for (char c = 0;; ++c) write_checkpoint(path, std::string(200'000, c));
    }
    while (!std::filesystem::exists(previous_checkpoint(path))) ::usleep(100);
    ::usleep(static_cast<useconds_t>(1000 + 700 * round));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    EXPECT_EQ(message(previous_checkpoint(path)), "no error");
    // between its two renames the newest has no name; then it is the one before
    if (std::filesystem::exists(path)) {
      EXPECT_EQ(message(path), "no error");
      const std::string content = read_checkpoint(path);
      EXPECT_EQ(content, std::string(200'000, content.front()));
    }
  }
}

}  // namespace
}  // namespace culm::output
