// A file with the coefficients of an airfoil, once as numbers with commas and once as AeroDyn has
// it. What is read is finite at all angles.

#include <culm/base/default_list.hpp>
#include <culm/strip/airfoil.hpp>

#include "fuzz_target.hpp"

#include <string>

namespace {

using namespace culm;

void read(const std::string& path, const std::string& format) {
  static const strip::AirfoilRegistry registry = [] {
    strip::AirfoilRegistry known;
    strip::register_airfoils(known);
    return known;
  }();
  static const Schema schema = registry.variants().at("Polar");
  Options options = default_list(schema, "airfoil", Where{"deck.xml", 1, "Airfoils / airfoil"});
  options.set("File Name", path);
  options.set("File Format", format);
  const strip::SharedAirfoil airfoil = registry.make("Polar", options);
  for (double angle = -3.1; angle < 3.2; angle += 0.2) {
    strip::Coefficients slope;
    const strip::Coefficients coefficients = airfoil->at(angle, slope);
    if (coefficients.allFinite() && slope.allFinite()) continue;
    std::fprintf(stderr, "coefficients at %g are not finite\n", angle);
    std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const std::string path = fuzz::write_scratch("polar", fuzz::text_of(data, size)).string();
  fuzz::survive([&] { read(path, "CSV"); });
  fuzz::survive([&] { read(path, "AeroDyn"); });
  return 0;
}
