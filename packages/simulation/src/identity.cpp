#include <culm/base/read_file.hpp>
#include <culm/deck/resolved.hpp>
#include <culm/output/checksum.hpp>
#include <culm/simulation/identity.hpp>
#include <culm/simulation/input_files.hpp>

#include <fmt/format.h>

#include <filesystem>
#include <random>
#include <span>
#include <string_view>
#include <vector>

namespace culm::simulation {
namespace {

// Checksums one after the other, so that what is told apart stays apart.
class Chain {
 public:
  void add(std::string_view text) {
    sums_.push_back(output::checksum(std::as_bytes(std::span(text))));
  }
  void add(std::span<const double> numbers) {
    sums_.push_back(output::checksum(std::as_bytes(numbers)));
  }
  std::string text() const {
    return fmt::format("{:016x}", output::checksum(std::as_bytes(std::span(sums_))));
  }

 private:
  std::vector<std::uint64_t> sums_;
};

}  // namespace

std::string new_run_identity(const parallel::Comm& comm) {
  std::random_device source;
  std::string digits;
  for (int word = 0; word < 4; ++word) digits += fmt::format("{:08x}", source());
  return comm.broadcast(digits);
}

std::string identity_of(const Options& deck) {
  Chain chain;
  chain.add(deck::resolved(deck));
  return chain.text();
}

std::string identity_of(const model::Model& model, const Options& deck) {
  Chain chain;
  for (const std::filesystem::path& file : find_named_files(deck)) {
    chain.add(read_file(file.string()));
  }
  const model::State state = model.initial_state();
  chain.add(std::span(state.next.data(), static_cast<std::size_t>(state.next.size())));
  for (const model::Constraint& equation : model.equations()) {
    chain.add(equation.name);
    chain.add(std::vector{static_cast<double>(equation.rows.size())});
  }
  for (const model::Batch* batch : model.batches()) {
    const model::Effect& effect = batch->effect();
    for (const std::string* text : {&effect.type, &effect.name, &effect.part}) chain.add(*text);
    chain.add(std::vector{static_cast<double>(batch->memory_size())});
  }
  for (const auto& [name, function] : model.functions()) {
    chain.add(name);
    chain.add(function.corners());
    if (!function.is_function_of_time()) continue;
    std::vector<double> values;
    for (const double time : function.corners()) values.push_back(function.at(time));
    chain.add(values);
  }
  return chain.text();
}

}  // namespace culm::simulation
