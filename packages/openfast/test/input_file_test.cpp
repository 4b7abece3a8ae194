#include <culm/base/error.hpp>
#include <culm/openfast/input_file.hpp>

#include "sample_files.hpp"

#include <gmock/gmock.h>

#include <functional>

namespace culm::openfast {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;

using InputFileTest = SampleFiles;

constexpr const char* sample = R"~(---- HEADER ----
 A sample, with words - like this
---- SECTION ONE ----
True          Echo        - Echo it (flag)
  1.5D+03     Mass(1)     - Of the first (kg)
-2            Level       - Negative
"DEFAULT"     refine      - In quotes
"sub\b.dat"   BldFile1    - A file
0.1, 0.2 0.3  zeta        - Three values
---- TABLE ----
   a      b
  (-)    (m)
  0.0   1.0
  0.5   2.0E0  3  a comment
  1.0   4.0

7             Last        - After the table
              OutList     - Names follow
"Mass(1)"     - not an entry
END of list
8             Very_Last   - After the list
9             Level       - Again
)~";

TEST_F(InputFileTest, ReadsValuesByTheirKeywords) {
  InputFile file(write("a.dat", sample));
  EXPECT_EQ(file.title(), "A sample, with words - like this");
  EXPECT_TRUE(file.flag("echo"));
  EXPECT_EQ(file.number("Mass1"), 1500.0);
  EXPECT_EQ(file.integer("Level"), -2);
  EXPECT_EQ(file.text("refine"), "DEFAULT");
  EXPECT_EQ(file.file("BldFile(1)"), file.path().parent_path() / "sub" / "b.dat");
  EXPECT_EQ(file.integer("Last"), 7);
  EXPECT_EQ(file.integer("very_last"), 8);
  EXPECT_EQ(file.number("absent", 3.0), 3.0);
  EXPECT_FALSE(file.has("not"));
}

TEST_F(InputFileTest, ReadsTables) {
  InputFile file(write("a.dat", sample));
  const auto rows = file.table("zeta", 3, 2, "table");
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_THAT(rows[1].values, ElementsAre(0.5, 2.0, 3.0));
  EXPECT_EQ(rows[0].line, 13);
  EXPECT_THAT(file.columns_below("TABLE"), ElementsAre("a", "b"));
}

TEST_F(InputFileTest, NamesWhatNobodyAskedFor) {
  InputFile file(write("a.dat", sample));
  for (const char* keyword : {"Echo", "Mass(1)", "Level", "refine", "Last"}) file.text(keyword);
  file.ignore({"BldFile(1)", "Very_Last"});
  const auto unread = file.unread();
  ASSERT_EQ(unread.size(), 2U);
  EXPECT_THAT(to_string(unread[0]), EndsWith("a.dat:9: zeta: unknown entry, left out: '0.1'"));
  EXPECT_THAT(to_string(unread[1]),
              EndsWith("a.dat:22: Level: contradicts line 6, which was taken"));
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST_F(InputFileTest, ErrorsNameFileLineAndKeyword) {
  InputFile file(write("a.dat", sample));
  EXPECT_THAT(message_of([&] { file.number("refine"); }),
              EndsWith("a.dat:7: refine: must be a number, got 'DEFAULT'"));
  EXPECT_THAT(message_of([&] { file.number("zeta"); }),
              EndsWith("a.dat:9: zeta: must be one number, got '0.1 0.2 0.3'"));
  InputFile half(write("half.dat", "--- A ---\ntitle\n0.1 NumBl - blades\n"));
  EXPECT_THAT(message_of([&] { half.integer("NumBl"); }),
              EndsWith("half.dat:3: NumBl: must be a whole number, got '0.1'"));
  EXPECT_THAT(message_of([&] { file.flag("Level"); }),
              EndsWith("a.dat:6: Level: must be True or False, got '-2'"));
  EXPECT_THAT(message_of([&] { file.number("Mass(2)"); }), EndsWith("a.dat: Mass(2): is missing"));
  EXPECT_THAT(message_of([&] { file.table("zeta", 4, 2, "rows"); }),
              HasSubstr("rows must be 4 lines of 2 numbers, found 3"));
  EXPECT_THAT(message_of([&] { file.table("zeta", 2, 2, "rows"); }),
              EndsWith("a.dat:15: rows: more lines of numbers than the 2 that zeta announces"));
}

TEST_F(InputFileTest, RefusesWhatIsNoFile) {
  EXPECT_THROW(InputFile(write("a.dat", "").parent_path()), FileError);
  EXPECT_THROW(InputFile(write("a.dat", "").parent_path() / "absent"), FileError);
  EXPECT_FALSE(InputFile(write("empty.dat", "")).has("x"));
}

}  // namespace
}  // namespace culm::openfast
