#include "box.hpp"
#include "tower_influence.hpp"
#include "turbsim_file.hpp"

namespace culm::flow {

void register_turbsim_box(FlowRegistry& registry) {
  add_wind(
      registry, "TurbSim Box",
      box_schema("TurbSim Box", "Turbulence of a file of TurbSim, which contains the mean wind.")
          .add(text("File Name",
                    "Binary file (.bts), relative to the deck. Points of a tower "
                    "below the grid are not used.")),
      [](const Options& options, model::BuildContext&) -> SharedFlow {
        return make_box(options,
                        read_turbsim(options.text("File Name"), options.where("File Name")));
      });
}

}  // namespace culm::flow
