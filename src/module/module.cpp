// The Python module _culm: simulations in the hands of a Python program. What users import is the
// package `culm`, which adds what is easier to write in Python.

#include <culm/base/absent.hpp>

#include "arrays.hpp"
#include "live.hpp"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace culm::module {
namespace {

using port::Quantity;

void set_load(Live& live, const std::string& name, const py::object& given) {
  const Values values = numbers_of(given, "load '" + name + "'");
  const py::ssize_t nodes = values.size() / 6;
  if (values.size() == 6 * nodes && !stand_in_order(values, nodes)) {
    throw UsageError("load '" + name + "' takes values of the shape (" + std::to_string(nodes) +
                     ", 6), force and moment of each node, got " + shape_of(values));
  }
  live.simulation().set_load(name, {values.data(), values.data() + values.size()});
}

// A port of a simulation; found by name, for the model changes from analysis to analysis.
class PortHandle {
 public:
  PortHandle(Live& live, std::string name) : live_(live), name_(std::move(name)) { get(); }

  const port::Port& get() const { return live_.simulation().port(name_); }
  Simulation& simulation() const { return live_.simulation(); }
  const std::string& name() const { return name_; }
  Live& live() const { return live_; }

 private:
  Live& live_;
  std::string name_;
};

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

void set_port(const PortHandle& port, const py::object& force, const py::object& moment) {
  const int points = port.get().size();
  const Values forces = numbers_of(force, "force");
  const Values moments = moment.is_none() ? Values() : numbers_of(moment, "moment");
  port.simulation().set_port(
      port.name(), three_columns(forces, "force", points),
      moment.is_none() ? std::span<const double>() : three_columns(moments, "moment", points));
}

void set_pressure(const PortHandle& port, const py::object& faces, const py::object& pressure,
                  const py::object& traction) {
  const Values pressures = numbers_of(pressure, "pressure");
  const Values tractions = traction.is_none() ? Values() : numbers_of(traction, "traction");
  if (pressures.ndim() != 1) {
    throw UsageError("pressure must have the shape (faces,), and has " + shape_of(pressures));
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
  const auto weights = smooth ? port::Weights::smooth : port::Weights::elements;
  live.simulation().add_port(name, {{numbers.begin(), numbers.end()}, structures, reach, weights});
}

py::dict exchange(const PortHandle& port) {
  const port::Exchange sum = port.simulation().exchange(port.name());
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
  for (const output::HistoryColumn& column : live.simulation().quantity_columns()) {
    const std::string unit = column.unit.empty() ? "" : " [" + column.unit + "]";
    const double number = numbers[i++];
    all[py::str(column.name + unit)] =
        number == absent ? std::numeric_limits<double>::quiet_NaN() : number;
  }
  return all;
}

py::dict finish(const Handle& stepper) {
  py::dict numbers;
  for (const auto& [name, value] : stepper.take().finish().numbers) numbers[py::str(name)] = value;
  return numbers;
}

void register_errors(py::module_& module) {
  const auto base = py::register_exception<Error>(module, "Error");
  py::register_exception<UsageError>(module, "UsageError", base);
  py::register_exception<InputError>(module, "InputError", base);
  py::register_exception<NumericalError>(module, "NumericalError", base);
  py::register_exception<NonFiniteError>(module, "NonFiniteError", base);
  py::register_exception<FileError>(module, "FileError", base);
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
            analysis::run(taken, observer);
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
              throw UsageError("the snapshot belongs to another analysis or simulation");
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

}  // namespace culm::module
