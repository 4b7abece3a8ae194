#include <culm/base/error.hpp>
#include <culm/base/options.hpp>

#include <algorithm>

namespace culm {

Options::Options(std::string name, Where where)
    : name_(std::move(name)), where_(std::move(where)) {}

const Where& Options::where(const std::string& name) const {
  const Parameter& found = parameter(name);
  return found.given ? found.where : where_;
}

double Options::number(const std::string& name) const { return value<double>(name); }
int Options::integer(const std::string& name) const { return value<int>(name); }
bool Options::flag(const std::string& name) const { return value<bool>(name); }

const std::string& Options::text(const std::string& name) const { return value<std::string>(name); }

const std::vector<double>& Options::numbers(const std::string& name) const {
  return value<std::vector<double>>(name);
}

const std::vector<int>& Options::integers(const std::string& name) const {
  return value<std::vector<int>>(name);
}

const std::vector<std::string>& Options::texts(const std::string& name) const {
  return value<std::vector<std::string>>(name);
}

bool Options::has(const std::string& name) const { return parameter(name).value.has_value(); }

bool Options::given(const std::string& name) const { return parameter(name).given; }

const Options& Options::list(const std::string& name) const {
  const Options* found = find_list(name);
  internal_check(found != nullptr, "list '" + name + "' was read from '" + name_ +
                                       "', where it is absent or not declared");
  return *found;
}

bool Options::has_list(const std::string& name) const {
  if (find_list(name)) return true;
  const bool declared =
      has_entries_ || std::ranges::find(absent_lists_, name) != absent_lists_.end();
  internal_check(declared, "list '" + name + "' is not declared in '" + name_ + "'");
  return false;
}

Options& Options::set(const std::string& name, Value value) {
  return set(name, std::move(value), true, where_);
}

Options& Options::set(const std::string& name, Value value, bool given, Where where) {
  declare(name);
  const auto found = std::ranges::find(parameters_, name, &Parameter::name);
  *found = Parameter{name, std::move(value), given, std::move(where)};
  return *this;
}

Options& Options::declare(const std::string& name) {
  if (!find_parameter(name)) parameters_.push_back(Parameter{name, std::nullopt, false, where_});
  return *this;
}

Options& Options::declare_list(const std::string& name) {
  absent_lists_.push_back(name);
  return *this;
}

Options& Options::add_list(Options list) {
  lists_.push_back(std::move(list));
  return *this;
}

Options& Options::add_entry(Options entry) {
  entries_.push_back(std::move(entry));
  return declare_entries();
}

Options& Options::declare_entries() {
  has_entries_ = true;
  return *this;
}

const Options::Parameter* Options::find_parameter(const std::string& name) const {
  const auto found = std::ranges::find(parameters_, name, &Parameter::name);
  return found == parameters_.end() ? nullptr : &*found;
}

const Options* Options::find_list(const std::string& name) const {
  for (const std::vector<Options>* lists : {&lists_, &entries_}) {
    const auto found = std::ranges::find(*lists, name, &Options::name_);
    if (found != lists->end()) return &*found;
  }
  return nullptr;
}

const Options::Parameter& Options::parameter(const std::string& name) const {
  const Parameter* found = find_parameter(name);
  internal_check(found != nullptr, "parameter '" + name + "' is not declared in '" + name_ + "'");
  return *found;
}

template <class T>
const T& Options::value(const std::string& name) const {
  const Parameter& found = parameter(name);
  internal_check(found.value.has_value(),
                 "parameter '" + name + "' of '" + name_ + "' was read but has no value");
  const T* value = std::get_if<T>(&*found.value);
  internal_check(value != nullptr, "parameter '" + name + "' of '" + name_ + "' holds a " +
                                       to_string(kind_of(*found.value)) +
                                       " and was read as another kind");
  return *value;
}

}  // namespace culm
