/// Vectors in the directors of a node that has one director only.
#pragma once

#include <culm/model/build_context.hpp>

#include <span>
#include <string>

namespace culm::model {

/// Adds an issue if a node is one of a shell, which has one director d, and a vector in directors
/// has another component than the first, which would be lost.
void check_components(const Vec3& vector, const Where& where, std::span<const int> nodes,
                      BuildContext& context);
/// The same of a parameter of the deck.
void check_components(const std::string& parameter, std::span<const int> nodes,
                      const Options& options, BuildContext& context);

}  // namespace culm::model
