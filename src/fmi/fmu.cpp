// A deck with ports as an FMU for co-simulation: the functions of FMI 3.0 on top of culm.h. What
// the variables are is written by src/python/culm/export.py.

#include "culm.h"
#include "fmi3.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace {

// Value references: 0 the time, 1 the folder of results, and of port p from 16 (p + 1) on.
constexpr fmi3ValueReference results_reference = 1;
constexpr fmi3ValueReference per_port = 16;
enum Variable { force = 0, moment = 1, reference = 2, first_quantity = 3, work = 8 };
constexpr std::array widths = {3, 9, 6, 6, 6};  // of the quantities, by CULM_POSITION ...

struct Port {
  std::string name;
  int points = 0;
  std::vector<double> reference, force, moment;
  std::array<std::vector<double>, widths.size()> quantities;  // of the last step
  double work = 0.0;                                          // of the loads in it [J]
};

// What goes back with a state.
struct Values {
  double time = 0.0;
  std::vector<Port> ports;
};

struct Instance {
  std::string resources;
  fmi3InstanceEnvironment environment = nullptr;
  fmi3LogMessageCallback log = nullptr;
  std::string results;
  culm_simulation* simulation = nullptr;
  Values now;
  double last = 0.0;  // time at which the deck ends, or its importer wants it to [s]
  bool has_begun = false;
  bool is_ready = false;  // initialized

  fmi3Status say(fmi3Status status, const std::string& text) const {
    if (log != nullptr) log(environment, status, "culm", text.c_str());
    return status;
  }
  // Of a call of culm.
  bool holds(int code) const {
    if (code == CULM_OK) return true;
    say(fmi3Error, culm_error(simulation));
    return false;
  }
};

struct State {
  culm_snapshot* snapshot = nullptr;
  Values values;
  ~State() { culm_snapshot_free(snapshot); }
};

Instance* of(fmi3Instance instance) { return static_cast<Instance*>(instance); }

fmi3Status refuse(fmi3Instance instance, const char* what) {
  if (instance == nullptr) return fmi3Error;
  return of(instance)->say(fmi3Error, std::string(what) + " is nothing that this FMU has");
}

bool open(Instance& it) {
  const std::string deck = it.resources + "/deck.xml";
  if (!it.holds(
          culm_open(CULM_API_VERSION, CULM_WORLD, deck.c_str(), nullptr, 0, &it.simulation))) {
    return false;
  }
  int count = 0;
  if (!it.holds(culm_port_count(it.simulation, &count))) return false;
  it.now = {};
  for (int p = 0; p < count; ++p) {
    Port& port = it.now.ports.emplace_back();
    const char* name = nullptr;
    if (!it.holds(culm_port_name(it.simulation, p, &name))) return false;
    port.name = name;
    if (!it.holds(culm_port_size(it.simulation, name, &port.points))) return false;
    const auto size = static_cast<std::size_t>(port.points);
    port.reference.resize(3 * size);
    port.force.assign(3 * size, 0.0);
    port.moment.assign(3 * size, 0.0);
    for (std::size_t q = 0; q < widths.size(); ++q) {
      port.quantities[q].assign(static_cast<std::size_t>(widths[q]) * size, 0.0);
    }
    if (!it.holds(culm_port_reference(it.simulation, name, port.reference.data(),
                                      static_cast<int>(port.reference.size())))) {
      return false;
    }
  }
  return true;
}

void close(Instance& it) {
  culm_close(it.simulation);
  it.simulation = nullptr;
  it.has_begun = it.is_ready = false;
}

bool read(Instance& it, Port& port, int quantity, std::vector<double>& values) {
  return it.holds(culm_port_read(it.simulation, port.name.c_str(), quantity, values.data(),
                                 static_cast<int>(values.size())));
}

// Of an attempt that converged, or of the start; motion and work of several steps add up.
bool read(Instance& it, bool is_first) {
  for (Port& port : it.now.ports) {
    for (int q = 0; q < static_cast<int>(widths.size()); ++q) {
      std::vector<double>& values = port.quantities[static_cast<std::size_t>(q)];
      if (q != CULM_MOTION || is_first) {
        if (!read(it, port, q, values)) return false;
        continue;
      }
      std::vector<double> more(values.size());
      if (!read(it, port, q, more)) return false;
      for (std::size_t i = 0; i < values.size(); ++i) values[i] += more[i];
    }
    double done = 0.0;
    if (!it.holds(culm_port_exchange(it.simulation, port.name.c_str(), &done, nullptr, nullptr))) {
      return false;
    }
    port.work = is_first ? done : port.work + done;
  }
  return true;
}

