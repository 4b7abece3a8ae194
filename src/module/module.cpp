// The Python module _culm: simulations in the hands of a Python program. What users import is the
// package `culm`, which adds what is easier to write in Python.

#include <culm/base/absent.hpp>
#include <culm/base/error.hpp>
#include <culm/simulation/session.hpp>
#include <culm/simulation/simulation.hpp>
#include <culm/solver/newton_solver.hpp>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace py = pybind11;

namespace {

using culm::Snapshot;
using culm::analysis::Stepper;
using culm::port::Quantity;
using culm::simulation::Simulation;

// MPI and Trilinos, from the import of the module to the end of Python.
class Start {
 public:
  Start() : session_(count_, values_) {}

 private:
  std::array<char, 7> name_{"python"};
  std::array<char*, 2> arguments_{name_.data(), nullptr};
  int count_ = 1;
  char** values_ = arguments_.data();
  culm::simulation::Session session_;
};

// What the module keeps until Python ends, and each simulation as long as it lives.
std::shared_ptr<Start>& start() {
  static std::shared_ptr<Start> kept;
  return kept;
}

// Keeps what culm says, and makes of each alarm a warning of Python at once.
class Ear final : public std::stringbuf {
 public:
  // What was heard since the last call.
  std::string take() {
    std::string text = str();
    str({});
    told_ = 0;
    return text;
  }

 private:
  // Once for each message.
  int sync() override {
    const std::string text = str();
    const std::string message = text.substr(told_, text.find_last_not_of('\n') + 1 - told_);
    told_ = text.size();
    if (!message.starts_with("warning: ") && !message.starts_with("error: ")) return 0;
    const py::gil_scoped_acquire held;
    const std::string words = message.substr(message.find(' ') + 1);
    // where warnings are errors of Python: it is not allowed to throw through a log
    if (PyErr_WarnEx(PyExc_UserWarning, words.c_str(), 1) != 0) PyErr_WriteUnraisable(nullptr);
    return 0;
  }

  std::size_t told_ = 0;
};

// Who solves. The interpreter is free then, and another thread that came in would find or change
// what is half done.
class Busy {
 public:
  explicit Busy(std::atomic<bool>& solves) : solves_(solves) {
    if (solves_.exchange(true)) refuse();
  }
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;
  ~Busy() { solves_ = false; }

  [[noreturn]] static void refuse() {
    throw culm::UsageError("another thread is in this simulation: one at a time may be");
  }

 private:
  std::atomic<bool>& solves_;
};

// Lets Ctrl-C end a run between two steps; the last accepted one stays.
class Interruptible final : public culm::analysis::Observer {
 public:
  void step(const culm::analysis::StepReport&, culm::model::State&) override {
    const py::gil_scoped_acquire held;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
};

// A simulation and what it says.
class Live {
 public:
  Live(const std::string& deck, std::vector<std::string> overrides)
      : start_(start()),
        simulation_(
            Simulation::open(deck, std::move(overrides), culm::Log(said_, culm::LogLevel::info))) {}

  // What was said since the last call.
  std::string messages() {
    refuse_if_busy();
    return ear_.take();
  }

  // Tries a step. Why it failed is known until the next one.
  bool attempt(Stepper& stepper, double target) {
    const Busy busy(solves_);
    failure_.clear();
    const double from = stepper.time();
    const culm::analysis::StepReport& report = stepper.attempt(target);
    if (report.accepted) return true;
    std::ostringstream text;
    text << culm::solver::describe(report.outcome.end) << ", from " << from << " to " << target
         << ", after " << report.outcome.iterations << " iterations; relative force residuals:";
    for (const auto& record : report.outcome.history) text << ' ' << record.force;
    failure_ = text.str();
    return false;
  }
  const std::string& failure() const { return failure_; }
  Simulation& simulation() {
    refuse_if_busy();
    return simulation_;
  }
  std::atomic<bool>& solves() { return solves_; }
  void refuse_if_busy() const {
    if (solves_) Busy::refuse();
  }

  void begin(const std::string& analysis) {
    const Busy busy(solves_);
    simulation_.begin(analysis);
  }
  std::string close_results() {
    refuse_if_busy();
    return simulation_.close_results();
  }
  long taken_up() const { return simulation_.taken_up(); }
  Stepper* stepper() { return simulation_.stepper(); }

 private:
  std::shared_ptr<Start> start_;  // the last to go
  Ear ear_;
  std::ostream said_{&ear_};
  Simulation simulation_;
  std::string failure_;
  std::atomic<bool> solves_ = false;
};

// The stepper of an analysis, as long as it is taken up.
class Handle {
 public:
  explicit Handle(Live& live) : live_(live), number_(live.taken_up()) {}

