#include <culm/analysis/books.hpp>
#include <culm/model/booked.hpp>
#include <culm/model/dead_weight.hpp>

#include <algorithm>
#include <set>

namespace culm::analysis {
namespace {

std::string account_of(const model::Batch& batch) {
  const auto* booked = dynamic_cast<const model::Booked*>(&batch);
  return booked == nullptr ? "" : booked->account();
}

// All numbers of works and what was pushed with: one message for all, as it takes as long as for
// one.
template <class Visit>
void for_numbers(std::vector<model::StepWork>& works, std::array<double, 2>& pushed,
                 const Visit& visit) {
  for (model::StepWork& work : works) {
    for (double* number : {&work.external, &work.drives, &work.damping, &work.dissipation}) {
      visit(*number);
    }
    for (double& number : work.force) visit(number);
    for (double& number : work.moment) visit(number);
  }
  for (double& number : pushed) visit(number);
}

void sum_up(std::vector<model::StepWork>& works, std::array<double, 2>& pushed,
            const parallel::Comm& comm) {
  if (comm.size() == 1) return;
  std::vector<double> numbers;
  for_numbers(works, pushed, [&](double number) { numbers.push_back(number); });
  comm.sum(numbers);
  auto sum = numbers.begin();
  for_numbers(works, pushed, [&](double& number) { number = *sum++; });
}

}  // namespace

Books::Books(const assembly::System& system, bool with_momenta)
    : system_(system), with_momenta_(with_momenta), batches_(system.model().batches()) {
  if (!with_momenta) {
    std::erase_if(batches_, [](const model::Batch* batch) {
      const auto* dead = dynamic_cast<const model::DeadWeight*>(batch);
      return dead != nullptr && dead->has_potential() && account_of(*batch).empty();
    });
  }
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
  step_.assign(works_.size(), {});
  pushed_ = {0.0, 0.0};
  for (std::size_t i = 0; i < batches_.size(); ++i) {
    const model::StepWork work = batches_[i]->step_work(state, stencil);
    step_[account_of_[i]] += work;
    if (!with_momenta_) continue;
    pushed_[0] += work.force.norm();
    pushed_[1] += work.moment.norm();
  }
  sum_up(step_, pushed_, system_.comm());
  model::StepWork total;
  for (std::size_t i = 0; i < step_.size(); ++i) {
    works_[i] += step_[i];
    total += step_[i];
  }
  return total;
}

}  // namespace culm::analysis
