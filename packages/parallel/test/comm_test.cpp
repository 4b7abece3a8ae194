#include <culm/parallel/comm.hpp>

#include <gtest/gtest.h>

#include <numeric>

namespace culm::parallel {
namespace {

// Tests run on one.
TEST(Comm, KnowsHowManyShareAMachine) {
  const Comm world;
  EXPECT_EQ(world.most_on_a_machine(), world.size());
  EXPECT_EQ(Comm(MPI_COMM_SELF).most_on_a_machine(), 1);
}

TEST(Comm, MaximumIsTheSameOnAllRanks) {
  const Comm comm;
  EXPECT_EQ(comm.max(comm.rank()), comm.size() - 1);
  EXPECT_EQ(comm.max(0.5 * comm.rank()), 0.5 * (comm.size() - 1));
}

TEST(Comm, BroadcastBringsTheTextOfTheRoot) {
  const Comm comm;
  const std::string mine = comm.is_root() ? "deck of the root" : "other";
  EXPECT_EQ(comm.broadcast(mine), "deck of the root");
}

TEST(Comm, GathersPieceByPiece) {
  const Comm comm;
  const std::vector<double> piece(static_cast<std::size_t>(2 * comm.rank()), 0.5 * comm.rank());
  std::vector<int> ranks;
  comm.gather(piece, [&](int rank, std::span<const double> taken) {
    ranks.push_back(rank);
    EXPECT_EQ(std::vector<double>(taken.begin(), taken.end()),
              std::vector<double>(static_cast<std::size_t>(2 * rank), 0.5 * rank));
  });
  std::vector<int> all(comm.is_root() ? static_cast<std::size_t>(comm.size()) : 0);
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(ranks, all);
}

TEST(Funnel, ScatterUndoesGather) {
  const Comm comm;
  const std::vector<double> piece(static_cast<std::size_t>(comm.rank() + 1), 1.0 + comm.rank());
  const Funnel funnel(comm, comm.rank() + 1);
  std::vector<double> whole(static_cast<std::size_t>(funnel.total()));
  funnel.gather(piece, whole);
  if (comm.is_root()) {
    ASSERT_EQ(funnel.total(), comm.size() * (comm.size() + 1) / 2);
    EXPECT_EQ(whole.front(), 1.0);
    EXPECT_EQ(whole.back(), comm.size());
  }
  std::vector<double> back(piece.size());
  funnel.scatter(whole, back);
  EXPECT_EQ(back, piece);
}

}  // namespace
}  // namespace culm::parallel
