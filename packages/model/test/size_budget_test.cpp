#include <culm/base/error.hpp>
#include <culm/model/size_budget.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace culm::model {
namespace {

const Where where{"deck.xml", 7, "Structures / beam / Curve"};

std::string refusal(SizeBudget& budget, double elements) {
  try {
    budget.take_beam(elements, elements, where);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(SizeBudget, IsSharedByAllThatAsk) {
  SizeBudget budget(1e9);
  EXPECT_EQ(refusal(budget, 8e4), "");
  EXPECT_EQ(refusal(budget, 6e4), "");
  EXPECT_EQ(refusal(budget, 1e9),
            "deck.xml:7: Structures / beam / Curve: asks for 1000000000 elements, with which the "
            "model needs about 6.2 TB (elements 4.7 TB, factors 1.5 TB) of memory and 1 GB are "
            "allowed: take fewer elements, or allow more with --max-memory");
}

// What predict_fill() finds in the graphs of such meshes [MB].
TEST(SizeBudget, KnowsTheFactorsOfSurfacesByTheirSides) {
  struct Sides {
    double narrow;
    double wide;
    double factors;
  };
  for (const auto& [narrow, wide, factors] : {Sides{16, 16, 2.1},
                                              {32, 32, 12},
                                              {128, 128, 330},
                                              {192, 192, 800},
                                              {64, 256, 300},
                                              {32, 512, 250},
                                              {8, 512, 33},
                                              {8, 4096, 270}}) {
    SizeBudget budget(1e12);
    budget.take_shell(narrow * wide, 1.0, narrow, where);
    EXPECT_NEAR(1e-6 * budget.taken().factors, factors, 0.2 * factors) << narrow << " x " << wide;
  }
}

// A run of 64 x 64 elements took 25 MB more for stresses and strains of 3 layers, 512 MB for those
// of 60, 261 MB more for 200 modes.
TEST(SizeBudget, CountsLayersAndModesThatTheDeckWants) {
  const auto need = [](SizeDemands demands, double layers) {
    SizeBudget budget(1e12, demands);
    budget.take_shell(64.0 * 64.0, layers, 64.0, where);
    return budget.taken();
  };
  EXPECT_EQ(need({}, 60.0).layers, 0.0);
  EXPECT_EQ(need({}, 60.0).modes, 0.0);
  EXPECT_NEAR(need({.layer_arrays = 2}, 3.0).layers, 25e6, 2e6);
  EXPECT_NEAR(need({.layer_arrays = 2}, 60.0).layers, 512e6, 20e6);
  EXPECT_EQ(need({.layer_arrays = 2, .shown_layers = 3.0}, 60.0).layers,
            need({.layer_arrays = 2}, 3.0).layers);
  EXPECT_NEAR(need({.modes = 200}, 1.0).modes, 261e6, 20e6);
}

// Runs of 192 x 192 elements took 1.25 GB on one process, 0.76 on each of two, 0.46 on the largest
// of four; with factors of 0.8 GB altogether, and 58 MB for each program.
TEST(SizeBudget, IsThatOfTheMachineWithTheMostProcesses) {
  const auto need = [](Processes processes) {
    SizeBudget budget(1e12, {.processes = processes});
    budget.take_shell(192.0 * 192.0, 1.0, 192.0, where);
    return budget.taken();
  };
  EXPECT_NEAR(need({1, 1}).total(), 1.25e9 - 58e6, 0.15e9);
  EXPECT_NEAR(need({2, 2}).total(), 2.0 * (0.76e9 - 58e6), 0.1e9);
  EXPECT_NEAR(need({4, 4}).total(), 4.0 * (0.46e9 - 58e6), 0.2e9);
  // machines of one each
  EXPECT_DOUBLE_EQ(4.0 * need({4, 1}).total(), need({4, 4}).total());
}

// A beam of 100 000 nodes, order 3, took 0.62 GB on one process, 0.33 on each of two, 0.19 on four;
// one of 40 000 with multipliers 0.83 GB; 58 MB for each program taken off.
TEST(SizeBudget, KnowsNodesOfBeams) {
  const auto need = [](SizeDemands demands, double nodes) {
    SizeBudget budget(1e12, demands);
    budget.take_beam(nodes / 3.0, nodes, where);
    return budget.taken().total();
  };
  EXPECT_NEAR(need({}, 1e5), 0.62e9, 0.03e9);
  EXPECT_NEAR(need({.processes = {2, 2}}, 1e5), 2.0 * 0.33e9, 0.03e9);
  EXPECT_NEAR(need({.processes = {4, 4}}, 1e5), 4.0 * 0.19e9, 0.03e9);
  EXPECT_NEAR(need({.has_multipliers = true}, 4e4), 0.83e9, 0.04e9);
}

TEST(SizeBudget, CountsFactorsOnlyWhereTheyMustBe) {
  const auto factors = [](bool may_iterate, double side) {
    SizeBudget budget(1e12, {.may_iterate = may_iterate});
    budget.take_shell(side * side, 1.0, side, where);
    return budget.taken().factors;
  };
  EXPECT_LT(factors(true, 400.0), 0.3 * factors(false, 400.0));
  EXPECT_EQ(factors(true, 8.0), factors(false, 8.0));
}

TEST(SizeBudget, NeedsNameTheirParts) {
  const MemoryNeed need{262e6, 330e6, 0.0, 1e9};
  EXPECT_EQ(need.text(), "1.59 GB (elements 262 MB, factors 330 MB, modes 1 GB)");
  EXPECT_NO_THROW(refuse_above(2e9, need, "the model", where));
  EXPECT_THROW(refuse_above(1.5e9, need, "the model", where), InputError);
}

}  // namespace
}  // namespace culm::model
