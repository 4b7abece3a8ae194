#pragma once

#include <culm/base/schema.hpp>

#include <string>

namespace culm::deck {

/// The input reference, as Markdown: every list and type with its parameters, their kinds, units,
/// bounds, defaults and meanings. With a name, only the lists, types and parameters of that name
/// (without regard to case); throws UsageError, with the nearest name, if there is none.
std::string reference(const Schema& root, const std::string& name = {});

}  // namespace culm::deck
