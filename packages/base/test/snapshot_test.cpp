#include <culm/base/error.hpp>
#include <culm/base/snapshot.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace culm {
namespace {

Snapshot sample_snapshot() {
  Snapshot snapshot;
  snapshot.set("state/next", {1.0 / 3.0, -0.0, std::numeric_limits<double>::denorm_min()});
  snapshot.set("empty", std::vector<double>{});
  snapshot.set("steps", 12345678.0);
  snapshot.set_text("deck", std::string("<a>\0\n", 5));
  return snapshot;
}

TEST(Snapshot, ComesBackBitByBit) {
  const Snapshot back = Snapshot::decode(sample_snapshot().encode());
  EXPECT_EQ(back.encode(), sample_snapshot().encode());
  EXPECT_EQ(back.copy("state/next"), sample_snapshot().copy("state/next"));
  EXPECT_TRUE(std::signbit(back.numbers("state/next")[1]));
  EXPECT_TRUE(back.numbers("empty").empty());
  EXPECT_EQ(back.integer("steps"), 12345678);
  EXPECT_EQ(back.text("deck"), std::string("<a>\0\n", 5));
  EXPECT_TRUE(back.has("deck") && back.has("steps") && !back.has("step"));
}

TEST(Snapshot, TablesOfAllRanksFollowAndAreNumbersThen) {
  for (const char* title : {"a", "of another length"}) {
    Snapshot snapshot(Snapshot::Use::shared);
    snapshot.set("own", {1.0, 2.0});
    snapshot.set_text("title", title);
    // of the first table this rank has one row, of the second none
    snapshot.add_table({"first", 2, 3, {{1, 1}}, [] { return std::vector{4.0, 5.0, 6.0}; }});
    snapshot.add_table({"second", 1, 1, {}, [] { return std::vector<double>(); }});
    std::string bytes = snapshot.encode();
    EXPECT_EQ(bytes.size() % sizeof(double), 0);
    const std::array<double, 7> numbers{1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0};
    bytes.append(reinterpret_cast<const char*>(numbers.data()), sizeof numbers);
    const Snapshot back = Snapshot::decode(bytes);
    EXPECT_EQ(back.copy("own"), (std::vector<double>{1.0, 2.0}));
    EXPECT_EQ(back.text("title"), title);
    EXPECT_EQ(back.copy("first"), (std::vector<double>{1.0, 2.0, 3.0, 4.0, 5.0, 6.0}));
    EXPECT_EQ(back.number("second"), 7.0);
    EXPECT_THROW(Snapshot::decode(bytes.substr(0, bytes.size() - 8)), FileError);
  }
}

TEST(Snapshot, SaysWhatIsMissing) {
  try {
    sample_snapshot().number("analysis/step");
    FAIL();
  } catch (const FileError& error) {
    EXPECT_STREQ(error.what(), "the checkpoint has no 'analysis/step'");
  }
  try {
    (void)sample_snapshot().numbers("state/next", 12);
    FAIL();
  } catch (const FileError& error) {
    EXPECT_STREQ(error.what(), "the checkpoint has 3 numbers of 'state/next', the model 12");
  }
}

TEST(Snapshot, WholeNumbersAreWholeAndFitAnInt) {
  Snapshot snapshot;
  snapshot.set("most", std::numeric_limits<int>::max());
  snapshot.set("least", -std::numeric_limits<int>::max());
  EXPECT_EQ(snapshot.integer("most"), std::numeric_limits<int>::max());
  EXPECT_EQ(snapshot.integer("least"), -std::numeric_limits<int>::max());
  const std::vector<std::pair<double, const char*>> wrong = {
      {1e300, "1e+300"}, {-2147483648.0, "-2147483648"}, {0.5, "0.5"}, {NAN, "nan"}};
  for (const auto& [value, text] : wrong) {
    snapshot.set("deck/files", value);
    try {
      (void)snapshot.integer("deck/files");
      FAIL() << value;
    } catch (const FileError& error) {
      EXPECT_EQ(error.what(), std::string("the checkpoint has ") + text +
                                  " for 'deck/files', which is a whole number of at most "
                                  "2147483647 either way");
    }
  }
}

TEST(Snapshot, RefusesBytesThatWereCutOffAtAnyPlace) {
  const std::string bytes = sample_snapshot().encode();
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_THROW(Snapshot::decode(bytes.substr(0, length)), FileError) << length;
  }
  EXPECT_THROW(Snapshot::decode(bytes + "x"), FileError);
}

}  // namespace
}  // namespace culm
