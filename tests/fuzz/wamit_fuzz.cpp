// Files of WAMIT. An input is one text, in which a line "%%% NAME" begins the file NAME: body.1,
// body.3 and body.hst. What is read is finite.

#include <culm/water/potential_body.hpp>

#include "fuzz_target.hpp"

namespace {

using namespace culm;

void demand(bool finite, const char* what) {
  if (finite) return;
  std::fprintf(stderr, "%s is not finite\n", what);
  std::abort();
}

void check(const water::PotentialBody& body) {
  demand(body.hydrostatics.allFinite(), "a restoring force");
  demand(body.infinite_mass.allFinite(), "an added mass");
  for (const water::Radiation& one : body.radiation) {
    demand(one.added_mass.allFinite() && one.damping.allFinite(), "a force of radiation");
  }
  for (const water::Excitation& one : body.excitation) {
    for (const double heading : body.headings) {
      demand(excitation_of(body, one.frequency, heading).allFinite(), "a force of waves");
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  fuzz::write_files(fuzz::text_of(data, size));
  const auto path = fuzz::scratch_folder() / "body.1";
  fuzz::survive([&] {
    check(water::read_wamit(path.string(), {1025.0, 9.81, 1.0}, {"deck.xml", 1, "Loads"}));
  });
  fuzz::empty_scratch();
  return 0;
}
