#include <culm/base/number_file.hpp>

#include <culm_kit/temporary_folder.hpp>
#include <gtest/gtest.h>

#include <fstream>

namespace culm {
namespace {

TEST(NumberLines, HoldNumbersOrNothing) {
  const kit::TemporaryFolder folder;
  std::ofstream(folder / "table.csv") << "# r, F\n0, 1.5e3\r\n\n -2 # last\n1, \n1; 2\nnan\n";
  std::vector<NumberLine> lines;
  const std::string path =
      read_number_lines("table.csv", {(folder / "deck.xml").string(), 3, "File Name"},
                        [&](const NumberLine& line) { lines.push_back(line); });
  EXPECT_EQ(path, (folder / "table.csv").string());
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_EQ(lines[0].numbers, (std::vector{0.0, 1500.0}));
  EXPECT_EQ(lines[1].numbers, std::vector{-2.0});
  EXPECT_EQ(lines[1].where.line, 4);
  for (std::size_t i : {2U, 3U, 4U}) EXPECT_TRUE(lines[i].numbers.empty()) << lines[i].text;
}

TEST(NumberLines, MayBeginWithTheMarkOfUtf8) {
  const kit::TemporaryFolder folder;
  std::ofstream(folder / "table.csv") << "\xEF\xBB\xBF"
                                         "1, 2\r\n3, 4\r\n";
  std::vector<std::vector<double>> lines;
  read_number_lines("table.csv", {(folder / "deck.xml").string(), 3, "File Name"},
                    [&](const NumberLine& line) { lines.push_back(line.numbers); });
  EXPECT_EQ(lines, (std::vector<std::vector<double>>{{1.0, 2.0}, {3.0, 4.0}}));
}

}  // namespace
}  // namespace culm
