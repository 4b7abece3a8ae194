// What a coupling costs beside the steps: points that are read and loaded, and the exchange of
// loads and motions with another thread over a socket.

#include <culm/base/snapshot.hpp>
#include <culm/coupling/remote_partner.hpp>
#include <culm/simulation/simulation.hpp>

#include <benchmark/benchmark.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace culm;
using port::Quantity;

constexpr int points = 1000;
const char* const deck = R"(<ParameterList name="culm">
  <ParameterList name="Sections"><ParameterList name="pole">
    <Parameter name="Type" value="Stiffness Values"/>
    <Parameter name="EA" value="1e7"/> <Parameter name="GA1" value="4e6"/> <Parameter name="GA2" value="4e6"/>
    <Parameter name="EI1" value="1e5"/> <Parameter name="EI2" value="1e5"/> <Parameter name="GIp" value="8e4"/>
    <Parameter name="rhoA" value="5"/> <Parameter name="rhoI1" value="0.05"/> <Parameter name="rhoI2" value="0.05"/>
  </ParameterList></ParameterList>
  <ParameterList name="Structures"><ParameterList name="mast">
    <Parameter name="Type" value="Beam"/> <Parameter name="Section" value="pole"/>
    <ParameterList name="Curve">
      <Parameter name="Type" value="Line"/> <Parameter name="Elements" value="50"/>
      <Parameter name="From" value="{0, 0, 0}"/> <Parameter name="To" value="{0, 0, 10}"/>
    </ParameterList>
  </ParameterList></ParameterList>
  <ParameterList name="Constraints"><ParameterList name="ground">
    <Parameter name="Type" value="Rigid Support"/> <Parameter name="Node" value="mast/first"/>
  </ParameterList></ParameterList>
  <ParameterList name="Ports"><ParameterList name="skin">
    <Parameter name="Type" value="Stations"/> <Parameter name="Structure" value="mast"/>
    <Parameter name="Number" value="1000"/> <Parameter name="Offset" value="{0.1, 0, 0}"/>
  </ParameterList></ParameterList>
  <ParameterList name="Analyses"><ParameterList name="motion">
    <Parameter name="Type" value="Dynamic"/> <Parameter name="End Time" value="1"/> <Parameter name="Step" value="0.01"/>
  </ParameterList></ParameterList>
</ParameterList>)";

simulation::Simulation open_mast() {
  const auto path = std::filesystem::temp_directory_path() /
                    ("culm_benchmark_" + std::to_string(getpid()) + ".xml");
  std::ofstream(path) << deck;
  auto simulation = simulation::Simulation::open(path.string());
  std::filesystem::remove(path);
  return simulation;
}

// A mast in an attempt of its first step.
simulation::Simulation& mast() {
  // never destroyed: MPI ends before static objects do
  static auto& opened = *new simulation::Simulation(open_mast());
  static const bool begun = [] {
    analysis::Stepper& stepper = opened.begin();
    opened.set_port("skin", std::vector<double>(3 * points, 0.1));
    return stepper.attempt(0.01).accepted;
  }();
  if (!begun) throw std::runtime_error("the step did not converge");
  return opened;
}

void per_point(benchmark::State& state) {
  state.counters["per point"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * points,
                         static_cast<benchmark::Counter::Flags>(benchmark::Counter::kIsRate |
                                                                benchmark::Counter::kInvert));
}

void BM_PortRead(benchmark::State& state) {
  const auto quantity = static_cast<Quantity>(state.range(0));
  const model::State& now = mast().state();
  const port::Port& port = mast().port("skin");
  for (auto _ : state) benchmark::DoNotOptimize(port.read(quantity, now));
  per_point(state);
}
BENCHMARK(BM_PortRead)->DenseRange(0, 4);

void BM_PortWrite(benchmark::State& state) {
  const std::vector<double> force(3 * points, 0.1);
  for (auto _ : state) mast().set_port("skin", force);
  per_point(state);
}
BENCHMARK(BM_PortWrite);

// Another mast, after its first step.
analysis::Stepper& rested() {
  static auto& opened = *new simulation::Simulation(open_mast());
  static analysis::Stepper& stepper = [&]() -> analysis::Stepper& {
    analysis::Stepper& begun = opened.begin();
    opened.set_port("skin", std::vector<double>(3 * points, 0.1));
    begun.attempt(0.01);
    begun.accept();
    return begun;
  }();
  return stepper;
}

void BM_Attempt(benchmark::State& state) {
  for (auto _ : state) {
    rested().attempt(0.02);
    rested().discard();
  }
}
BENCHMARK(BM_Attempt);

void BM_Save(benchmark::State& state) {
  for (auto _ : state) {
    Snapshot snapshot(Snapshot::Use::memory);
    rested().save(snapshot);
    benchmark::DoNotOptimize(snapshot);
  }
}
BENCHMARK(BM_Save);

void BM_Restore(benchmark::State& state) {
  Snapshot snapshot(Snapshot::Use::memory);
  rested().save(snapshot);
  for (auto _ : state) rested().restore(snapshot);
}
BENCHMARK(BM_Restore);

// Answers as quickly as it can.
void answer(const std::string& address) {
  const auto channel = coupling::connect(address, 10.0);
  const coupling::Beginning beginning =
      coupling::read_hello(coupling::decode(channel->receive(10.0)));
  channel->send(coupling::encode(
      coupling::introduction({"echo", beginning.points(), coupling::bit(Quantity::motion),
                              std::numeric_limits<double>::infinity()})));
  for (;;) {
    const coupling::Frame frame = coupling::decode(channel->receive(10.0));
    if (frame.kind == coupling::FrameKind::bye) return;
    if (frame.kind == coupling::FrameKind::alive) continue;
    coupling::Frame loads = frame;
    loads.kind = coupling::FrameKind::answer;
    channel->send(coupling::encode(loads));
  }
}

void BM_SocketExchange(benchmark::State& state) {
  const auto count = static_cast<std::size_t>(state.range(0));
  const std::string address = "unix:" + (std::filesystem::temp_directory_path() /
                                         ("culm_benchmark_" + std::to_string(getpid())))
                                            .string();
  std::thread other(answer, address);
  coupling::RemotePartner partner([&] { return coupling::listen(address, 10.0); }, 10.0,
                                  std::numeric_limits<double>::infinity());
  partner.begin({"skin", 0.0, std::vector<double>(3 * count), std::vector<double>(6 * count), 0});
  coupling::Window window;
  window.end = 0.01;
  window.of(Quantity::motion).assign(6 * count, 1e-3);
  for (auto _ : state) benchmark::DoNotOptimize(partner.loads(window));
  partner.end("");
  other.join();
}
BENCHMARK(BM_SocketExchange)->Arg(1)->Arg(100)->Arg(10000)->UseRealTime();

}  // namespace