// To a time, in as many steps as the deck wants, under loads that stay. @return fmi3Discard if the
// structure does not converge, then somewhere between
fmi3Status go(Instance& it, double end, double step) {
  const double near = 1e-9 * step;
  bool is_first = true;
  while (it.now.time < end - near) {
    double target = 0.0;
    int converged = 0, is_exhausted = 0;
    if (!it.holds(culm_proposal(it.simulation, &target))) return fmi3Error;
    if (target > end - near) target = end;
    if (!it.holds(culm_attempt(it.simulation, target, &converged))) return fmi3Error;
    if (converged == 0) {
      if (!it.holds(culm_fail(it.simulation)) ||
          !it.holds(culm_is_exhausted(it.simulation, &is_exhausted))) {
        return fmi3Error;
      }
      if (is_exhausted != 0) return fmi3Discard;
      continue;
    }
    if (!read(it, is_first) || !it.holds(culm_accept(it.simulation)) ||
        !it.holds(culm_time(it.simulation, &it.now.time))) {
      return fmi3Error;
    }
    is_first = false;
  }
  return fmi3OK;
}

// The numbers of a variable; null for none.
std::vector<double>* find(Instance& it, fmi3ValueReference variable) {
  if (variable < per_port || variable / per_port > it.now.ports.size()) return nullptr;
  Port& port = it.now.ports[variable / per_port - 1];
  const fmi3ValueReference which = variable % per_port;
  if (which == force) return &port.force;
  if (which == moment) return &port.moment;
  if (which == reference) return &port.reference;
  if (which < work) return &port.quantities[which - first_quantity];
  return nullptr;
}

// A number that stands alone; null for none.
const double* find_scalar(const Instance& it, fmi3ValueReference variable) {
  if (variable == 0) return &it.now.time;
  if (variable < per_port || variable / per_port > it.now.ports.size()) return nullptr;
  return variable % per_port == work ? &it.now.ports[variable / per_port - 1].work : nullptr;
}

fmi3Status unknown(const Instance& it, fmi3ValueReference variable, const char* verb) {
  return it.say(fmi3Error,
                "there is no variable of reference " + std::to_string(variable) + " to " + verb);
}

fmi3Status wrong_size(const Instance& it, std::size_t size) {
  return it.say(fmi3Error, std::to_string(size) + " values are not as many as the variables have");
}

}  // namespace

const char* fmi3GetVersion(void) { return "3.0"; }

fmi3Status fmi3SetDebugLogging(fmi3Instance, fmi3Boolean, size_t, const fmi3String[]) {
  return fmi3OK;  // what goes wrong is always said
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String, fmi3String, fmi3String, fmi3Boolean,
                                          fmi3Boolean, fmi3InstanceEnvironment environment,
                                          fmi3LogMessageCallback log) {
  if (log != nullptr) log(environment, fmi3Error, "culm", "this FMU is for co-simulation");
  return nullptr;
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String, fmi3String, fmi3String, fmi3Boolean,
                                               fmi3Boolean, fmi3InstanceEnvironment environment,
                                               fmi3LogMessageCallback log, fmi3ClockUpdateCallback,
                                               fmi3LockPreemptionCallback,
                                               fmi3UnlockPreemptionCallback) {
  if (log != nullptr) log(environment, fmi3Error, "culm", "this FMU is for co-simulation");
  return nullptr;
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String, fmi3String, fmi3String resources, fmi3Boolean,
                                         fmi3Boolean, fmi3Boolean, fmi3Boolean,
                                         const fmi3ValueReference[], size_t,
                                         fmi3InstanceEnvironment environment,
                                         fmi3LogMessageCallback log,
                                         fmi3IntermediateUpdateCallback) {
  auto it = std::make_unique<Instance>();
  it->environment = environment;
  it->log = log;
  if (resources == nullptr) {
    it->say(fmi3Error, "there is no path to the resources");
    return nullptr;
  }
  it->resources = resources;
  if (!open(*it)) {
    close(*it);
    return nullptr;
  }
  return it.release();
}

