#include <culm/analysis/books.hpp>
#include <culm/model/booked.hpp>

#include <algorithm>
#include <set>
#include <span>

namespace culm::analysis {
namespace {

std::string account_of(const model::Batch& batch) {
  const auto* booked = dynamic_cast<const model::Booked*>(&batch);
  return booked == nullptr ? "" : booked->account();
}

}  // namespace

Books::Books(const assembly::System& system) : system_(system), batches_(system.model().batches()) {
  std::set<std::string> names;
  for (const model::Batch* batch : batches_) names.insert(account_of(*batch));
  names.erase("");
  accounts_.assign(names.begin(), names.end());
  for (const model::Batch* batch : batches_) {
    const auto found = std::find(accounts_.begin(), accounts_.end(), account_of(*batch));
    account_of_.push_back(static_cast<std::size_t>(found - accounts_.begin()));
  }
  works_.resize(accounts_.size() + 1);
}

model::StepWork Books::add(const model::State& state, const Stencil& stencil) {
  std::vector<model::StepWork> step(works_.size());
  pushed_ = {0.0, 0.0};
  for (std::size_t i = 0; i < batches_.size(); ++i) {
    const model::StepWork work = batches_[i]->step_work(state, stencil);
    step[account_of_[i]] += work;
    pushed_[0] += work.force.norm();
    pushed_[1] += work.moment.norm();
  }
  system_.comm().sum(pushed_);
  model::StepWork total;
  for (std::size_t i = 0; i < step.size(); ++i) {
    model::StepWork& work = step[i];
    double scalars[4] = {work.external, work.drives, work.damping, work.dissipation};
    system_.comm().sum(scalars);
    work.external = scalars[0];
    work.drives = scalars[1];
    work.damping = scalars[2];
    work.dissipation = scalars[3];
    system_.comm().sum(std::span(work.force.data(), 3));
    system_.comm().sum(std::span(work.moment.data(), 3));
    works_[i] += work;
    total += work;
  }
  return total;
}

}  // namespace culm::analysis
