#include <culm/base/error.hpp>
#include <culm/simulation/stop_request.hpp>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <string>

namespace culm::simulation {
namespace {

TEST(Walltime, IsReadAsUsersOfBatchSystemsWriteIt) {
  EXPECT_EQ(find_walltime("1:30:00"), 5400.0);
  EXPECT_EQ(find_walltime("00:00:05"), 5.0);
  EXPECT_EQ(find_walltime("100:00:00"), 360000.0);
  EXPECT_EQ(find_walltime("2-12:00:00"), 216000.0);
  EXPECT_EQ(find_walltime("90:30"), 5430.0);
  EXPECT_EQ(find_walltime("0:01.5"), 1.5);
  EXPECT_EQ(find_walltime("90 min"), 5400.0);
  EXPECT_EQ(find_walltime(" 1.5 h "), 5400.0);
  EXPECT_EQ(find_walltime("90min"), 5400.0);
  EXPECT_EQ(find_walltime("1e-3 s"), 1e-3);
  EXPECT_EQ(find_walltime("3600"), 3600.0);
  EXPECT_EQ(find_walltime(""), std::nullopt);
}

TEST(Walltime, OtherTextsAreRefused) {
  for (const char* text : {"soon", "1:60:00", "1:00:60", "1:2:3:4", "-5", "0", "-1:00:00", "1::0",
                           "2-12:00", "5 m", "5 s s", "1:00 h", "inf", "nan", ":30", "1-"}) {
    try {
      find_walltime(text);
      ADD_FAILURE() << text;
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find("got '" + std::string(text) + "'"),
                std::string::npos);
    }
  }
}

TEST(StopRequest, HearsSignalsWhileItLives) {
  {
    const StopRequest request;
    EXPECT_EQ(request.signal(), 0);
    std::raise(SIGUSR1);
    EXPECT_EQ(request.signal(), SIGUSR1);
    std::raise(SIGTERM);
    EXPECT_EQ(request.signal(), SIGTERM);
  }
  EXPECT_EQ(StopRequest().signal(), 0);
  struct sigaction action {};
  sigaction(SIGTERM, nullptr, &action);
  EXPECT_EQ(action.sa_handler, SIG_DFL);
}

// The program listens before it knows what to do.
TEST(StopRequest, KnowsWhatCameSinceAnotherOneBegan) {
  const StopRequest program;
  std::raise(SIGUSR1);
  {
    const StopRequest run(3600.0);
    EXPECT_EQ(run.signal(), SIGUSR1);
  }
  std::raise(SIGTERM);  // would end this program
  EXPECT_EQ(program.signal(), SIGTERM);
}

TEST(StopRequest, KnowsWhoEndsTheProgram) {
  const StopRequest request;
  EXPECT_FALSE(StopRequest::is_ended_by(0));
  std::raise(SIGUSR1);
  EXPECT_FALSE(StopRequest::is_ended_by(::getpid()));  // only to stop, or not to die
  const pid_t other = ::fork();
  if (other == 0) {
    ::kill(::getppid(), SIGTERM);
    ::_exit(0);
  }
  ::waitpid(other, nullptr, 0);
  EXPECT_TRUE(StopRequest::is_ended_by(other));
  EXPECT_FALSE(StopRequest::is_ended_by(::getppid()));
}

// As METIS does, which is compiled for the signal() of System V.
TEST(StopRequest, ListensThoughAnotherHasPutItsHandlerBack) {
  const StopRequest request;
  struct sigaction action {};
  sigaction(SIGTERM, nullptr, &action);
  action.sa_flags = SA_RESETHAND | SA_NODEFER;
  sigaction(SIGTERM, &action, nullptr);
  std::raise(SIGTERM);
  std::raise(SIGTERM);  // would end this program
  EXPECT_EQ(request.signal(), SIGTERM);
  sigaction(SIGTERM, &action, nullptr);
  StopRequest::listen();
  sigaction(SIGTERM, nullptr, &action);
  EXPECT_EQ(action.sa_flags & (SA_RESTART | SA_SIGINFO | SA_RESETHAND), SA_RESTART | SA_SIGINFO);
}

TEST(StopRequest, LooksAhead) {
  const StopRequest request(3600.0);
  EXPECT_FALSE(request.is_time_over(0.0));
  EXPECT_FALSE(request.is_time_over(3000.0));
  EXPECT_TRUE(request.is_time_over(3600.0));
  EXPECT_FALSE(StopRequest().is_time_over(1e9));
}

}  // namespace
}  // namespace culm::simulation
