/// Where functions of time change abruptly.
#pragma once

#include <culm/model/amplitude.hpp>

#include <map>
#include <string>
#include <vector>

namespace culm::analysis {

/// Times of jumps and corners at which adaptive steps end, rising [s]: of a function the first and
/// the last, and those between that are away from the line between their neighbours. Fine tables of
/// smooth functions have few.
std::vector<double> notable_corners(const std::map<std::string, model::Amplitude>& functions);

}  // namespace culm::analysis