void fmi3FreeInstance(fmi3Instance instance) {
  if (instance == nullptr) return;
  close(*of(instance));
  delete of(instance);
}

// Times are those of the deck.
fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean, fmi3Float64,
                                       fmi3Float64 start, fmi3Boolean has_stop, fmi3Float64 stop) {
  Instance& it = *of(instance);
  if (!it.results.empty() && !it.holds(culm_write_results(it.simulation, it.results.c_str()))) {
    return fmi3Error;
  }
  if (!it.holds(culm_begin(it.simulation, nullptr)) ||
      !it.holds(culm_time(it.simulation, &it.now.time)) ||
      !it.holds(culm_final_time(it.simulation, &it.last))) {
    return fmi3Error;
  }
  it.has_begun = true;
  const double near = 1e-9 * std::max(std::abs(it.last), std::abs(it.last - it.now.time));
  if (std::abs(start - it.now.time) > near) {
    return it.say(fmi3Error, "it shall start at " + std::to_string(start) +
                                 " s, and its deck does at " + std::to_string(it.now.time) + " s");
  }
  if (has_stop && stop > it.last + near) {
    return it.say(fmi3Error, "it shall stop at " + std::to_string(stop) +
                                 " s, and its deck ends at " + std::to_string(it.last) + " s");
  }
  if (has_stop) it.last = stop;
  it.is_ready = read(it, true);
  return it.is_ready ? fmi3OK : fmi3Error;
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance) {
  const Instance& it = *of(instance);
  return it.is_ready ? fmi3OK : it.say(fmi3Error, "the initialization has failed");
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 time, fmi3Float64 step, fmi3Boolean,
                      fmi3Boolean* event, fmi3Boolean* terminate, fmi3Boolean* early,
                      fmi3Float64* last_time) {
  Instance& it = *of(instance);
  if (event != nullptr) *event = false;
  if (terminate != nullptr) *terminate = false;
  if (early != nullptr) *early = false;
  if (last_time != nullptr) *last_time = it.now.time;
  if (!it.is_ready) return it.say(fmi3Error, "a step comes after the initialization");
  if (!(step > 0.0) || !std::isfinite(step) ||
      std::abs(time - it.now.time) > 1e-9 * std::max(step, std::abs(time))) {
    return it.say(fmi3Error, "a step of " + std::to_string(step) + " s from " +
                                 std::to_string(time) + " s: the structure is at " +
                                 std::to_string(it.now.time) + " s");
  }
  if (time + step > it.last + 1e-9 * std::max(step, std::abs(it.last))) {
    return it.say(fmi3Error, "a step to " + std::to_string(time + step) + " s: it ends at " +
                                 std::to_string(it.last) + " s");
  }
  for (const Port& port : it.now.ports) {
    if (!it.holds(culm_port_set(it.simulation, port.name.c_str(), port.force.data(),
                                port.moment.data(), port.points))) {
      return fmi3Error;
    }
  }
  State start;
  if (!it.holds(culm_save(it.simulation, &start.snapshot))) return fmi3Error;
  start.values = it.now;
  const fmi3Status status = go(it, it.now.time + step, step);
  if (status == fmi3OK) {
    if (last_time != nullptr) *last_time = it.now.time;
    return status;
  }
  it.holds(culm_restore(it.simulation, start.snapshot));
  it.now = start.values;
  if (status != fmi3Discard) return status;
  return it.say(fmi3Discard, "the structure does not converge with these loads in this step");
}

fmi3Status fmi3Terminate(fmi3Instance instance) {
  Instance& it = *of(instance);
  if (!it.has_begun) return fmi3OK;
  const char* broken = nullptr;
  if (!it.holds(culm_finish(it.simulation)) ||
      !it.holds(culm_broken_promises(it.simulation, &broken))) {
    return fmi3Error;
  }
  const std::string promises = broken;
  it.has_begun = it.is_ready = false;
  if (!it.results.empty() && !it.holds(culm_close_results(it.simulation))) return fmi3Error;
  return promises.empty() ? fmi3OK : it.say(fmi3Warning, promises);
}

fmi3Status fmi3Reset(fmi3Instance instance) {
  Instance& it = *of(instance);
  close(it);
  it.results.clear();
  return open(it) ? fmi3OK : fmi3Error;
}

fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference variables[], size_t n,
                          fmi3Float64 values[], size_t size) {
  Instance& it = *of(instance);
  std::size_t place = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double* first = find_scalar(it, variables[i]);
    std::size_t count = 1;
    if (const std::vector<double>* all = find(it, variables[i])) {
      first = all->data();
      count = all->size();
    }
    if (first == nullptr) return unknown(it, variables[i], "get");
    if (place + count > size) return wrong_size(it, size);
    std::copy(first, first + count, values + place);
    place += count;
  }
  return place == size ? fmi3OK : wrong_size(it, size);
}

fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference variables[], size_t n,
                          const fmi3Float64 values[], size_t size) {
  Instance& it = *of(instance);
  std::size_t place = 0;
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<double>* to = variables[i] % per_port <= moment ? find(it, variables[i]) : nullptr;
    if (to == nullptr) return unknown(it, variables[i], "set");
    if (place + to->size() > size) return wrong_size(it, size);
    std::copy(values + place, values + place + to->size(), to->begin());
    place += to->size();
  }
  return place == size ? fmi3OK : wrong_size(it, size);
}

fmi3Status fmi3GetString(fmi3Instance instance, const fmi3ValueReference variables[], size_t n,
                         fmi3String values[], size_t size) {
  Instance& it = *of(instance);
  if (n != size) return wrong_size(it, size);
  for (std::size_t i = 0; i < n; ++i) {
    if (variables[i] != results_reference) return unknown(it, variables[i], "get");
    values[i] = it.results.c_str();
  }
  return fmi3OK;
}

fmi3Status fmi3SetString(fmi3Instance instance, const fmi3ValueReference variables[], size_t n,
                         const fmi3String values[], size_t size) {
  Instance& it = *of(instance);
  if (n != size) return wrong_size(it, size);
  for (std::size_t i = 0; i < n; ++i) {
    if (variables[i] != results_reference || it.has_begun) return unknown(it, variables[i], "set");
    it.results = values[i];
  }
  return fmi3OK;
}

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState* state) {
  Instance& it = *of(instance);
  auto kept = std::make_unique<State>();
  if (!it.holds(culm_save(it.simulation, &kept->snapshot))) return fmi3Error;
  kept->values = it.now;
  delete static_cast<State*>(*state);
  *state = kept.release();
  return fmi3OK;
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState state) {
  Instance& it = *of(instance);
  if (state == nullptr) return it.say(fmi3Error, "there is no state to go back to");
  const State& kept = *static_cast<State*>(state);
  if (!it.holds(culm_restore(it.simulation, kept.snapshot))) return fmi3Error;
  it.now = kept.values;
  return fmi3OK;
}

fmi3Status fmi3FreeFMUState(fmi3Instance, fmi3FMUState* state) {
  if (state == nullptr) return fmi3OK;
  delete static_cast<State*>(*state);
  *state = nullptr;
  return fmi3OK;
}

fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance instance, fmi3ValueReference, size_t*) {
  return refuse(instance, "a list of dependencies");
}

fmi3Status fmi3EnterStepMode(fmi3Instance) { return fmi3OK; }

