#include <culm/base/absent.hpp>
#include <culm/base/error.hpp>
#include <culm/output/history_csv.hpp>

#include "read_back.hpp"
#include "sample_model.hpp"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <string>
#include <thread>
#include <utility>

namespace culm::output {
namespace {

TEST(HistoryCsv, HeaderNamesColumnsAndUnits) {
  const TemporaryFolder folder;
  const HistoryCsv history(folder / "h.csv", {{"energy", "J"}, {"steps", ""}, {"a,\"b\"", "m"}});
  EXPECT_EQ(read_text_file(folder / "h.csv"),
            "time,energy [J],steps,\"a,\"\"b\"\" [m]\",analysis,step\n");
}

TEST(HistoryCsv, NumbersReadBackExactlyWhileTheFileIsOpen) {
  const TemporaryFolder folder;
  HistoryCsv history(folder / "h.csv", {{"x", "m"}});
  const double values[] = {0.1, 1.0 / 3.0, -std::numeric_limits<double>::denorm_min(),
                           std::numeric_limits<double>::max(), 123456789.123456789};
  for (const double value : values) history.add({value, std::array{-value}, 0, 7});
  history.write();
  std::string text = read_text_file(folder / "h.csv");
  const char* cursor = text.c_str() + text.find('\n') + 1;
  for (const double value : values) {
    char* end = nullptr;
    EXPECT_EQ(std::strtod(cursor, &end), value);
    EXPECT_EQ(*end, ',');
    EXPECT_EQ(std::strtod(end + 1, &end), -value);
    EXPECT_EQ(std::string_view(end, 5), ",0,7\n");
    cursor = end + 5;
  }
  EXPECT_EQ(*cursor, '\0');
}

TEST(HistoryCsv, UnwritablePlacesAreFileErrors) {
  const TemporaryFolder folder;
  try {
    const HistoryCsv history(folder / "missing/h.csv", {});
    FAIL() << "no error";
  } catch (const FileError& error) {
    EXPECT_EQ(std::string(error.what()),
              (folder / "missing/h.csv").string() + ": cannot write: No such file or directory");
  }
}

TEST(HistoryCsv, AnEarlierHistoryGoesOn) {
  const TemporaryFolder folder;
  { HistoryCsv(folder / "h.csv", {{"x", "m"}}).add({7.0, std::array{7.0}}); }
  HistoryCsv history(folder / "h.csv", {{"x", "m"}},
                     std::array{0.0, 0.1, 0.0, 0.0, 1.0, -0.0, 0.0, 1.0});
  const std::string earlier = "time,x [m],analysis,step\n0,0.1,0,0\n1,-0,0,1\n";
  EXPECT_EQ(read_text_file(folder / "h.csv"), earlier);
  history.add({2.0, std::array{3.0}, 1, 12});
  history.write();
  EXPECT_EQ(read_text_file(folder / "h.csv"), earlier + "2,3,1,12\n");
}

TEST(HistoryCsv, WhatIsAbsentIsAnEmptyCell) {
  const TemporaryFolder folder;
  HistoryCsv history(folder / "h.csv", {{"x", "m"}, {"F", "N"}},
                     std::array{0.0, 1.0, absent, 0.0, 0.0});
  history.add({1.0, std::array{absent, 2.0}, 0, 1});
  history.write();
  EXPECT_EQ(read_text_file(folder / "h.csv"),
            "time,x [m],F [N],analysis,step\n0,1,,0,0\n1,,2,0,1\n");
}

TEST(HistoryCsv, AFileThatVanishesOrIsReplacedIsAFileError) {
  const TemporaryFolder folder;
  const auto path = folder / "h.csv";
  const auto add = [&](auto change) -> std::string {
    HistoryCsv history(path, {{"x", "m"}});
    history.add({0.0, std::array{1.0}});
    change();
    try {
      history.add({1.0, std::array{2.0}});
      history.write();
    } catch (const FileError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(add([&] { std::filesystem::remove(path); }),
            path.string() + ": was removed or renamed while the run was writing it");
  EXPECT_EQ(add([&] {
              std::filesystem::rename(path, folder / "other.csv");
              std::ofstream(path) << "mine";
            }),
            path.string() + ": was replaced by another file while the run was writing it");
  EXPECT_EQ(read_text_file(path), "mine");
}

TEST(HistoryCsv, LinesDoNotWaitLongWhileOthersFollow) {
  const TemporaryFolder folder;
  HistoryCsv history(folder / "h.csv", {});
  history.add({0.0, {}, 0, 0});
  std::this_thread::sleep_for(std::chrono::milliseconds(101));
  history.add({1.0, {}, 0, 1});
  EXPECT_EQ(read_text_file(folder / "h.csv"), "time,analysis,step\n0,0,0\n1,0,1\n");
}

TEST(HistoryCsv, LinesThatWaitAreWrittenAtTheEnd) {
  const TemporaryFolder folder;
  {
    HistoryCsv history(folder / "h.csv", {});
    history.add({0.0, {}, 0, 0});
    const HistoryCsv moved = std::move(history);
  }
  EXPECT_EQ(read_text_file(folder / "h.csv"), "time,analysis,step\n0,0,0\n");
}

TEST(HistoryCsv, FullDiskIsAFileError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP();
  EXPECT_THROW(HistoryCsv("/dev/full", {{"x", "m"}}), FileError);
}

TEST(HistoryCsv, WrongNumberOfValuesIsABug) {
  const TemporaryFolder folder;
  HistoryCsv history(folder / "h.csv", {{"x", "m"}});
  EXPECT_THROW(history.add({0.0, std::array{1.0, 2.0}}), InternalError);
}

}  // namespace
}  // namespace culm::output
