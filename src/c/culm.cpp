// The C interface: nothing of C++ crosses it.

#include "culm.h"

#include <culm/base/error.hpp>
#include <culm/parallel/mpi_session.hpp>
#include <culm/simulation/session.hpp>
#include <culm/simulation/simulation.hpp>

#include <mpi.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <exception>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace {

using culm::UsageError;
using culm::analysis::Stepper;
using culm::parallel::Comm;
using culm::simulation::Simulation;

// MPI and Trilinos, from the first culm_open to culm_end or the end of the program.
class Start {
 public:
  Start() : session_(count_, values_) {}

 private:
  std::array<char, 5> name_{"culm"};
  std::array<char*, 2> arguments_{name_.data(), nullptr};
  int count_ = 1;
  char** values_ = arguments_.data();
  culm::simulation::Session session_;
};

std::unique_ptr<Start>& start() {
  static std::unique_ptr<Start> kept;
  return kept;
}

bool has_ended = false;

// MPI begins and ends once in a program.
void refuse_after_end() {
  if (has_ended) throw UsageError("'culm_end' was called: nothing can follow it in this program");
}

void begin_session() {
  refuse_after_end();
  if (start() != nullptr) return;
  start() = std::make_unique<Start>();
  // before MPI's own library goes
  static const int registered = std::atexit([] { start().reset(); });
  culm::internal_check(registered == 0, "the end of the program cannot be heeded");
}

std::string& error_without_simulation() {
  static std::string text;
  return text;
}

void require(bool holds, const char* what) {
  if (!holds) throw UsageError(what);
}

std::string name_of(const char* text) {
  require(text != nullptr, "there is no name: it is NULL");
  return text;
}

std::vector<std::string> texts(const char* const* values, int count) {
  require(values != nullptr || count == 0, "there are no texts: the array is NULL");
  std::vector<std::string> result;
  for (int i = 0; i < count; ++i) result.push_back(name_of(values[i]));
  return result;
}

// Writes a result to where the caller wants it.
template <class T>
void put(T value, T* place) {
  require(place != nullptr, "there is no place for the result: it is NULL");
  *place = std::move(value);
}

// Runs a body, keeps what it throws as text, and returns its code.
template <class Body>
int guarded(std::string& error, Body body) noexcept {
  const auto keep = [&error](const char* text) {
    try {
      error = text;
    } catch (...) {
      error.clear();  // no memory left for it
    }
  };
  try {
    error.clear();
    body();
    return CULM_OK;
  } catch (const culm::Error& e) {
    keep(e.what());
    return e.exit_code();
  } catch (const std::exception& e) {
    keep(e.what());
  } catch (...) {
    keep("something unknown was thrown");
  }
  return CULM_INTERNAL;
}

}  // namespace

struct culm_simulation {
  culm_simulation(const char* deck, std::vector<std::string> overrides, const Comm& comm)
      : simulation(Simulation::open(deck, std::move(overrides),
                                    culm::Log(said, culm::LogLevel::info), comm)) {}

  Stepper& stepper() {
    Stepper* const present = simulation.stepper();
    require(present != nullptr, "no analysis was taken up: 'culm_begin' comes first");
    return *present;
  }

  std::ostringstream said;
  std::string messages;
  std::string broken;
  std::string port_name;
  std::string error;
  Simulation simulation;
};

struct culm_snapshot {
  const culm_simulation* owner;
  long taken_up;
  culm::Snapshot snapshot = culm::Snapshot(culm::Snapshot::Use::memory);
};

namespace {

template <class Body>
int with(culm_simulation* simulation, Body body) noexcept {
  if (simulation == nullptr) {
    return guarded(error_without_simulation(),
                   [] { throw UsageError("there is no simulation: it is NULL"); });
  }
  return guarded(simulation->error, [&] {
    refuse_after_end();
    body(*simulation);
  });
}

void copy(const std::vector<double>& from, double* to, int size) {
  require(to != nullptr, "there is no array to write to: it is NULL");
  if (from.size() != static_cast<std::size_t>(size)) {
    throw UsageError("the array has room for " + std::to_string(size) + " values, there are " +
                     std::to_string(from.size()));
  }
  std::copy(from.begin(), from.end(), to);
}

void copy(const culm::Vec3& from, double* to) {
  if (to != nullptr) std::copy(from.begin(), from.end(), to);
}

std::span<const double> values(const double* first, int count, const char* what) {
  require(first != nullptr && count >= 0, what);
  return {first, static_cast<std::size_t>(count)};
}

}  // namespace

int culm_api_version(void) { return CULM_API_VERSION; }

const char* culm_error(const culm_simulation* simulation) {
  return simulation == nullptr ? error_without_simulation().c_str() : simulation->error.c_str();
}

