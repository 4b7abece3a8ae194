// What the ledger itself costs: one scope inside another, as in every pass over the model.
#include <culm/base/ledger.hpp>

#include <benchmark/benchmark.h>

namespace {

void BM_LedgerScope(benchmark::State& state) {
  culm::Ledger ledger;
  const auto outer = ledger.add("outer");
  const auto inner = ledger.add("inner");
  const culm::Ledger::Scope whole(ledger, outer);
  for ([[maybe_unused]] auto _ : state) {
    const culm::Ledger::Scope scope(ledger, inner);
    benchmark::DoNotOptimize(&scope);
  }
}
BENCHMARK(BM_LedgerScope);

}  // namespace
