#include <culm/base/error.hpp>
#include <culm/control/library_batch.hpp>

#include <culm_kit/batch_laws.hpp>
#include <culm_kit/temporary_folder.hpp>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace culm::control {
namespace {

constexpr const char* path = CULM_SPEED_CONTROLLER;
constexpr int rotor_speed = 21;
constexpr int torque = 47;
constexpr int count = 120;

// An input file of the controller, which goes with it.
class InputFile {
 public:
  explicit InputFile(const std::string& text) { std::ofstream(name()) << text; }
  std::string name() const { return (folder_ / "controller.in").string(); }

 private:
  kit::TemporaryFolder folder_;
};

TEST(SwapLibrary, AnswersThroughItsRecords) {
  const InputFile input("1.5 3 4 10 20");
  SwapLibrary library(path, "DISCON", input.name(), "test");
  library.set(rotor_speed, 1.0);
  EXPECT_EQ(library.call(SwapLibrary::Status::first, 0.1, 0.1), "");
  EXPECT_NEAR(library.get(torque), 3.0 * 0.5 + 4.0 * 0.05, 1e-6);
  library.set(rotor_speed, 11.0);
  EXPECT_EQ(library.call(SwapLibrary::Status::later, 0.2, 0.1), "the rotor is fast");
  EXPECT_EQ(library.get(count), 2.0);
}

// One counts its calls though another one of the same file is called, and begins, in between.
TEST(SwapLibrary, KeepsItsMemoryToItself) {
  const InputFile input("1.5 3 4 10 20");
  SwapLibrary one(path, "DISCON", input.name(), "one");
  one.call(SwapLibrary::Status::first, 0.1, 0.1);
  one.call(SwapLibrary::Status::later, 0.2, 0.1);
  SwapLibrary other(path, "DISCON", input.name(), "other");
  other.call(SwapLibrary::Status::first, 0.1, 0.1);
  one.call(SwapLibrary::Status::later, 0.3, 0.1);
  EXPECT_EQ(one.get(count), 3.0);
  EXPECT_NEAR(one.get(torque), 3.0 * 1.5 + 4.0 * 1.5 * 0.3, 1e-6);
  EXPECT_EQ(other.get(count), 1.0);
}

// No folder for temporary files, or one without programs, is none that a copy needs.
TEST(SwapLibrary, IsCopiedBesideItsFile) {
  const InputFile input("1.5 3 4 10 20");
  const char* const before = std::getenv("TMPDIR");
  setenv("TMPDIR", "/proc", 1);
  const SwapLibrary one(path, "DISCON", input.name(), "one");
  EXPECT_NO_THROW(SwapLibrary(path, "DISCON", input.name(), "other"));
  before != nullptr ? setenv("TMPDIR", before, 1) : unsetenv("TMPDIR");
}

TEST(SwapLibrary, FailsWithTheMessageOfTheLibrary) {
  const InputFile input("1.5 3 4 10 20");
  SwapLibrary library(path, "DISCON", input.name(), "test");
  library.set(rotor_speed, 25.0);
  try {
    library.call(SwapLibrary::Status::first, 0.1, 0.1);
    FAIL();
  } catch (const NumericalError& error) {
    EXPECT_NE(std::string(error.what()).find("aviFAIL = -2: the rotor runs away at 25.00 rad/s"),
              std::string::npos)
        << error.what();
  }
}

TEST(SwapLibrary, NamesWhatIsMissing) {
  EXPECT_THROW(SwapLibrary("/nowhere/discon.so", "DISCON", "", ""), FileError);
  EXPECT_THROW(SwapLibrary(path, "DISCONNECT", "", ""), FileError);
}

// A library that is told time as the speed, or the signal of its own demand.
struct Controlled {
  explicit Controlled(const InputFile& input, double interval = 0.0) {
    auto batch = std::make_unique<LibraryBatch>("libraries", model);
    library = batch.get();
    batch->add("controller", std::make_unique<SwapLibrary>(path, "DISCON", input.name(), "test"),
               interval);
    demand = batch->add_output("demand", 0.7);
    calls = batch->add_output("calls", 0.0);
    batch->connect_output("controller", torque, demand);
    batch->connect_output("controller", count, calls);
    batch->connect_input("controller", rotor_speed,
                         model::Amplitude::of_time([](double t) { return t; }));
    batch->connect_input("controller", 23, model::Amplitude::of_signal(demand));
    model.add_load(std::move(batch));
    model.freeze(model::Form::null_space);
    system.emplace(model);
    state = model.initial_state();
  }
  // An attempt of a step of the length h.
  void attempt(double h) {
    const Stencil stencil = Stencil::midpoint(h);
    state.time = state.time_prev + h;
    library->prepare(state, stencil);
    system->move(
        state,
        -system->tangent(state, stencil).partialPivLu().solve(system->residual(state, stencil)));
  }
  void accept() {
    library->accept(state);
    state.time_prev = state.time;
    state.own_prev = state.own;
  }
  double value(const model::Signal& signal) const { return signal.in_step(state, 1.0); }
  std::vector<double> memory() const {
    std::vector<double> values(library->memory_size());
    library->save(model::Items::local, values);
    return values;
  }

