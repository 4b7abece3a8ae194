#include <culm/base/error.hpp>
#include <culm/base/ledger.hpp>

#include <algorithm>
#include <cstdio>
#include <string_view>
#include <utility>

namespace culm {
namespace {

std::string fixed(double value, int digits) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.*f", digits, value);
  return buffer;
}

std::string count_text(const std::optional<long long>& count) {
  return count ? std::to_string(*count) : "–";
}

/// Three significant digits are enough for a glance; long runs get whole seconds.
std::string time_text(double seconds) {
  if (seconds >= 100.0) return fixed(seconds, 0) + " s";
  if (seconds >= 1.0) return fixed(seconds, 1) + " s";
  if (seconds >= 1e-3) return fixed(1e3 * seconds, 1) + " ms";
  return fixed(1e6 * seconds, 1) + " µs";
}

/// Width on the screen: continuation bytes of UTF-8 take no column.
std::size_t width(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; }));
}

std::string table(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width(row[i]));
  }
  std::string text;
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string padding(widths[i] - width(row[i]), ' ');
      text += i == 0 ? row[i] + padding : "   " + padding + row[i];
    }
    text += '\n';
  }
  return text;
}

}  // namespace

Ledger::Id Ledger::add(Entry entry) {
  if (!entry.items) {
    const auto same = std::ranges::find(entries_, entry.name, &Entry::name);
    if (same != entries_.end()) {
      same->unknowns = entry.unknowns;
      return static_cast<Id>(same - entries_.begin());
    }
  }
  entries_.push_back(std::move(entry));
  return static_cast<Id>(entries_.size()) - 1;
}

const Ledger::Entry& Ledger::entry(Id id) const {
  internal_check(id >= 0 && static_cast<std::size_t>(id) < entries_.size(),
                 "unknown entry of the ledger");
  return entries_[static_cast<std::size_t>(id)];
}

double Ledger::seconds() const {
  double sum = 0.0;
  for (const Entry& entry : entries_) sum += entry.seconds;
  return sum;
}

void Ledger::reset_times() {
  for (Entry& entry : entries_) {
    entry.seconds = 0.0;
    entry.calls = 0;
  }
}

std::string Ledger::report() const {
  std::vector<std::vector<std::string>> rows = {
      {"effect", "items", "unknowns", "entries/iter", "time", "share"}};
  const double total = seconds();
  for (const Entry& entry : entries_) {
    const double share = total > 0.0 ? 100.0 * entry.seconds / total : 0.0;
    rows.push_back({entry.name, count_text(entry.items), count_text(entry.unknowns),
                    count_text(entry.entries_per_iteration), time_text(entry.seconds),
                    fixed(share, 0) + " %"});
  }
  return table(rows);
}

void Ledger::book() {
  const Clock::time_point now = now_();
  if (innermost_) {
    entries_[static_cast<std::size_t>(innermost_->id_)].seconds +=
        std::chrono::duration<double>(now - last_).count();
  }
  last_ = now;
}

Ledger::Scope::Scope(Ledger& ledger, Id id) : ledger_(ledger), outer_(ledger.innermost_), id_(id) {
  CULM_ASSERT(id >= 0 && static_cast<std::size_t>(id) < ledger.entries_.size());
  ledger_.book();
  ledger_.innermost_ = this;
  ++ledger_.entries_[static_cast<std::size_t>(id_)].calls;
}

void Ledger::Scope::pass_to(Id id) {
  CULM_ASSERT(id >= 0 && static_cast<std::size_t>(id) < ledger_.entries_.size());
  if (id != id_) {
    ledger_.book();
    id_ = id;
  }
  ++ledger_.entries_[static_cast<std::size_t>(id)].calls;
}

Ledger::Scope::~Scope() {
  ledger_.book();
  ledger_.innermost_ = outer_;
}

Ledger::Round::Round(Ledger& ledger, std::vector<Id> effects)
    : ledger_(ledger), order_(std::move(effects)), effects_(order_) {
  std::ranges::sort(effects_);
  const auto repeated = std::ranges::unique(effects_);
  effects_.erase(repeated.begin(), repeated.end());
  before_.resize(effects_.size());
  timed_.resize(effects_.size());
}

// A look at the clock takes a hundredth of a microsecond: a four-hundredth of what it is worth.
bool Ledger::Round::is_to_be_timed() {
  constexpr double worth_a_look = 4e-6;  // [s]
  constexpr double known = 8.0;          // laps
  const double looks = laps_timed_ * static_cast<double>(order_.size());
  if (laps_timed_ < known || all_timed_ <= 0.0 || all_timed_ > worth_a_look * looks) return true;
  chance_ = 1664525U * chance_ + 1013904223U;  // Numerical Recipes, 7.1
  return chance_ < (1U << 29U);
}

// What effects took in a lap that was timed effect by effect.
void Ledger::Round::learn() {
  for (std::size_t e = 0; e < effects_.size(); ++e) {
    const double taken = ledger_.seconds_of(effects_[e]) - before_[e];
    timed_[e] += taken;
    all_timed_ += taken;
  }
  laps_timed_ += 1.0;
}

// What a lap took that was timed as a whole: all of it was booked on the first effect.
void Ledger::Round::put_aside() {
  double& first = ledger_.seconds_of(order_.front());
  pending_ += first - before_.front();
  first = before_.front();
}

void Ledger::Round::share_out() {
  if (pending_ == 0.0) return;
  for (std::size_t e = 0; e < effects_.size(); ++e) {
    ledger_.seconds_of(effects_[e]) += pending_ * timed_[e] / all_timed_;
  }
  pending_ = 0.0;
}

Ledger::Round::Lap::Lap(Round& round) : round_(round), is_timed_(round.is_to_be_timed()) {
  if (!is_timed_) {
    round.before_.front() = round.ledger_.seconds_of(round.order_.front());
    return;
  }
  for (std::size_t e = 0; e < round.effects_.size(); ++e) {
    round.before_[e] = round.ledger_.seconds_of(round.effects_[e]);
  }
}

void Ledger::Round::Lap::pass_to(std::size_t place) {
  const Id id = round_.order_[place];
  if (!scope_) {
    scope_.emplace(round_.ledger_, id);
  } else if (is_timed_) {
    scope_->pass_to(id);
  } else {
    ++round_.ledger_.entries_[static_cast<std::size_t>(id)].calls;
  }
}

Ledger::Round::Lap::~Lap() {
  scope_.reset();
  if (is_timed_) {
    round_.learn();
    round_.share_out();
  } else {
    round_.put_aside();
  }
}

}  // namespace culm
