#include "../src/survive_reading.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>

namespace culm::output {
namespace {

// What it inherited, such as the lock of a folder, would be kept from everybody else.
TEST(SurviveReading, WhoReadsEndsWithWhoAskedForIt) {
  std::array<int, 2> channel{};
  ASSERT_EQ(pipe(channel.data()), 0);
  const pid_t asks = fork();
  if (asks == 0) {
    survive_reading("file", [&] {
      if (write(channel[1], "r", 1) == 1) sleep(60);
    });
    _exit(0);
  }
  close(channel[1]);
  char letter = 0;
  ASSERT_EQ(read(channel[0], &letter, 1), 1);
  kill(asks, SIGKILL);
  waitpid(asks, nullptr, 0);
  pollfd end = {channel[0], POLLIN, 0};
  ASSERT_EQ(poll(&end, 1, 30'000), 1) << "the pipe is still open in a process that reads";
  EXPECT_EQ(read(channel[0], &letter, 1), 0);
  close(channel[0]);
}

}  // namespace
}  // namespace culm::output
