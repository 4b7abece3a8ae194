// Boxes of turbulence. The first byte says of which kind: a file of TurbSim follows, or three
// bytes, the points along, across and upwards, and three files after Mann, one behind the other.
// What is read is finite everywhere in the box.

#include "../../packages/flow/src/mann_files.hpp"
#include "../../packages/flow/src/turbsim_file.hpp"
#include "fuzz_target.hpp"

#include <array>
#include <string>

namespace {

using namespace culm;

const Where& asking() {
  static const Where where{(fuzz::scratch_folder() / "deck.xml").string(), 1, "Flows / box"};
  return where;
}

flow::TurbulenceGrid read_three(std::string_view bytes) {
  if (bytes.size() < 3) return {};
  std::array<int, 3> points{};
  for (std::size_t i = 0; i < 3; ++i) points[i] = 2 + static_cast<unsigned char>(bytes[i]) % 16;
  bytes.remove_prefix(3);
  const std::size_t third = bytes.size() / 3;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string name(1, "uvw"[i]);
    fuzz::write_scratch(name, bytes.substr(i * third, third));
  }
  return flow::read_mann({"u", "v", "w"}, asking(), points, {1.0, 2.0, 3.0}, 10.0);
}

void check(const flow::TurbulenceGrid& grid) {
  if (grid.values.empty()) return;
  for (const double share : {0.0, 0.3, 1.0}) {
    const Vec3 velocity =
        grid.at(share * grid.width(), share * grid.height(), share * grid.duration());
    if (velocity.allFinite()) continue;
    std::fprintf(stderr, "the wind of a box is not finite\n");
    std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view bytes = fuzz::text_of(data + 1, size - 1);
  fuzz::survive([&] {
    if (data[0] == 'M') {
      check(read_three(bytes));
    } else {
      fuzz::write_scratch("box.bts", bytes);
      check(flow::read_turbsim("box.bts", asking()));
    }
  });
  return 0;
}
