#include <culm/coupling/messages.hpp>
#include <culm/coupling/partner_error.hpp>

#include <fmt/format.h>

#include <cmath>
#include <span>

namespace culm::coupling {
namespace {

Frame about(FrameKind kind, const Window& window) {
  return {kind, static_cast<std::uint32_t>(window.number),
          static_cast<std::uint32_t>(window.attempt), window.start, window.end};
}

void expect_end(const Reader& reader, const Frame& frame) {
  if (!reader.is_at_end()) {
    throw PartnerError(fmt::format("'{}' holds more than it should", name_of(frame.kind)));
  }
}

}  // namespace

Frame hello(const Beginning& beginning) {
  Writer writer;
  writer.add(static_cast<std::uint32_t>(beginning.points()));
  writer.add(std::span(beginning.reference));
  writer.add(std::span(beginning.velocity));
  writer.add_text(beginning.port);
  return {FrameKind::hello,
          static_cast<std::uint32_t>(beginning.window),
          0,
          beginning.time,
          beginning.time,
          writer.take()};
}

Beginning read_hello(const Frame& frame) {
  Reader reader(frame.payload);
  Beginning beginning;
  const std::size_t points = reader.count();
  beginning.reference = reader.numbers(3 * points);
  beginning.velocity = reader.numbers(6 * points);
  beginning.port = reader.text();
  beginning.time = frame.start;
  beginning.window = static_cast<int>(frame.window);
  return beginning;
}

Frame introduction(const Introduction& partner) {
  Writer writer;
  writer.add(static_cast<std::uint32_t>(partner.points));
  writer.add(partner.wanted);
  writer.add(partner.longest_window);
  writer.add_text(partner.name);
  return {FrameKind::hello, 0, 0, 0.0, 0.0, writer.take()};
}

Introduction read_introduction(const Frame& frame) {
  Reader reader(frame.payload);
  Introduction partner;
  partner.points = static_cast<int>(reader.count());
  partner.wanted = reader.count();
  partner.longest_window = reader.number();
  partner.name = reader.text();
  if (!(partner.longest_window > 0.0)) {
    throw PartnerError(fmt::format("its longest window is {} s", partner.longest_window));
  }
  if (components(partner.wanted) == 0 || partner.wanted >= 1U << all_quantities.size()) {
    throw PartnerError(fmt::format("it wants quantities {:#x} of 0x1f", partner.wanted));
  }
  return partner;
}

Frame motion(FrameKind kind, const Window& window, Quantities wanted) {
  Frame frame = about(kind, window);
  Writer writer;
  for (const port::Quantity q : all_quantities) {
    if ((wanted & bit(q)) != 0) writer.add(std::span(window.of(q)));
  }
  if (kind == FrameKind::accept) writer.add(std::span(window.loads));
  frame.payload = writer.take();
  return frame;
}

Window read_motion(const Frame& frame, Quantities wanted, int points) {
  Window window{static_cast<int>(frame.window),
                static_cast<int>(frame.attempt),
                frame.start,
                frame.end,
                {},
                {},
                {}};
  Reader reader(frame.payload);
  for (const port::Quantity q : all_quantities) {
    if ((wanted & bit(q)) == 0) continue;
    window.of(q) = reader.numbers(static_cast<std::size_t>(port::components(q) * points));
  }
  if (frame.kind == FrameKind::accept) {
    window.loads = reader.numbers(6 * static_cast<std::size_t>(points));
  }
  expect_end(reader, frame);
  return window;
}

Frame step(const Window& window, const WindowStep& step) {
  Frame frame = about(FrameKind::step, window);
  frame.start = step.start;
  frame.end = step.end;
  Writer writer;
  writer.add(std::span(step.motion));
  frame.payload = writer.take();
  return frame;
}

WindowStep read_step(const Frame& frame, int points) {
  Reader reader(frame.payload);
  WindowStep step{frame.start, frame.end, reader.numbers(6 * static_cast<std::size_t>(points))};
  expect_end(reader, frame);
  return step;
}

Frame answer(const Window& window, const Eigen::VectorXd& loads) {
  Frame frame = about(FrameKind::answer, window);
  Writer writer;
  writer.add(std::span(loads.data(), static_cast<std::size_t>(loads.size())));
  frame.payload = writer.take();
  return frame;
}

std::string objection_to(const Eigen::VectorXd& answer, int points) {
  if (answer.size() != 6 * static_cast<Eigen::Index>(points)) {
    return fmt::format("it answered {} numbers; six for each of {} points are {}", answer.size(),
                       points, 6 * points);
  }
  constexpr double largest = 1e100;  // of which sums of squares are numbers
  for (Eigen::Index i = 0; i < answer.size(); ++i) {
    if (std::abs(answer[i]) <= largest) continue;
    return fmt::format("it answered {} for component {} at point {}", answer[i], i % 6, i / 6);
  }
  return {};
}

std::string objection_to(const Books& books) {
  const bool is_half = std::isnan(books.energy) != std::isnan(books.dissipated);
  if (!std::isinf(books.energy) && !std::isinf(books.dissipated) && !is_half) return {};
  return fmt::format("its energy is {} J, its heat {} J{}", books.energy, books.dissipated,
                     is_half ? ": both are numbers, or neither is where it keeps no books" : "");
}

std::string objection_to(const Books& books, const Books& before) {
  if (const std::string objection = objection_to(books); !objection.empty()) return objection;
  if (books.are_kept() == before.are_kept()) return {};
  return fmt::format(
      "its energy is {} J, its heat {} J, and was {} J and {} J before: it keeps "
      "books in all windows, or in none",
      books.energy, books.dissipated, before.energy, before.dissipated);
}

Eigen::VectorXd read_answer(const Frame& frame, int points) {
  const std::size_t count = 6 * static_cast<std::size_t>(points);
  if (frame.payload.size() != count * sizeof(double)) {
    throw PartnerError(
        fmt::format("its answer has {} bytes; six numbers for each of {} points are "
                    "{}",
                    frame.payload.size(), points, count * sizeof(double)));
  }
  const std::vector<double> values = Reader(frame.payload).numbers(count);
  Eigen::VectorXd loads =
      Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(count));
  const std::string objection = objection_to(loads, points);
  if (!objection.empty()) throw PartnerError(objection);
  return loads;
}

Frame found(const Frame& attempt, const Window* motion, Quantities wanted) {
  Writer writer;
  writer.add(motion == nullptr ? 0.0 : 1.0);
  for (const port::Quantity q : all_quantities) {
    if (motion != nullptr && (wanted & bit(q)) != 0) writer.add(std::span(motion->of(q)));
  }
  return {FrameKind::answer, attempt.window, attempt.attempt,
          attempt.start,     attempt.end,    writer.take()};
}

Frame accepted(const Window& window, const Books& books) {
  Frame frame = about(FrameKind::accepted, window);
  Writer writer;
  writer.add(books.energy);
  writer.add(books.dissipated);
  frame.payload = writer.take();
  return frame;
}

Books read_accepted(const Frame& frame) {
  Reader reader(frame.payload);
  Books books;
  books.energy = reader.number();
  books.dissipated = reader.number();
  expect_end(reader, frame);
  const std::string objection = objection_to(books);
  if (!objection.empty()) throw PartnerError(objection);
  return books;
}

}  // namespace culm::coupling
