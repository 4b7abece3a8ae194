#include <culm/simulation/simulation.hpp>

#include <gtest/gtest.h>
#include <mpi.h>

#include <string>
#include <vector>

namespace culm::simulation {
namespace {

// A group of ranks, for as long as this lives.
class Group {
 public:
  explicit Group(int colour) { MPI_Comm_split(MPI_COMM_WORLD, colour, 0, &handle_); }
  ~Group() { MPI_Comm_free(&handle_); }
  Group(const Group&) = delete;
  Group& operator=(const Group&) = delete;

  parallel::Comm comm() const { return parallel::Comm(handle_); }

 private:
  MPI_Comm handle_ = MPI_COMM_NULL;
};

const std::vector<std::string> clamped_bar = {"Sections/bar/Type=Stiffness Values",
                                              "Sections/bar/EA=100",
                                              "Sections/bar/GA1=50",
                                              "Sections/bar/GA2=50",
                                              "Sections/bar/EI1=2",
                                              "Sections/bar/EI2=2",
                                              "Sections/bar/GIp=1",
                                              "Sections/bar/rhoA=1",
                                              "Sections/bar/rhoI1=0.01",
                                              "Sections/bar/rhoI2=0.01",
                                              "Structures/beam/Type=Beam",
                                              "Structures/beam/Section=bar",
                                              "Structures/beam/Curve/Type=Line",
                                              "Structures/beam/Curve/From={0, 0, 0}",
                                              "Structures/beam/Curve/To={1, 0, 0}",
                                              "Structures/beam/Curve/Elements=6",
                                              "Constraints/clamp/Type=Rigid Support",
                                              "Constraints/clamp/Node=beam/first",
                                              "Loads/push/Type=External",
                                              "Loads/push/Node=beam/last",
                                              "Analyses/motion/Type=Dynamic",
                                              "Analyses/motion/End Time=0.2",
                                              "Analyses/motion/Step=0.05"};

// The end of the beam after all steps, under a force of this size.
Vec3 tip_after_motion(const parallel::Comm& comm, double force, int steps) {
  Simulation simulation = Simulation::make(clamped_bar, Log(LogLevel::quiet), comm);
  analysis::Stepper& stepper = simulation.begin();
  simulation.set_load("push", {0.0, force, 0.1, 0.0, 0.0, 0.0});
  for (int step = 0; step < steps; ++step) {
    EXPECT_TRUE(stepper.attempt(stepper.proposal()).accepted);
    stepper.accept();
  }
  return simulation.position(simulation.nodes("beam/last").front());
}

// The last rank makes steps of its own, fewer of them and under another force, while the others
// work together; none waits for what is not its business.
TEST(PartOfTheRanks, WorksOnAModelOfItsOwn) {
  const parallel::Comm world;
  const bool is_apart = world.rank() == world.size() - 1 && world.size() > 1;
  const Group group(is_apart ? 1 : 0);
  const double force = is_apart ? 0.2 : 0.5;
  const int steps = is_apart ? 2 : 4;
  const Vec3 found = tip_after_motion(group.comm(), force, steps);
  const Vec3 alone = tip_after_motion(parallel::Comm(MPI_COMM_SELF), force, steps);
  EXPECT_GT(alone.tail<2>().norm(), 1e-4);
  EXPECT_LT((found - alone).norm(), 1e-12);
}

}  // namespace
}  // namespace culm::simulation
