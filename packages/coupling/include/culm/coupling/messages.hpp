/// What the frames of a coupling hold. doc/developer/wire_format.md
#pragma once

#include <culm/coupling/frame.hpp>
#include <culm/coupling/window.hpp>

#include <string>

namespace culm::coupling {

/// What a partner answers to the first word.
struct Introduction {
  std::string name;
  int points = 0;
  Quantities wanted = 0;
  double longest_window = 0.0;  ///< [s]
};

Frame hello(const Beginning& beginning);
Beginning read_hello(const Frame& frame);
Frame introduction(const Introduction& partner);
Introduction read_introduction(const Frame& frame);

/// @param kind  attempt or accept
Frame motion(FrameKind kind, const Window& window, Quantities wanted);
Window read_motion(const Frame& frame, Quantities wanted, int points);

/// One of the steps of a window; for records.
Frame step(const Window& window, const WindowStep& step);
WindowStep read_step(const Frame& frame, int points);

Frame answer(const Window& window, const Eigen::VectorXd& loads);
/// What is wrong with the loads of an answer, "it answered …": their number, or one that is none;
/// empty if nothing is.
std::string objection_to(const Eigen::VectorXd& answer, int points);
/// What is wrong with what a partner says of its energy; empty if nothing is.
std::string objection_to(const Books& books);
/// The same of a partner that said something else before: books do not come and go.
std::string objection_to(const Books& books, const Books& before);
/// Throws PartnerError for another number of loads and for what is no number.
Eigen::VectorXd read_answer(const Frame& frame, int points);

/// @param motion  of the port, if the structure converged; null if it did not
Frame found(const Frame& attempt, const Window* motion, Quantities wanted);

Frame accepted(const Window& window, const Books& books);
Books read_accepted(const Frame& frame);

}  // namespace culm::coupling