  Stepper& get() const {
    if (live_.taken_up() != number_ || live_.stepper() == nullptr) {
      throw culm::UsageError("this analysis has ended");
    }
    return *live_.stepper();
  }
  Stepper* operator->() const { return &get(); }
  // For what changes the state.
  Stepper& take() const {
    live_.refuse_if_busy();
    return get();
  }
  Live& live() const { return live_; }
  bool is_of(const Handle& other) const {
    return &live_ == &other.live_ && number_ == other.number_;
  }

 private:
  Live& live_;
  long number_;
};

// What a stepper saved, and which one.
struct Saved {
  Handle stepper;
  Snapshot snapshot = Snapshot(Snapshot::Use::memory);
};

// A copy of coordinates, x and the three directors of each node.
py::array copy(std::span<const double> coordinates) {
  const auto nodes = static_cast<py::ssize_t>(coordinates.size() / 12);
  return py::array_t<double>({nodes, py::ssize_t{4}, py::ssize_t{3}}, coordinates.data());
}

using Values = py::array_t<double, py::array::c_style | py::array::forcecast>;

// A shape as Python writes it.
std::string shape_of(const py::array& values) {
  return py::str(py::object(values.attr("shape"))).cast<std::string>();
}

// An array as it comes. What lies under a mask was hidden on purpose, and numpy would take it.
py::array array_of(const py::object& given, const std::string& what) {
  // only what has a mask is looked at by numpy.ma, which takes longer than all else here
  if (py::hasattr(given, "_mask") &&
      py::module_::import("numpy.ma").attr("is_masked")(given).cast<bool>()) {
    throw culm::UsageError(what + " has masked values: say what stands there, as with filled(0.0)");
  }
  py::array array = py::array::ensure(given);
  if (!array) throw culm::UsageError(what + " must be an array of numbers");
  return array;
}

// Its numbers, of any stride, order and type that is real.
Values numbers_of(const py::object& given, const std::string& what) {
  const py::array array = array_of(given, what);
  const bool is_real = std::string_view("biufO").find(array.dtype().kind()) != std::string::npos;
  Values numbers = is_real ? Values::ensure(array) : Values();
  if (!is_real || !numbers) {
    const std::string type = py::str(py::object(array.dtype())).cast<std::string>();
    throw culm::UsageError(what + " must be an array of real numbers, and is one of " + type);
  }
  return numbers;
}

// Whether values stand in the order of items: flat, or in a row for each item, which may be cut in
// force and moment. Others, as those of a transposed array, are as many and mean something else.
bool stand_in_order(const py::array& values, py::ssize_t items) {
  const auto proper = [](std::vector<py::ssize_t> shape) {
    std::erase(shape, 1);
    return shape;
  };
  const auto shape = proper({values.shape(), values.shape() + values.ndim()});
  return shape.size() < 2 || shape == proper({items, 6}) || shape == proper({items, 2, 3});
}

void set_load(Live& live, const std::string& name, const py::object& given) {
  const Values values = numbers_of(given, "load '" + name + "'");
  const py::ssize_t nodes = values.size() / 6;
  if (values.size() == 6 * nodes && !stand_in_order(values, nodes)) {
    throw culm::UsageError("load '" + name + "' takes values of the shape (" +
                           std::to_string(nodes) + ", 6), force and moment of each node, got " +
                           shape_of(values));
  }
  live.simulation().set_load(name, {values.data(), values.data() + values.size()});
}

// A port of a simulation; found by name, for the model changes from analysis to analysis.
class PortHandle {
 public:
  PortHandle(Live& live, std::string name) : live_(live), name_(std::move(name)) { get(); }

  const culm::port::Port& get() const { return live_.simulation().port(name_); }
  Simulation& simulation() const { return live_.simulation(); }
  const std::string& name() const { return name_; }
  Live& live() const { return live_; }