  model::Model model;
  LibraryBatch* library = nullptr;
  model::Signal demand, calls;
  std::optional<kit::DenseAssembly> system;
  model::State state;
};

// P e + I sum, where the first call is at the end of the first step.
TEST(LibraryBatch, HoldsADemandFromOneAcceptedStepToTheNext) {
  const InputFile input("1.5 3 4 10 20");
  Controlled controlled(input);
  controlled.attempt(0.1);
  EXPECT_EQ(controlled.value(controlled.demand), 0.7);
  controlled.accept();
  for (const double h : {0.4, 0.2, 0.1}) controlled.attempt(h);
  EXPECT_NEAR(controlled.value(controlled.demand), 3.0 * 1.4 + 4.0 * 0.14, 1e-6);
  EXPECT_EQ(controlled.value(controlled.calls), 1.0);
  controlled.accept();
  controlled.attempt(0.1);
  EXPECT_NEAR(controlled.value(controlled.demand), 3.0 * 1.3 + 4.0 * (0.14 + 0.13), 1e-6);
  EXPECT_EQ(controlled.value(controlled.calls), 2.0);
}

TEST(LibraryBatch, IsCalledOncePerInterval) {
  const InputFile input("1.5 3 4 10 20");
  Controlled controlled(input, 0.3);
  for (int step = 0; step < 10; ++step) {
    controlled.attempt(0.1);
    controlled.accept();
  }
  controlled.attempt(0.1);
  EXPECT_EQ(controlled.value(controlled.calls), 4.0);  // at 0.1, 0.4, 0.7, 1.0
}

TEST(LibraryBatch, IsNotCalledInStatics) {
  const InputFile input("1.5 3 4 10 20");
  Controlled controlled(input);
  controlled.state.time = 1.0;
  controlled.library->prepare(controlled.state, Stencil::statics());
  controlled.accept();
  EXPECT_EQ(controlled.memory(), (std::vector<double>{0.0, 0.0, 0.7, 0.0}));
}

TEST(LibraryBatch, CannotGoBackOverACall) {
  const InputFile input("1.5 3 4 10 20");
  Controlled controlled(input);
  controlled.attempt(0.1);
  controlled.accept();
  const std::vector<double> kept = controlled.memory();
  controlled.attempt(0.1);
  EXPECT_NO_THROW(controlled.library->restore(kept));  // nothing was called since
  controlled.attempt(0.1);
  controlled.accept();
  EXPECT_THROW(controlled.library->restore(kept), UsageError);
}

TEST(LibraryBatch, FailsBeforeTheNextStep) {
  const InputFile input("1.5 3 4 10 0.15");
  Controlled controlled(input);
  controlled.attempt(0.1);
  controlled.accept();
  controlled.attempt(0.1);
  EXPECT_NO_THROW(controlled.accept());
  EXPECT_THROW(controlled.attempt(0.1), NumericalError);
  EXPECT_EQ(controlled.library->range_used(), 2.0);
}

TEST(LibraryBatch, KeepsTheFirstWarning) {
  const InputFile input("1.5 3 4 0.15 20");
  Controlled controlled(input);
  EXPECT_EQ(controlled.library->range_used(), 0.0);
  for (int step = 0; step < 3; ++step) {
    controlled.attempt(0.1);
    controlled.accept();
  }
  EXPECT_EQ(controlled.library->range_used(), 2.0);
  EXPECT_EQ(controlled.library->range_warning(2.0),
            "library 'controller' warned 2 times, first 'the rotor is fast' at 0.2 s");
}

}  // namespace
}  // namespace culm::control
