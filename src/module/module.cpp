// The Python module _culm: simulations in the hands of a Python program. What users import is the
// package `culm`, which adds what is easier to write in Python.

#include <culm/base/error.hpp>
#include <culm/simulation/session.hpp>
#include <culm/simulation/simulation.hpp>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace py = pybind11;

namespace {

using culm::Snapshot;
using culm::analysis::Stepper;
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

// A simulation and what it says.
class Live {
 public:
  Live(const std::string& deck, std::vector<std::string> overrides)
      : start_(start()),
        simulation_(
            Simulation::open(deck, std::move(overrides), culm::Log(said_, culm::LogLevel::info))) {}

  // What was said since the last call.
  std::string messages() {
    std::string text = said_.str();
    said_.str({});
    return text;
  }
  Simulation& simulation() { return simulation_; }

 private:
  std::shared_ptr<Start> start_;  // the last to go
  std::ostringstream said_;
  Simulation simulation_;
};

// A view of coordinates, x and the three directors of each node, as long as the owner lives.
py::array view(const std::vector<double>& coordinates, py::handle owner) {
  const auto nodes = static_cast<py::ssize_t>(coordinates.size() / 12);
  py::array_t<double> array({nodes, py::ssize_t{4}, py::ssize_t{3}}, coordinates.data(), owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

using Values = py::array_t<double, py::array::c_style | py::array::forcecast>;

void set_load(Live& live, const std::string& name, const Values& values) {
  live.simulation().set_load(name, {values.data(), values.data() + values.size()});
}

py::dict quantities(Live& live) {
  py::dict all;
  const std::vector<double> numbers = live.simulation().quantities();
  std::size_t i = 0;
  for (const culm::output::HistoryColumn& column : live.simulation().quantity_columns()) {
    const std::string unit = column.unit.empty() ? "" : " [" + column.unit + "]";
    all[py::str(column.name + unit)] = numbers[i++];
  }
  return all;
}

py::dict finish(Stepper& stepper) {
  py::dict numbers;
  for (const auto& [name, value] : stepper.finish().numbers) numbers[py::str(name)] = value;
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

  py::class_<Snapshot>(module, "Snapshot", "What Stepper.save keeps for Stepper.restore.");

  py::class_<Stepper>(module, "Stepper", "Makes the steps of an analysis.")
      .def(
          "attempt",
          [](Stepper& stepper, std::optional<double> target) {
            return stepper.attempt(target.value_or(stepper.proposal())).accepted;
          },
          py::arg("target") = py::none(), Free(),
          "Solves a step from the accepted state to a target, the proposed one if none is given. "
          "Returns whether it converged.")
      .def("accept", &Stepper::accept, Free(), "Makes the attempt the accepted state.")
      .def("discard", &Stepper::discard, "Goes back as if the attempt had not been made.")
      .def("fail", &Stepper::fail, "Goes back; the next proposal is nearer.")
      .def(
          "run", [](Stepper& stepper) { culm::analysis::run(stepper); }, Free(),
          "Makes all steps to the end.")
      .def("finish", &finish, "Ends the analysis; returns the numbers of its report.")
      .def(
          "save",
          [](Stepper& stepper) {
            auto snapshot = std::make_unique<Snapshot>(Snapshot::Use::memory);
            stepper.save(*snapshot);
            return snapshot;
          },
          "The accepted state and all that the next step needs.")
      .def("restore", &Stepper::restore, py::arg("snapshot"), "Goes back to what save returned.")
      .def_property_readonly("proposal", &Stepper::proposal, "Where the next step should go.")
      .def_property_readonly("time", &Stepper::time, "Time [s] or level of the accepted state.")
      .def_property_readonly("steps", &Stepper::steps, "Accepted steps so far.")
      .def_property_readonly("is_at_end", &Stepper::is_at_end)
      .def_property_readonly("is_exhausted", &Stepper::is_exhausted);

  py::class_<Live>(module, "Simulation", "A deck whose steps the caller makes.")
      .def(py::init<const std::string&, std::vector<std::string>>(), py::arg("deck"),
           py::arg("overrides") = std::vector<std::string>{},
           "Builds the model of a deck. Overrides are such as 'Structures/beam/Curve/Elements=32'.")
      .def(
          "begin",
          [](Live& live, const std::string& analysis) -> Stepper& {
            return live.simulation().begin(analysis);
          },
          py::arg("analysis") = "", py::return_value_policy::reference_internal,
          "Takes up an analysis that makes steps, the first one if no name is given.")
      .def("set_load", &set_load, py::arg("name"), py::arg("values"),
           "Sets a load of type 'External': force [N] and moment [N m] of each node.")
      .def(
          "nodes",
          [](Live& live, const std::string& name) { return live.simulation().nodes(name); },
          py::arg("name"), "Numbers of the nodes of a name.")
      .def_property_readonly(
          "coordinates",
          [](py::object self) { return view(self.cast<Live&>().simulation().state().next, self); },
          "Position and directors of all nodes, shape (nodes, 4, 3) [m, 1], read only; brought up "
          "to "
          "date by reading the property.")
      .def_property_readonly(
          "velocities",
          [](py::object self) {
            return view(self.cast<Live&>().simulation().state().velocity, self);
          },
          "Their rates at the accepted state [m/s, 1/s]; no nodes in statics.")
      .def("quantities", &quantities, "What the deck's history watches, by name and unit.")
      .def("messages", &Live::messages, "What culm said since the last call.");
}
