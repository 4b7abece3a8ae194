#include <culm/coupling/channel.hpp>
#include <culm/coupling/frame.hpp>
#include <culm/coupling/partner_error.hpp>

#include <culm_kit/temporary_folder.hpp>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace culm::coupling {
namespace {

// Two ends of a socket of their own.
class SocketChannels : public testing::Test {
 protected:
  SocketChannels() {
    const std::string address = "unix:" + (folder_ / "door").string();
    std::thread guest([&] { there_ = connect(address, 10.0); });
    here_ = listen(address, 10.0);
    guest.join();
  }

  static Frame frame_of(std::size_t size, std::uint32_t window) {
    Frame frame{FrameKind::attempt, window};
    for (std::size_t i = 0; i < size; ++i) frame.payload += static_cast<char>(i * i + window);
    return frame;
  }

  kit::TemporaryFolder folder_;
  std::unique_ptr<Channel> here_;
  std::unique_ptr<Channel> there_;
};

// Small ones together in one piece, and such as come in many.
TEST_F(SocketChannels, FramesComeWholeAndInOrder) {
  const std::vector<std::size_t> sizes = {0, 1, 48, 0, 65472, 65473, 3000000, 7, 131072, 0};
  std::thread sender([&] {
    for (std::size_t k = 0; k < sizes.size(); ++k) {
      there_->send(encode(frame_of(sizes[k], static_cast<std::uint32_t>(k))));
    }
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(20));  // so that some wait together
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    const Frame frame = decode(here_->receive(10.0));
    EXPECT_EQ(frame.window, k);
    EXPECT_EQ(frame.payload, frame_of(sizes[k], frame.window).payload) << sizes[k];
  }
  sender.join();
}

TEST_F(SocketChannels, SaysHowTheOtherSideIsSilent) {
  const auto message = [this] {
    try {
      here_->receive(0.05);
    } catch (const PartnerError& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  EXPECT_EQ(message(), "it said nothing for 0.05 s");
  there_->send(encode(frame_of(3, 1)) + encode(frame_of(100, 2)).substr(0, 70));
  there_.reset();
  EXPECT_EQ(message(), "nothing");
  EXPECT_EQ(message(), "it is gone in the middle of a frame");
  EXPECT_EQ(message(), "it is gone without a word");
}

}  // namespace
}  // namespace culm::coupling
