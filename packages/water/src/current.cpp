#include <culm/model/build_context.hpp>
#include <culm/water/current.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace culm::water {
namespace {

Schema with_direction(const std::string& name, const std::string& doc) {
  return Schema(name, doc).add(
      model::vector_field("Direction", "1",
                          "Where it goes to, of any length, without its vertical part; that of the "
                          "waves if absent.")
          .optional());
}

void check_table(const Options& options, InputIssues& issues) {
  const std::vector<double>& depths = options.numbers("Depths");
  if (!std::ranges::is_sorted(depths, std::ranges::less_equal{})) {
    issues.add(options.where("Depths"), "must rise");
  }
  if (depths.size() != options.numbers("Speeds").size()) {
    issues.add(options.where("Speeds"), "must have one value for each of 'Depths'");
  }
}

}  // namespace

Current::Current(Vec3 velocity, double exponent, double depth)
    : velocity_(std::move(velocity)), exponent_(exponent), depth_(depth) {}

Current::Current(Vec3 direction, std::vector<double> depths, std::vector<double> speeds)
    : velocity_(std::move(direction)), depths_(std::move(depths)), speeds_(std::move(speeds)) {}

Vec3 Current::at(double z) const {
  const double below = std::max(-z, 0.0);
  if (depths_.empty()) {
    if (exponent_ == 0.0) return velocity_;
    return std::pow(std::max(1.0 - below / depth_, 0.0), exponent_) * velocity_;
  }
  const auto next = std::ranges::upper_bound(depths_, below);
  if (next == depths_.begin()) return speeds_.front() * velocity_;
  if (next == depths_.end()) return speeds_.back() * velocity_;
  const auto i = static_cast<std::size_t>(next - depths_.begin());
  const double share = (below - depths_[i - 1]) / (depths_[i] - depths_[i - 1]);
  return std::lerp(speeds_[i - 1], speeds_[i], share) * velocity_;
}

Variants current_types() {
  Variants types;
  types.emplace("Uniform", with_direction("Uniform", "The same at all depths.")
                               .add(number("Speed", "m/s", "Its speed.").non_negative()));
  types.emplace("Power Law",
                with_direction("Power Law", "It vanishes at the sea bed.")
                    .add(number("Speed", "m/s", "Speed at still water.").non_negative())
                    .add(number("Exponent", "1", "Of the height above the sea bed over the depth.")
                             .positive()
                             .optional(1.0 / 7.0)));
  types.emplace("Table",
                with_direction("Table", "Linear between given depths, and held outside.")
                    .add(numbers("Depths", "m", "Depths below still water, rising.").min_size(1))
                    .add(numbers("Speeds", "m/s", "Speeds there.").min_size(1))
                    .check(check_table));
  return types;
}

Current read_current(const Options& options, const Vec3& direction, const Vec3& up, double depth) {
  Vec3 along = direction;
  if (options.has("Direction")) {
    along = model::vector(options, "Direction");
    along = (along - along.dot(up) * up).normalized();
  }
  const std::string& type = options.text("Type");
  if (type == "Table") return {along, options.numbers("Depths"), options.numbers("Speeds")};
  const double exponent = type == "Power Law" ? options.number("Exponent") : 0.0;
  return {options.number("Speed") * along, exponent, depth};
}

}  // namespace culm::water
