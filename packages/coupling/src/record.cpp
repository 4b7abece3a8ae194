#include <culm/base/read_file.hpp>
#include <culm/coupling/partner_error.hpp>
#include <culm/coupling/record.hpp>

#include <fmt/format.h>

#include <limits>
#include <string_view>
#include <utility>

namespace culm::coupling {

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

void RecordedPartner::pose(const Window& window) {
  write(motion(FrameKind::attempt, window, wanted()));
  is_posed_ = true;
  partner_->pose(window);
}

Eigen::VectorXd RecordedPartner::loads(const Window& window) {
  if (!is_posed_) write(motion(FrameKind::attempt, window, wanted()));
  is_posed_ = false;
  Eigen::VectorXd loads = partner_->loads(window);
  write(answer(window, loads));
  return loads;
}

void RecordedPartner::accept(const Window& window) {
  partner_->accept(window);
  for (const WindowStep& one : window.steps) write(step(window, one));
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
  RecordedWindow window;
  while (frames.has_next()) {
    const Frame frame = frames.next();
    switch (frame.kind) {
      case FrameKind::attempt:
        window.attempts.push_back({read_motion(frame, record.partner.wanted, points), {}});
        break;
      case FrameKind::answer:
        if (window.attempts.empty()) throw PartnerError("it holds an answer to nothing");
        window.attempts.back().answer = read_answer(frame, points);
        break;
      case FrameKind::step:
        window.accepted.steps.push_back(read_step(frame, points));
        break;
      case FrameKind::accept: {
        std::vector<WindowStep> steps = std::move(window.accepted.steps);
        window.accepted = read_motion(frame, record.partner.wanted, points);
        window.accepted.steps = std::move(steps);
        record.windows.push_back(std::move(window));
        window = {};
        break;
      }
      case FrameKind::accepted:
        if (!record.windows.empty()) record.windows.back().books = read_accepted(frame);
        break;
      default:
        break;  // what is said beside
    }
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

}  // namespace culm::coupling
