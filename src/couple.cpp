#include <culm/base/error.hpp>
#include <culm/base/nearest.hpp>

#include "command.hpp"

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

namespace culm::app {
namespace {

// 'added-mass' as the deck has it: 'Added Mass'.
std::string in_deck(std::string name) {
  if (name == "mpi") return "MPI";
  bool begins = true;
  for (char& c : name) {
    if (c == '-') c = ' ';
    if (begins) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    begins = c == ' ';
  }
  return name;
}

}  // namespace

void couple(const parallel::Comm& comm, CoupleArguments& arguments) {
  const std::string partner = "Coupling/Partners/partner/";
  const std::string type = in_deck(arguments.partner);
  std::vector<std::string> settings = {partner + "Type=" + type};
  const auto add = [&](const std::string& name, const std::string& value) {
    if (!value.empty()) settings.push_back(name + "=" + value);
  };
  add(partner + "Mass", arguments.mass);
  add(partner + "Damping", arguments.damping);
  add(partner + "Stiffness", arguments.stiffness);
  add(partner + "Address", arguments.address);
  add(partner + "Port", arguments.port);
  // the first one after those of culm
  if (type == "MPI") add(partner + "Rank", std::to_string(std::max(arguments.ranks, 1)));
  add("Coupling/Scheme", in_deck(arguments.scheme));
  add("Coupling/Window", arguments.window);
  add("Coupling/Tolerance", arguments.tolerance);
  if (arguments.parallel) settings.emplace_back("Coupling/Parallel=true");
  if (arguments.record) settings.emplace_back("Coupling/Record=true");
  arguments.overrides.insert(arguments.overrides.begin(), settings.begin(), settings.end());
  run(comm, arguments);
}

}  // namespace culm::app
