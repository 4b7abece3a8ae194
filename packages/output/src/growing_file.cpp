#include <culm/base/error.hpp>
#include <culm/output/growing_file.hpp>

#include "replace_file.hpp"

#include <utility>

namespace culm::output {

GrowingFile::GrowingFile(std::filesystem::path path, std::string head, std::string tail)
    : path_(std::move(path)), head_(std::move(head)), tail_(std::move(tail)) {
  write();
}

GrowingFile::~GrowingFile() {
  // Without a path this is what is left of a moved file.
  if (path_.empty() || entries_ == written_entries_) return;
  try {
    write();
  } catch (const Error&) {
    // The file keeps its last complete content; a destructor has nobody to tell.
  }
}

void GrowingFile::add(const std::string& entry) {
  text_ += entry;
  ++entries_;
  if (is_due()) write();
}

void GrowingFile::replace(const std::vector<std::string>& entries) {
  text_.clear();
  for (const std::string& entry : entries) text_ += entry;
  entries_ = entries.size();
  write();
}

bool GrowingFile::is_due() const {
  const auto waited = Clock::now() - written_at_;
  const bool lacks_many = entries_ > written_entries_ + written_entries_ / 8;
  const bool lacks_all = written_entries_ == 0;
  return waited > std::chrono::seconds(10) ||
         (lacks_many && (lacks_all || waited > std::chrono::milliseconds(100)));
}

void GrowingFile::write() {
  if (identity_) identity_->check_whole(path_);
  replace_file(path_, head_ + text_ + tail_);
  identity_.emplace(path_);
  written_entries_ = entries_;
  written_at_ = Clock::now();
}

}  // namespace culm::output
