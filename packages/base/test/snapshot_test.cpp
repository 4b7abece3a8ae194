#include <culm/base/error.hpp>
#include <culm/base/snapshot.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace culm {
namespace {

Snapshot sample() {
  Snapshot snapshot;
  snapshot.set("state/next", {1.0 / 3.0, -0.0, std::numeric_limits<double>::denorm_min()});
  snapshot.set("empty", std::vector<double>{});
  snapshot.set("steps", 12345678.0);
  snapshot.set_text("deck", std::string("<a>\0\n", 5));
  return snapshot;
}

TEST(Snapshot, ComesBackBitByBit) {
  const Snapshot back = Snapshot::decode(sample().encode());
  EXPECT_EQ(back.encode(), sample().encode());
  EXPECT_EQ(back.numbers("state/next", 3), sample().numbers("state/next"));
  EXPECT_TRUE(std::signbit(back.numbers("state/next")[1]));
  EXPECT_TRUE(back.numbers("empty").empty());
  EXPECT_EQ(back.integer("steps"), 12345678);
  EXPECT_EQ(back.text("deck"), std::string("<a>\0\n", 5));
  EXPECT_TRUE(back.has("deck") && back.has("steps") && !back.has("step"));
}

TEST(Snapshot, SaysWhatIsMissing) {
  try {
    sample().number("analysis/step");
    FAIL();
  } catch (const FileError& error) {
    EXPECT_STREQ(error.what(), "the checkpoint has no 'analysis/step'");
  }
  try {
    (void)sample().numbers("state/next", 12);
    FAIL();
  } catch (const FileError& error) {
    EXPECT_STREQ(error.what(), "the checkpoint has 3 numbers of 'state/next', the model 12");
  }
}

TEST(Snapshot, RefusesBytesThatWereCutOffAtAnyPlace) {
  const std::string bytes = sample().encode();
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_THROW(Snapshot::decode(bytes.substr(0, length)), FileError) << length;
  }
  EXPECT_THROW(Snapshot::decode(bytes + "x"), FileError);
}

}  // namespace
}  // namespace culm
