#include <culm/base/read_file.hpp>
#include <culm/coupling/partner_error.hpp>
#include <culm/coupling/record.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

namespace culm::coupling {

using port::Quantity;

namespace {

// Of a window: how near two times may be to count as one.
constexpr double same_time = 1e-6;

}  // namespace

void RecordedPartner::write(const Frame& frame) {
  const std::string bytes = encode(frame);
  stream_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream_.flush();
  if (!stream_) throw FileError(file_.string(), "cannot be written");
}

void RecordedPartner::begin(const Beginning& beginning) {
  partner_->begin(beginning);
  if (beginning.window > 0) return;  // it goes on, see restore
  stream_.open(file_, std::ios::binary | std::ios::trunc);
  write(hello(beginning));
  write(introduction({"", beginning.points(), wanted(), std::numeric_limits<double>::infinity()}));
}

Eigen::VectorXd RecordedPartner::loads(const Window& window) {
  write(motion(FrameKind::attempt, window, wanted()));
  Eigen::VectorXd loads = partner_->loads(window);
  write(answer(window, loads));
  return loads;
}

void RecordedPartner::accept(const Window& window) {
  partner_->accept(window);
  write(motion(FrameKind::accept, window, wanted()));
  write(accepted(window, books()));
}

void RecordedPartner::save(const std::string& prefix, Snapshot& snapshot) {
  partner_->save(prefix, snapshot);
  snapshot.set(prefix + "recorded", static_cast<double>(stream_.tellp()));
}

// What came after the checkpoint is said once more.
void RecordedPartner::restore(const std::string& prefix, const Snapshot& snapshot) {
  partner_->restore(prefix, snapshot);
  const double length = snapshot.number(prefix + "recorded");
  std::error_code error;
  const std::uintmax_t there = std::filesystem::file_size(file_, error);
  if (error || static_cast<double>(there) < length) {
    throw FileError(file_.string(), "the record of the coupling is gone or too short");
  }
  std::filesystem::resize_file(file_, static_cast<std::uintmax_t>(length));
  stream_.open(file_, std::ios::binary | std::ios::app);
}

namespace {

// Whole frames, one after the other.
class Frames {
 public:
  explicit Frames(std::string bytes) : bytes_(std::move(bytes)), rest_(bytes_) {}

  bool has_next() const {
    return rest_.size() >= frame_header && rest_.size() - frame_header >= payload_size(rest_);
  }
  Frame next() {
    const std::size_t size = frame_header + payload_size(rest_);
    Frame frame = decode(rest_.substr(0, size));
    rest_.remove_prefix(size);
    return frame;
  }

 private:
  std::string bytes_;
  std::string_view rest_;
};

Record read(Frames frames) {
  Record record;
  const auto hello = [&] {
    if (!frames.has_next()) throw PartnerError("it ends before the first window");
    Frame frame = frames.next();
    if (frame.kind != FrameKind::hello) throw PartnerError("it does not begin with two hellos");
    return frame;
  };
  record.beginning = read_hello(hello());
  record.partner = read_introduction(hello());
  const int points = record.beginning.points();
  while (frames.has_next()) {
    const Frame frame = frames.next();
    if (frame.kind != FrameKind::accept) continue;
    record.windows.push_back(read_motion(frame, record.partner.wanted, points));
  }
  return record;
}

}  // namespace

Record read_record(const std::filesystem::path& file) {
  FileText found = find_text(file.string(), std::numeric_limits<std::size_t>::max());
  if (!found.objection.empty()) throw FileError(file.string(), found.objection);
  try {
    return read(Frames(std::move(found.text)));
  } catch (const PartnerError& error) {
    throw FileError(file.string(), std::string("is no record of a coupling: ") + error.what());
  }
}

void ReplayedPartner::begin(const Beginning& beginning) {
  if (beginning.window > 0) {
    throw UsageError("a replay begins at the beginning: run it anew instead of going on");
  }
  if (record_.beginning.reference != beginning.reference) {
    double largest = 0.0;
    const std::size_t count =
        std::min(record_.beginning.reference.size(), beginning.reference.size());
    for (std::size_t i = 0; i < count; ++i) {
      largest =
          std::max(largest, std::abs(record_.beginning.reference[i] - beginning.reference[i]));
    }
    if (record_.beginning.points() != beginning.points() || largest > 1e-9) {
      throw UsageError(fmt::format(
          "{}: port '{}' had {} points there and has {} here, up to {:.2g} m away from "
          "them",
          file_, beginning.port, record_.beginning.points(), beginning.points(), largest));
    }
  }
}

double ReplayedPartner::latest_end(double start) const {
  (void)start;
  return next_ < record_.windows.size() ? record_.windows[next_].end
                                        : std::numeric_limits<double>::infinity();
}

Eigen::VectorXd ReplayedPartner::loads(const Window& window) {
  if (next_ == record_.windows.size()) {
    throw PartnerError(
        fmt::format("{}: the record ends at {:g} s, the motion goes on", file_, window.start));
  }
  const Window& then = record_.windows[next_];
  const double expected = moved_.empty() ? then.start : reached_;
  if (std::abs(window.start - expected) > same_time * then.length()) {
    throw PartnerError(fmt::format("{}: the record goes on at {:g} s, the motion at {:g} s", file_,
                                   expected, window.start));
  }
  const std::vector<double>& loads = then.loads;
  return Eigen::Map<const Eigen::VectorXd>(loads.data(), static_cast<Eigen::Index>(loads.size()));
}

void ReplayedPartner::accept(const Window& window) {
  const std::vector<double>& now = window.of(Quantity::motion);
  if (moved_.empty()) {
    moved_ = now;
  } else {
    for (std::size_t i = 0; i < now.size(); ++i) moved_[i] += now[i];
  }
  reached_ = window.end;
  const Window& recorded = record_.windows[next_];
  if (recorded.end - window.end > same_time * recorded.length()) return;  // a part of it
  const std::vector<double>& then = recorded.of(Quantity::motion);
  double difference = 0.0, size = 0.0;
  for (std::size_t i = 0; i < moved_.size(); ++i) {
    difference = std::max(difference, std::abs(moved_[i] - then[i]));
    size = std::max(size, std::abs(then[i]));
  }
  if (difference > worst_ * size) {
    worst_ = size > 0.0 ? difference / size : std::numeric_limits<double>::infinity();
    worst_window_ = recorded.number;
  }
  moved_.clear();
  ++next_;
}

Books ReplayedPartner::books() const {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  return {unknown, unknown};
}

std::string ReplayedPartner::complaint() const {
  constexpr double rounding = 1e-10;
  if (worst_ <= rounding) return {};
  return fmt::format(
      "{}: with the recorded loads the structure moves differently, in window {} by {:.2g} of its "
      "motion",
      file_, worst_window_, worst_);
}

std::string ReplayedPartner::left_over() const {
  if (next_ == record_.windows.size()) return {};
  const double compared = next_ > 0 ? record_.windows[next_ - 1].end : record_.beginning.time;
  return fmt::format("{}: compared to {:g} s only, the record goes on to {:g} s", file_, compared,
                     record_.windows.back().end);
}

}  // namespace culm::coupling
