#pragma once

// This header stays C++17, as the one source that implements it.

#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>

#include <string>

namespace culm::deck {

/// Lets Teuchos judge what the deck gave: a ParameterList of the given values is validated against
/// one made from the schema, which also fills in the defaults. Returns Teuchos' objection, or the
/// first value in which its result differs from `options`; empty if all agree.
std::string teuchos_objection(const Options& options, const Schema& schema);

}  // namespace culm::deck
