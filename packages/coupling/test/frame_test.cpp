#include <culm/base/error.hpp>
#include <culm/coupling/messages.hpp>
#include <culm/coupling/partner_error.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace culm::coupling {
namespace {

using port::Quantity;
using testing::HasSubstr;

constexpr int frame_points = 2;
constexpr Quantities wanted = bit(Quantity::motion) | bit(Quantity::rotation);

Window sample() {
  Window window{7, 3, 0.7, 0.8, {}, {}, {}};
  for (int i = 0; i < 6 * frame_points; ++i) window.of(Quantity::motion).push_back(std::sqrt(i));
  for (int i = 0; i < 9 * frame_points; ++i) window.of(Quantity::rotation).push_back(-0.1 * i);
  for (int i = 0; i < 6 * frame_points; ++i) window.loads.push_back(1e9 * i);
  return window;
}

std::string mistake(const std::string& bytes) {
  try {
    const Frame frame = decode(bytes);
    return "";
  } catch (const PartnerError& error) {
    return error.what();
  }
}

TEST(Frames, AreTheSameAfterTheWire) {
  const Frame frame = decode(encode(motion(FrameKind::accept, sample(), wanted)));
  EXPECT_EQ(frame.kind, FrameKind::accept);
  const Window window = read_motion(frame, wanted, frame_points);
  EXPECT_EQ(window.number, 7);
  EXPECT_EQ(window.attempt, 3);
  EXPECT_EQ(window.start, 0.7);
  EXPECT_EQ(window.end, 0.8);
  EXPECT_EQ(window.motion, sample().motion);
  EXPECT_EQ(window.loads, sample().loads);

  const Beginning beginning{"skin", 1.5, {1, 2, 3, 4, 5, 6}, std::vector(12, 0.25), 4};
  const Beginning read = read_hello(decode(encode(hello(beginning))));
  EXPECT_EQ(read.port, "skin");
  EXPECT_EQ(read.time, 1.5);
  EXPECT_EQ(read.reference, beginning.reference);
  EXPECT_EQ(read.velocity, beginning.velocity);
  EXPECT_EQ(read.window, 4);

  const Books books = read_accepted(decode(encode(accepted(sample(), {1.0, 2.0}))));
  EXPECT_EQ(books.energy, 1.0);
  EXPECT_EQ(books.dissipated, 2.0);
}

// The page that describes the bytes is for other languages: these are they.
TEST(Frames, LieOnTheWireAsDescribed) {
  const std::string bytes = encode({FrameKind::bye, 0x01020304, 5, 0.0, 1.0, "ab"});
  ASSERT_EQ(bytes.size(), frame_header + 2);
  EXPECT_EQ(bytes.substr(0, 4), "CULM");
  EXPECT_EQ(bytes.substr(4, 4), std::string("\1\0\11\0", 4));  // version, kind
  EXPECT_EQ(bytes.substr(8, 8), std::string("\4\3\2\1\5\0\0\0", 8));
  EXPECT_EQ(bytes.substr(24, 8), std::string("\0\0\0\0\0\0\xf0\x3f", 8));
  EXPECT_EQ(bytes.substr(32, 8), std::string("\2\0\0\0\0\0\0\0", 8));
  EXPECT_EQ(bytes.substr(44, 20), std::string(20, '\0'));
  EXPECT_EQ(bytes.substr(64), "ab");
}

// Every byte that counts is guarded.
TEST(Frames, DamageIsFound) {
  const std::string bytes = encode(motion(FrameKind::attempt, sample(), wanted));
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (i >= 44 && i < frame_header) continue;  // reserved
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ 4);
    EXPECT_NE(mistake(damaged), "") << i;
  }
  EXPECT_THAT(mistake(bytes.substr(0, 63)), HasSubstr("shorter than a frame"));
  EXPECT_THAT(mistake(bytes.substr(0, 100)), HasSubstr("not as long as it says"));
  EXPECT_THAT(mistake("GET / HTTP/1.1\r\n" + std::string(64, ' ')), HasSubstr("no frame of culm"));
}

TEST(Frames, SaySoWhenTheyHoldTheWrongThings) {
  const auto says = [](auto read) {
    try {
      read();
      return std::string();
    } catch (const PartnerError& error) {
      return std::string(error.what());
    }
  };
  Eigen::VectorXd loads = Eigen::VectorXd::Zero(6 * frame_points);
  EXPECT_THAT(says([&] { read_answer(answer(sample(), loads.head(6)), frame_points); }),
              HasSubstr("its answer has 48 bytes; six numbers for each of 2 points are 96"));
  loads[8] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(says([&] { read_answer(answer(sample(), loads), frame_points); }),
              HasSubstr("nan for component 2 at point 1"));
  EXPECT_THAT(says([] {
                read_introduction(introduction({"it", 2, 64, 1.0}));
              }),
              HasSubstr("wants quantities 0x40"));
  EXPECT_THAT(says([] {
                read_introduction(introduction({"it", 2, 1, 0.0}));
              }),
              HasSubstr("longest window is 0"));
  Frame frame = motion(FrameKind::attempt, sample(), wanted);
  frame.payload += 'x';
  EXPECT_THAT(says([&] { read_motion(frame, wanted, frame_points); }),
              HasSubstr("more than it should"));
  EXPECT_THAT(says([&] { read_motion(frame, wanted, 3); }), HasSubstr("less than it must"));
}

}  // namespace
}  // namespace culm::coupling