// What co-simulation must have and this FMU does not say that it can.
#define REFUSE(function, what, ...) \
  fmi3Status function(fmi3Instance instance, ##__VA_ARGS__) { return refuse(instance, what); }
#define REFUSE_VALUES(Type)                                                              \
  REFUSE(fmi3Get##Type, #Type, const fmi3ValueReference[], size_t, fmi3##Type[], size_t) \
  REFUSE(fmi3Set##Type, #Type, const fmi3ValueReference[], size_t, const fmi3##Type[], size_t)
REFUSE_VALUES(Float32)
REFUSE_VALUES(Int8)
REFUSE_VALUES(UInt8)
REFUSE_VALUES(Int16)
REFUSE_VALUES(UInt16)
REFUSE_VALUES(Int32)
REFUSE_VALUES(UInt32)
REFUSE_VALUES(Int64)
REFUSE_VALUES(UInt64)
REFUSE_VALUES(Boolean)
REFUSE(fmi3GetBinary, "Binary", const fmi3ValueReference[], size_t, size_t[], fmi3Binary[], size_t)
REFUSE(fmi3SetBinary, "Binary", const fmi3ValueReference[], size_t, const size_t[],
       const fmi3Binary[], size_t)
REFUSE(fmi3GetClock, "Clock", const fmi3ValueReference[], size_t, fmi3Clock[])
REFUSE(fmi3SetClock, "Clock", const fmi3ValueReference[], size_t, const fmi3Clock[])
REFUSE(fmi3EnterEventMode, "an event")
REFUSE(fmi3GetVariableDependencies, "a list of dependencies", fmi3ValueReference, size_t[],
       fmi3ValueReference[], size_t[], fmi3DependencyKind[], size_t)
REFUSE(fmi3SerializedFMUStateSize, "a state in bytes", fmi3FMUState, size_t*)
REFUSE(fmi3SerializeFMUState, "a state in bytes", fmi3FMUState, fmi3Byte[], size_t)
REFUSE(fmi3DeserializeFMUState, "a state in bytes", const fmi3Byte[], size_t, fmi3FMUState*)
REFUSE(fmi3GetDirectionalDerivative, "a derivative", const fmi3ValueReference[], size_t,
       const fmi3ValueReference[], size_t, const fmi3Float64[], size_t, fmi3Float64[], size_t)
REFUSE(fmi3GetAdjointDerivative, "a derivative", const fmi3ValueReference[], size_t,
       const fmi3ValueReference[], size_t, const fmi3Float64[], size_t, fmi3Float64[], size_t)
REFUSE(fmi3EnterConfigurationMode, "a configuration")
REFUSE(fmi3ExitConfigurationMode, "a configuration")
REFUSE(fmi3GetIntervalDecimal, "a clock", const fmi3ValueReference[], size_t, fmi3Float64[],
       fmi3IntervalQualifier[])
REFUSE(fmi3GetIntervalFraction, "a clock", const fmi3ValueReference[], size_t, fmi3UInt64[],
       fmi3UInt64[], fmi3IntervalQualifier[])
REFUSE(fmi3GetShiftDecimal, "a clock", const fmi3ValueReference[], size_t, fmi3Float64[])
REFUSE(fmi3GetShiftFraction, "a clock", const fmi3ValueReference[], size_t, fmi3UInt64[],
       fmi3UInt64[])
REFUSE(fmi3SetIntervalDecimal, "a clock", const fmi3ValueReference[], size_t, const fmi3Float64[])
REFUSE(fmi3SetIntervalFraction, "a clock", const fmi3ValueReference[], size_t, const fmi3UInt64[],
       const fmi3UInt64[])
REFUSE(fmi3SetShiftDecimal, "a clock", const fmi3ValueReference[], size_t, const fmi3Float64[])
REFUSE(fmi3SetShiftFraction, "a clock", const fmi3ValueReference[], size_t, const fmi3UInt64[],
       const fmi3UInt64[])
REFUSE(fmi3EvaluateDiscreteStates, "a discrete state")
REFUSE(fmi3UpdateDiscreteStates, "a discrete state", fmi3Boolean*, fmi3Boolean*, fmi3Boolean*,
       fmi3Boolean*, fmi3Boolean*, fmi3Float64*)
REFUSE(fmi3EnterContinuousTimeMode, "model exchange")
REFUSE(fmi3CompletedIntegratorStep, "model exchange", fmi3Boolean, fmi3Boolean*, fmi3Boolean*)
REFUSE(fmi3SetTime, "model exchange", fmi3Float64)
REFUSE(fmi3SetContinuousStates, "model exchange", const fmi3Float64[], size_t)
REFUSE(fmi3GetContinuousStateDerivatives, "model exchange", fmi3Float64[], size_t)
REFUSE(fmi3GetEventIndicators, "model exchange", fmi3Float64[], size_t)
REFUSE(fmi3GetContinuousStates, "model exchange", fmi3Float64[], size_t)
REFUSE(fmi3GetNominalsOfContinuousStates, "model exchange", fmi3Float64[], size_t)
REFUSE(fmi3GetNumberOfEventIndicators, "model exchange", size_t*)
REFUSE(fmi3GetNumberOfContinuousStates, "model exchange", size_t*)
REFUSE(fmi3ActivateModelPartition, "scheduled execution", fmi3ValueReference, fmi3Float64)
REFUSE(fmi3GetOutputDerivatives, "a derivative", const fmi3ValueReference[], size_t,
       const fmi3Int32[], fmi3Float64[], size_t)