const char* culm_messages(culm_simulation* simulation) {
  if (simulation == nullptr) return "";
  guarded(simulation->error, [&] {
    simulation->messages = simulation->said.str();
    simulation->said.str({});
  });
  return simulation->messages.c_str();
}

int culm_open(int api, int comm, const char* deck, const char* const* overrides, int count,
              culm_simulation** simulation) {
  return guarded(error_without_simulation(), [&] {
    require(simulation != nullptr, "there is no place for the simulation: it is NULL");
    *simulation = nullptr;
    if (api / 1000 != CULM_API_VERSION / 1000 || api > CULM_API_VERSION) {
      throw UsageError("the program was made for version " + std::to_string(api) +
                       " of the interface, the library has " + std::to_string(CULM_API_VERSION));
    }
    require(deck != nullptr, "there is no deck: it is NULL");
    begin_session();
    if (comm != CULM_WORLD) culm::parallel::start_mpi();
    const Comm group = comm == CULM_WORLD ? Comm() : Comm(MPI_Comm_f2c(comm));
    *simulation = std::make_unique<culm_simulation>(deck, texts(overrides, count), group).release();
  });
}

// What a simulation holds goes over MPI, which has ended with the session.
void culm_close(culm_simulation* simulation) {
  if (!has_ended) delete simulation;
}

void culm_end(void) {
  guarded(error_without_simulation(), [] {
    has_ended = has_ended || start() != nullptr;
    start().reset();
  });
}

int culm_write_results(culm_simulation* simulation, const char* folder) {
  return with(simulation, [&](culm_simulation& s) {
    require(folder != nullptr, "there is no folder: it is NULL");
    s.simulation.write_results(folder);
  });
}

int culm_close_results(culm_simulation* simulation) {
  return with(simulation, [](culm_simulation& s) { s.simulation.close_results(); });
}

int culm_begin(culm_simulation* simulation, const char* analysis) {
  return with(simulation,
              [&](culm_simulation& s) { s.simulation.begin(analysis == nullptr ? "" : analysis); });
}

int culm_time(culm_simulation* simulation, double* time) {
  return with(simulation, [&](culm_simulation& s) { put(s.stepper().time(), time); });
}

int culm_proposal(culm_simulation* simulation, double* target) {
  return with(simulation, [&](culm_simulation& s) { put(s.stepper().proposal(), target); });
}

int culm_is_at_end(culm_simulation* simulation, int* is_at_end) {
  return with(simulation, [&](culm_simulation& s) {
    put(static_cast<int>(s.stepper().is_at_end()), is_at_end);
  });
}

int culm_final_time(culm_simulation* simulation, double* time) {
  return with(simulation, [&](culm_simulation& s) { put(s.stepper().final_time(), time); });
}

int culm_is_exhausted(culm_simulation* simulation, int* is_exhausted) {
  return with(simulation, [&](culm_simulation& s) {
    put(static_cast<int>(s.stepper().is_exhausted()), is_exhausted);
  });
}

int culm_broken_promises(culm_simulation* simulation, const char** text) {
  return with(simulation, [&](culm_simulation& s) {
    s.broken = s.simulation.broken_promises();
    put(s.broken.c_str(), text);
  });
}

int culm_attempt(culm_simulation* simulation, double target, int* converged) {
  return with(simulation, [&](culm_simulation& s) {
    const bool accepted = s.stepper().attempt(target).accepted;
    if (converged != nullptr) *converged = accepted;
  });
}

int culm_accept(culm_simulation* simulation) {
  return with(simulation, [](culm_simulation& s) { s.stepper().accept(); });
}

int culm_discard(culm_simulation* simulation) {
  return with(simulation, [](culm_simulation& s) { s.stepper().discard(); });
}

int culm_fail(culm_simulation* simulation) {
  return with(simulation, [](culm_simulation& s) { s.stepper().fail(); });
}

int culm_finish(culm_simulation* simulation) {
  return with(simulation, [](culm_simulation& s) { s.stepper().finish(); });
}

int culm_save(culm_simulation* simulation, culm_snapshot** snapshot) {
  return with(simulation, [&](culm_simulation& s) {
    auto saved = std::make_unique<culm_snapshot>(culm_snapshot{&s, s.simulation.taken_up()});
    s.stepper().save(saved->snapshot);
    put(saved.get(), snapshot);
    static_cast<void>(saved.release());
  });
}

int culm_restore(culm_simulation* simulation, const culm_snapshot* snapshot) {
  return with(simulation, [&](culm_simulation& s) {
    require(snapshot != nullptr, "there is no snapshot: it is NULL");
    require(snapshot->owner == &s && snapshot->taken_up == s.simulation.taken_up(),
            "the snapshot belongs to another analysis or simulation");
    s.stepper().restore(snapshot->snapshot);
  });
}

