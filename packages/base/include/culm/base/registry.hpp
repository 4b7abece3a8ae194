#pragma once

#include <culm/base/error.hpp>
#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace culm {

/// The types of one family by their names in the deck: the schema of each and how to make one.
/// There are no global registries: whoever needs one fills it and passes it on.
template <class Product, class... Args>
class Registry {
 public:
  using Make = std::function<Product(const Options&, Args...)>;

  /// Adds a type under its name in the deck. Adding a name twice is an InternalError.
  void add(std::string name, Schema schema, Make make) {
    internal_check(!types_.contains(name), "type '" + name + "' is registered twice");
    types_.emplace(std::move(name), Type{std::move(schema), std::move(make)});
  }

  /// Makes a product of a type. Throws InputError at the place of `options` for an unknown type.
  Product make(const std::string& type, const Options& options, Args... args) const {
    const auto found = types_.find(type);
    if (found == types_.end()) {
      throw InputError(options.where(),
                       "unknown type '" + type + "'" + did_you_mean(type, names()));
    }
    return found->second.make(options, std::forward<Args>(args)...);
  }

  bool contains(const std::string& type) const { return types_.contains(type); }

  /// Names of the types in alphabetical order.
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& [name, type] : types_) names.push_back(name);
    return names;
  }

  /// The schemas by type name, for Schema::list_by_type and Schema::entries_by_type.
  Variants variants() const {
    Variants variants;
    for (const auto& [name, type] : types_) variants.emplace(name, type.schema);
    return variants;
  }

 private:
  struct Type {
    Schema schema;
    Make make;
  };
  std::map<std::string, Type> types_;
};

}  // namespace culm
