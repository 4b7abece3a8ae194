#include <culm/parallel/shared_failure.hpp>

#include <gtest/gtest.h>

#include <functional>
#include <string>

namespace culm::parallel {
namespace {

template <class Kind>
std::string thrown_by(const Comm& comm, const std::function<void()>& work) {
  try {
    together(comm, work);
  } catch (const Kind& error) {
    return error.what();
  }
  return "nothing";
}

// Each rank in turn fails alone, and all say so.
TEST(Together, AllThrowWhatOneRankThrew) {
  const Comm comm;
  for (int rank = 0; rank < comm.size(); ++rank) {
    const auto on_it = [&](const auto& fail) {
      return [&, fail] {
        if (comm.rank() == rank) fail(std::to_string(rank));
      };
    };
    EXPECT_EQ(thrown_by<NonFiniteError>(
                  comm, on_it([](const std::string& who) { throw NonFiniteError("of " + who); })),
              "of " + std::to_string(rank));
    EXPECT_EQ(thrown_by<FileError>(
                  comm, on_it([](const std::string& who) { throw FileError("a.txt", who); })),
              "a.txt: " + std::to_string(rank));
    EXPECT_EQ(thrown_by<InputError>(comm, on_it([](const std::string& who) {
                                      throw InputError({"deck.xml", 3, "Flows / wind"}, who);
                                    })),
              "deck.xml:3: Flows / wind: " + std::to_string(rank));
  }
}

TEST(Together, TheLowestRankSpeaksWhereSeveralFail) {
  const Comm comm;
  EXPECT_EQ(
      thrown_by<NumericalError>(comm,
                                [&] {
                                  if (comm.rank() > 0 || comm.size() == 1) {
                                    throw NumericalError("rank " + std::to_string(comm.rank()));
                                  }
                                }),
      comm.size() == 1 ? "rank 0" : "rank 1");
}

TEST(Together, NothingIsThrownWhereNoneFails) {
  const Comm comm;
  EXPECT_EQ(thrown_by<Error>(comm, [] {}), "nothing");
}

}  // namespace
}  // namespace culm::parallel