void culm_snapshot_free(culm_snapshot* snapshot) { delete snapshot; }

int culm_set_load(culm_simulation* simulation, const char* load, const double* numbers, int size) {
  return with(simulation, [&](culm_simulation& s) {
    const auto all = values(numbers, size, "there are no loads: the array is NULL");
    s.simulation.set_load(name_of(load), {all.begin(), all.end()});
  });
}

int culm_add_port(culm_simulation* simulation, const char* port, const double* xyz, int points,
                  const char* const* structures, int count, double reach, int smooth) {
  return with(simulation, [&](culm_simulation& s) {
    const auto all = values(xyz, 3 * points, "there are no points: the array is NULL");
    culm::port::Cloud cloud{{all.begin(), all.end()}, texts(structures, count)};
    if (!(reach <= 0.0)) cloud.reach = reach;  // what is no number, too: it is refused
    if (smooth != 0) cloud.weights = culm::port::Weights::smooth;
    s.simulation.add_port(name_of(port), std::move(cloud));
  });
}

int culm_port_count(culm_simulation* simulation, int* count) {
  return with(simulation, [&](culm_simulation& s) {
    put(static_cast<int>(s.simulation.port_names().size()), count);
  });
}

int culm_port_name(culm_simulation* simulation, int number, const char** name) {
  return with(simulation, [&](culm_simulation& s) {
    const std::vector<std::string> names = s.simulation.port_names();
    if (number < 0 || number >= static_cast<int>(names.size())) {
      throw UsageError("there is no port of number " + std::to_string(number) + ", there are " +
                       std::to_string(names.size()));
    }
    s.port_name = names[static_cast<std::size_t>(number)];
    put(s.port_name.c_str(), name);
  });
}

int culm_port_size(culm_simulation* simulation, const char* port, int* points) {
  return with(simulation,
              [&](culm_simulation& s) { put(s.simulation.port(name_of(port)).size(), points); });
}

int culm_port_reference(culm_simulation* simulation, const char* port, double* numbers, int size) {
  return with(simulation, [&](culm_simulation& s) {
    copy(s.simulation.port(name_of(port)).reference(), numbers, size);
  });
}

int culm_port_read(culm_simulation* simulation, const char* port, int quantity, double* numbers,
                   int size) {
  return with(simulation, [&](culm_simulation& s) {
    using culm::port::Quantity;
    constexpr std::array all = {Quantity::position, Quantity::rotation, Quantity::velocity,
                                Quantity::acceleration, Quantity::motion};
    static_assert(
        all[CULM_POSITION] == Quantity::position && all[CULM_ROTATION] == Quantity::rotation &&
        all[CULM_VELOCITY] == Quantity::velocity &&
        all[CULM_ACCELERATION] == Quantity::acceleration && all[CULM_MOTION] == Quantity::motion);
    require(quantity >= 0 && quantity < static_cast<int>(all.size()),
            "there is no such quantity of a port");
    copy(s.simulation.read_port(name_of(port), all[static_cast<std::size_t>(quantity)]), numbers,
         size);
  });
}

int culm_port_set(culm_simulation* simulation, const char* port, const double* forces,
                  const double* moments, int points) {
  return with(simulation, [&](culm_simulation& s) {
    s.simulation.set_port(
        name_of(port), values(forces, 3 * points, "there are no forces: the array is NULL"),
        moments == nullptr ? std::span<const double>() : values(moments, 3 * points, ""));
  });
}

int culm_port_set_pressure(culm_simulation* simulation, const char* port, const int* corners,
                           int faces, const double* pressure, const double* traction) {
  return with(simulation, [&](culm_simulation& s) {
    require(corners != nullptr && faces >= 0, "there are no faces: the array is NULL");
    std::vector<culm::port::Face> all(static_cast<std::size_t>(faces));
    for (auto& face : all) {
      for (int& corner : face) corner = *corners++;
    }
    const auto numbers = [&](const double* given, int each) {
      return given == nullptr ? std::span<const double>() : values(given, each * faces, "");
    };
    s.simulation.set_port_pressure(name_of(port), all, numbers(pressure, 1), numbers(traction, 3));
  });
}

int culm_port_exchange(culm_simulation* simulation, const char* port, double* work, double force[3],
                       double moment[3]) {
  return with(simulation, [&](culm_simulation& s) {
    const culm::port::Exchange sum = s.simulation.exchange(name_of(port));
    if (work != nullptr) *work = sum.work;
    copy(sum.force, force);
    copy(sum.moment, moment);
  });
}

int culm_port_write(culm_simulation* simulation, const char* port, const char* path) {
  return with(simulation,
              [&](culm_simulation& s) { s.simulation.write_port(name_of(port), name_of(path)); });
}
