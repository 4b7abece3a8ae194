/// What the report of a turbine says of its yaw and its masses.
#pragma once

#include <culm/openfast/elastodyn.hpp>
#include <culm/openfast/report.hpp>

#include "turbine_layout.hpp"

#include <string>

namespace culm::openfast {

/// In one sentence, why the nacelle does not turn.
std::string why_locked(const ElastoDyn& turbine);
/// What a twisting tower and a yawing nacelle do, by the nacelle and a rigid rotor on a spring.
void report_yaw(const ElastoDyn& turbine, const TurbineLayout& layout, Report& report);
/// Masses of tower, nacelle, rotor and head; of blades also as ElastoDyn adds them up.
void report_masses(const ElastoDyn& turbine, Report& report);

}  // namespace culm::openfast