 private:
  Live& live_;
  std::string name_;
};

// Numbers of points as an array of one row per point.
py::array rows_of(const std::vector<double>& values, int points) {
  const auto rows = static_cast<py::ssize_t>(points);
  const auto columns = static_cast<py::ssize_t>(values.size()) / rows;
  if (columns == 9)
    return py::array_t<double>({rows, py::ssize_t{3}, py::ssize_t{3}}, values.data());
  return py::array_t<double>({rows, columns}, values.data());
}

py::array read(const PortHandle& port, Quantity quantity) {
  std::vector<double> values;
  {
    Simulation& simulation = port.simulation();
    const py::gil_scoped_release free;  // other ranks and threads may have to come
    const Busy busy(port.live().solves());
    values = simulation.read_port(port.name(), quantity);
  }
  return rows_of(values, port.get().size());
}

// The numbers of an array with three columns.
std::span<const double> three_columns(const Values& values, const std::string& what,
                                      std::optional<int> rows = {}) {
  const bool has_rows = values.ndim() == 2 && (!rows || values.shape(0) == *rows);
  if (!has_rows || values.shape(1) != 3) {
    throw culm::UsageError(what + " must have the shape (" +
                           (rows ? std::to_string(*rows) : "points") + ", 3), and has " +
                           shape_of(values));
  }
  return {values.data(), static_cast<std::size_t>(values.size())};
}

void set_port(const PortHandle& port, const py::object& force, const py::object& moment) {
  const int points = port.get().size();
  const Values forces = numbers_of(force, "force");
  const Values moments = moment.is_none() ? Values() : numbers_of(moment, "moment");
  port.simulation().set_port(
      port.name(), three_columns(forces, "force", points),
      moment.is_none() ? std::span<const double>() : three_columns(moments, "moment", points));
}

using Whole = py::array_t<long long, py::array::c_style | py::array::forcecast>;

// The numbers of points, which a fraction would be cut down to.
Whole whole_numbers_of(const py::object& given, const std::string& what) {
  const py::array array = array_of(given, what);
  const Whole numbers = Whole::ensure(array);
  const py::module_ numpy = py::module_::import("numpy");
  if (!numbers || !numpy.attr("array_equal")(array, numbers).cast<bool>()) {
    throw culm::UsageError(what + " must be whole numbers");
  }
  return numbers;
}

// Faces of three or four points, an array with as many columns.
std::vector<culm::port::Face> faces_of(const Whole& corners) {
  if (corners.ndim() != 2 || (corners.shape(1) != 3 && corners.shape(1) != 4)) {
    throw culm::UsageError("faces must have the shape (faces, 3) or (faces, 4), and has " +
                           shape_of(corners));
  }
  constexpr long long most = std::numeric_limits<int>::max();
  std::vector<culm::port::Face> faces;
  for (py::ssize_t i = 0; i < corners.shape(0); ++i) {
    culm::port::Face& face = faces.emplace_back();
    face[3] = -1;
    for (py::ssize_t a = 0; a < corners.shape(1); ++a) {
      face[static_cast<std::size_t>(a)] =
          static_cast<int>(std::clamp(corners.at(i, a), -most, most));
    }
  }
  return faces;
}

void set_pressure(const PortHandle& port, const py::object& faces, const py::object& pressure,
                  const py::object& traction) {
  const Values pressures = numbers_of(pressure, "pressure");
  const Values tractions = traction.is_none() ? Values() : numbers_of(traction, "traction");
  if (pressures.ndim() != 1) {
    throw culm::UsageError("pressure must have the shape (faces,), and has " + shape_of(pressures));
  }
  port.simulation().set_port_pressure(
      port.name(), faces_of(whole_numbers_of(faces, "faces")),
      {pressures.data(), static_cast<std::size_t>(pressures.size())},
      traction.is_none() ? std::span<const double>() : three_columns(tractions, "traction"));
}

void add_port(Live& live, const std::string& name, const py::object& points,
              const std::vector<std::string>& structures, double reach, bool smooth) {
  const Values given = numbers_of(points, "points");
  const std::span<const double> numbers = three_columns(given, "points");
  const auto weights = smooth ? culm::port::Weights::smooth : culm::port::Weights::elements;
  live.simulation().add_port(name, {{numbers.begin(), numbers.end()}, structures, reach, weights});
}

py::dict exchange(const PortHandle& port) {
  const culm::port::Exchange sum = port.simulation().exchange(port.name());
  py::dict numbers;
  numbers["work"] = sum.work;
  numbers["force"] = py::array_t<double>(3, sum.force.data());
  numbers["moment"] = py::array_t<double>(3, sum.moment.data());
  numbers["not_carried"] = sum.not_carried;
  return numbers;
}

py::dict quantities(Live& live) {
  py::dict all;
  const std::vector<double> numbers = live.simulation().quantities();
  std::size_t i = 0;
  for (const culm::output::HistoryColumn& column : live.simulation().quantity_columns()) {
    const std::string unit = column.unit.empty() ? "" : " [" + column.unit + "]";
    const double number = numbers[i++];
    all[py::str(column.name + unit)] =
        number == culm::absent ? std::numeric_limits<double>::quiet_NaN() : number;
  }
  return all;
}

py::dict finish(const Handle& stepper) {
  py::dict numbers;
  for (const auto& [name, value] : stepper.take().finish().numbers) numbers[py::str(name)] = value;
  return numbers;
}

void register_errors(py::module_& module) {
  const auto base = py::register_exception<culm::Error>(module, "Error");
  py::register_exception<culm::UsageError>(module, "UsageError", base);
  py::register_exception<culm::InputError>(module, "InputError", base);
  py::register_exception<culm::NumericalError>(module, "NumericalError", base);
  py::register_exception<culm::NonFiniteError>(module, "NonFiniteError", base);
  py::register_exception<culm::FileError>(module, "FileError", base);
}

}  // namespace

PYBIND11_MODULE(_culm, module) {
  using Free = py::call_guard<py::gil_scoped_release>;
  start() = std::make_shared<Start>();
  // before MPI's own library goes
  py::module_::import("atexit").attr("register")(py::cpp_function([] { start().reset(); }));
  register_errors(module);

  py::class_<Saved>(module, "Snapshot", "What Stepper.save keeps for Stepper.restore.");

  py::class_<Handle>(module, "Stepper", "Makes the steps of an analysis.")
      .def(
          "attempt",
          [](const Handle& stepper, std::optional<double> target) {
            return stepper.live().attempt(stepper.get(), target.value_or(stepper->proposal()));
          },
          py::arg("target") = py::none(), Free(),
          "Solves a step from the accepted state to a target, the proposed one if none is given. "
          "Returns whether it converged; `failure` says why it did not.")
      .def_property_readonly(
          "failure", [](const Handle& stepper) { return stepper.live().failure(); },
          "Why the last attempt did not converge, in words; empty if it did.")
      .def(
          "accept",
          [](const Handle& stepper) {
            Stepper& taken = stepper.get();
            const Busy busy(stepper.live().solves());
            taken.accept();
          },
          Free(), "Makes the attempt the accepted state.")
      .def(
          "discard", [](const Handle& stepper) { stepper.take().discard(); },
          "Goes back as if the attempt had not been made.")
      .def(
          "fail", [](const Handle& stepper) { stepper.take().fail(); },
          "Goes back; the next proposal is nearer.")
      .def(
          "run",
          [](const Handle& stepper) {
            Stepper& taken = stepper.get();
            const Busy busy(stepper.live().solves());
            Interruptible observer;
            culm::analysis::run(taken, observer);
          },
          Free(), "Makes all steps to the end.")
      .def("finish", &finish, "Ends the analysis; returns the numbers of its report.")
      .def(
          "save",
          [](const Handle& stepper) {
            auto saved = std::make_unique<Saved>(Saved{stepper});
            stepper.take().save(saved->snapshot);
            return saved;
          },
          "The accepted state and all that the next step needs.")
      .def(
          "restore",
          [](const Handle& stepper, const Saved& saved) {
            if (!saved.stepper.is_of(stepper)) {
              throw culm::UsageError("the snapshot belongs to another analysis or simulation");
            }
            stepper.take().restore(saved.snapshot);
          },
          py::arg("snapshot"), "Goes back to what save returned.")
      .def_property_readonly(
          "proposal", [](const Handle& stepper) { return stepper->proposal(); },
          "Where the next step should go.")
      .def_property_readonly(
          "time", [](const Handle& stepper) { return stepper->time(); },
          "Time [s] or level of the accepted state.")
      .def_property_readonly(
          "final_time", [](const Handle& stepper) { return stepper->final_time(); },
          "Where the last step ends: a time [s] or level; infinite where nobody knows.")
      .def_property_readonly(
          "steps", [](const Handle& stepper) { return stepper->steps(); }, "Accepted steps so far.")
      .def_property_readonly("is_at_end",
                             [](const Handle& stepper) { return stepper->is_at_end(); })
      .def_property_readonly(
          "is_exhausted", [](const Handle& stepper) { return stepper->is_exhausted(); },
          "Whether nothing nearer than the last failure may be tried.");

  const auto column = [](Quantity quantity) {
    return [quantity](const PortHandle& port) { return read(port, quantity); };
  };
  py::class_<PortHandle>(module, "Port",
                         "Points of structures at which a program sees motion and sets loads. "
                         "Arrays are copies with one row per point.")
      .def_property_readonly("name", &PortHandle::name)
      .def("__len__", [](const PortHandle& port) { return port.get().size(); })
      .def_property_readonly(
          "reference",
          [](const PortHandle& port) { return rows_of(port.get().reference(), port.get().size()); },
          "Positions in the reference, shape (points, 3) [m].")
      .def_property_readonly("position", column(Quantity::position),
                             "Positions, shape (points, 3) [m].")
      .def_property_readonly("rotation", column(Quantity::rotation),
                             "Rotations against the reference, shape (points, 3, 3).")
      .def_property_readonly("velocity", column(Quantity::velocity),
                             "Velocities and angular velocities, shape (points, 6) [m/s, rad/s].")
      .def_property_readonly("acceleration", column(Quantity::acceleration),
                             "Their mean accelerations in the open step, shape (points, 6) "
                             "[m/s^2, rad/s^2].")
      .def_property_readonly("motion", column(Quantity::motion),
                             "Motion in the open step and rotation vector 2 tan(angle / 2), what "
                             "loads work on, shape (points, 6) [m, rad].")
      .def("set", &set_port, py::arg("force"), py::arg("moment") = py::none(),
           "Sets forces [N] and moments [N m] of all attempts from now on, shape (points, 3), in "
           "space: in dynamics means over the step. Without moments these are zero.")
      .def(
          "set_pressure", &set_pressure, py::arg("faces"), py::arg("pressure"),
          py::arg("traction") = py::none(),
          "Sets forces from pressure [Pa], shape (faces,), and traction [Pa], shape (faces, 3), on "
          "faces between the points, shape (faces, 3) or (faces, 4), anticlockwise seen from "
          "outside; mean over the step that is open.")
      .def("exchange", &exchange,
           "What the loads do in the open step: work [J], resultant force [N], moment about the "
           "origin [N m] and what of moments no director of a shell takes [N m].")
      .def(
          "write",
          [](const PortHandle& port, const std::string& path) {
            port.simulation().write_port(port.name(), path);
          },
          py::arg("path"), "Draws the points in the reference, as a VTU file.");

  py::class_<Live>(module, "Simulation", "A deck whose steps the caller makes.")
      .def(py::init<const std::string&, std::vector<std::string>>(), py::arg("deck"),
           py::arg("overrides") = std::vector<std::string>{},
           "Builds the model of a deck. Overrides are such as 'Structures/beam/Curve/Elements=32'.")
      .def(
          "write_results",
          [](Live& live, const std::string& folder) { live.simulation().write_results(folder); },
          py::arg("folder"),
          "Writes results of each step when it is accepted, as culm run does; cut back by restore. "
          "Before the first begin.")
      .def("close_results", &Live::close_results,
           "Ends the analysis and the files, with a report; returns what culm run says at its end.")
      .def(
          "begin",
          [](Live& live, const std::string& analysis) {
            live.begin(analysis);
            return Handle(live);
          },
          py::arg("analysis") = "", py::keep_alive<0, 1>(), Free(),
          "Takes up an analysis that makes steps, the first one if no name is given.")
      .def("set_load", &set_load, py::arg("name"), py::arg("values"),
           "Sets a load of type 'External': force [N] and moment [N m] of each node.")
      .def("add_port", &add_port, py::arg("name"), py::arg("points"),
           py::arg("structures") = std::vector<std::string>{},
           py::arg("reach") = std::numeric_limits<double>::infinity(), py::arg("smooth") = false,
           "Attaches points, shape (points, 3) [m] in the reference, to the nearest of some "
           "structures, all if none are named; before the first begin.")
      .def(
          "port", [](Live& live, const std::string& name) { return PortHandle(live, name); },
          py::arg("name"), py::keep_alive<0, 1>(), "A port of the deck, or one that was added.")
      .def_property_readonly(
          "ports", [](Live& live) { return live.simulation().port_names(); },
          "The names of all ports.")
      .def(
          "set_signal",
          [](Live& live, const std::string& name, double value) {
            live.simulation().set_signal(name, value);
          },
          py::arg("name"), py::arg("value"), "Sets a signal of type 'External'.")
      .def(
          "nodes",
          [](Live& live, const std::string& name) { return live.simulation().nodes(name); },
          py::arg("name"), "Numbers of the nodes of a name.")
      .def_property_readonly(
          "coordinates", [](Live& live) { return copy(live.simulation().state().next); },
          "A copy of position and directors of all nodes, shape (nodes, 4, 3) [m, 1].")
      .def_property_readonly(
          "velocities", [](Live& live) { return copy(live.simulation().state().velocity); },
          "Their rates at the accepted state [m/s, 1/s]; no nodes in statics.")
      .def("quantities", &quantities, "What the deck's history watches, by name and unit.")
      .def_property_readonly(
          "broken_promises", [](Live& live) { return live.simulation().broken_promises(); },
          "Names the promises that did not hold in the analyses that have ended, in one line; "
          "empty "
          "if all do.")
      .def("messages", &Live::messages,
           "What culm said since the last call; warnings were warnings of Python before.");
}
