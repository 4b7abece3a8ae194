/// Lists that no deck wrote.
#pragma once

#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>

#include <string>

namespace culm {

/// A list as a deck that says nothing would give it: parameters and lists of the schema with their
/// defaults, but no list whose type has to be chosen. For types that are made of others, and for
/// tests.
/// @param where  what messages about it shall name
Options default_list(const Schema& schema, std::string name, const Where& where);

}  // namespace culm
