#include <culm/base/error.hpp>
#include <culm/simulation/memory.hpp>
#include <culm/simulation/read_deck.hpp>
#include <culm/simulation/simulation.hpp>

#include "live_deck.hpp"

#include <gtest/gtest.h>

namespace culm::simulation {
namespace {

TEST(Memory, IsASizeWithItsUnit) {
  EXPECT_EQ(read_memory("16 GB"), 16e9);
  EXPECT_EQ(read_memory("0.5tb"), 0.5e12);
  EXPECT_EQ(read_memory("20kB"), 20e3);
  EXPECT_EQ(read_memory(""), machine_memory());
  EXPECT_GT(machine_memory(), 1e6);
  EXPECT_GE(machine_memory(4), machine_memory());
  for (const char* text : {"16", "GB", "-1 GB", "0 MB", "nan GB", "1 GB or so", "1e400 GB"}) {
    EXPECT_THROW(read_memory(text), UsageError) << text;
  }
}

// Machines of one run may differ: each decides by the least, else they would part ways and wait for
// each other for ever.
TEST(Memory, OfOneRankDecidesForAll) {
  const parallel::Comm world;
  const bool is_last = world.rank() == world.size() - 1;
  EXPECT_EQ(least_memory(is_last ? 2e9 : 3e9, world), 2e9);
  const DeckSource source{{{"beam.xml", beam_deck("")}}, {}};
  const Catalogue catalogue;
  const Options deck = read_deck(catalogue, source);
  EXPECT_THROW(
      Simulation(world, catalogue, deck, source, Log(LogLevel::quiet), is_last ? 1e3 : 1e9),
      InputError);
}

}  // namespace
}  // namespace culm::simulation
