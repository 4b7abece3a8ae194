#include <culm/deck/units.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace culm::deck {
namespace {

struct NamedUnit {
  const char* name;
  Unit unit;
};

constexpr std::array<int, 5> none = {0, 0, 0, 0, 0};
constexpr std::array<int, 5> length = {1, 0, 0, 0, 0};
constexpr std::array<int, 5> mass = {0, 1, 0, 0, 0};
constexpr std::array<int, 5> time = {0, 0, 1, 0, 0};
constexpr std::array<int, 5> frequency = {0, 0, -1, 0, 0};
constexpr std::array<int, 5> temperature = {0, 0, 0, 1, 0};
constexpr std::array<int, 5> angle = {0, 0, 0, 0, 1};
constexpr std::array<int, 5> angular_velocity = {0, 0, -1, 0, 1};
constexpr std::array<int, 5> force = {1, 1, -2, 0, 0};
constexpr std::array<int, 5> pressure = {-1, 1, -2, 0, 0};
constexpr std::array<int, 5> energy = {2, 1, -2, 0, 0};
constexpr std::array<int, 5> power = {2, 1, -3, 0, 0};

constexpr std::array table = {
    NamedUnit{"1", {none, 1, 1}},
    NamedUnit{"%", {none, 1, 100}},
    NamedUnit{"m", {length, 1, 1}},
    NamedUnit{"mm", {length, 1, 1e3}},
    NamedUnit{"cm", {length, 1, 1e2}},
    NamedUnit{"km", {length, 1e3, 1}},
    NamedUnit{"in", {length, 254, 1e4}},
    NamedUnit{"ft", {length, 3048, 1e4}},
    NamedUnit{"kg", {mass, 1, 1}},
    NamedUnit{"g", {mass, 1, 1e3}},
    NamedUnit{"t", {mass, 1e3, 1}},
    NamedUnit{"s", {time, 1, 1}},
    NamedUnit{"ms", {time, 1, 1e3}},
    NamedUnit{"us", {time, 1, 1e6}},
    NamedUnit{"min", {time, 60, 1}},
    NamedUnit{"h", {time, 3600, 1}},
    NamedUnit{"Hz", {frequency, 1, 1}},
    NamedUnit{"kHz", {frequency, 1e3, 1}},
    NamedUnit{"K", {temperature, 1, 1}},
    NamedUnit{"rad", {angle, 1, 1}},
    NamedUnit{"deg", {angle, std::numbers::pi, 180}},
    NamedUnit{"rpm", {angular_velocity, std::numbers::pi, 30}},
    NamedUnit{"N", {force, 1, 1}},
    NamedUnit{"mN", {force, 1, 1e3}},
    NamedUnit{"kN", {force, 1e3, 1}},
    NamedUnit{"MN", {force, 1e6, 1}},
    NamedUnit{"Pa", {pressure, 1, 1}},
    NamedUnit{"hPa", {pressure, 1e2, 1}},
    NamedUnit{"kPa", {pressure, 1e3, 1}},
    NamedUnit{"MPa", {pressure, 1e6, 1}},
    NamedUnit{"GPa", {pressure, 1e9, 1}},
    NamedUnit{"bar", {pressure, 1e5, 1}},
    NamedUnit{"J", {energy, 1, 1}},
    NamedUnit{"kJ", {energy, 1e3, 1}},
    NamedUnit{"MJ", {energy, 1e6, 1}},
    NamedUnit{"W", {power, 1, 1}},
    NamedUnit{"kW", {power, 1e3, 1}},
    NamedUnit{"MW", {power, 1e6, 1}},
};

constexpr int max_power = 12;
constexpr int max_nesting = 16;

Unit raised(const Unit& unit, int exponent) {
  Unit result;
  const int times = exponent < 0 ? -exponent : exponent;
  for (std::size_t i = 0; i < result.powers.size(); ++i) {
    result.powers[i] = unit.powers[i] * exponent;
  }
  result.numerator = std::pow(exponent < 0 ? unit.denominator : unit.numerator, times);
  result.denominator = std::pow(exponent < 0 ? unit.numerator : unit.denominator, times);
  return result;
}

Unit product(const Unit& a, const Unit& b) {
  Unit result = a;
  for (std::size_t i = 0; i < result.powers.size(); ++i) result.powers[i] += b.powers[i];
  result.numerator *= b.numerator;
  result.denominator *= b.denominator;
  return result;
}

/// product = power { ("*" | "/" | " ") power };  power = atom ["^" integer];
/// atom = name | "1" | "(" product ")". A "/" divides by the next power only.
class UnitParser {
 public:
  explicit UnitParser(std::string_view text) : rest_(text) {}

  std::optional<Unit> parse() {
    const std::optional<Unit> unit = parse_product();
    return rest_.empty() ? unit : std::nullopt;
  }

 private:
  std::optional<Unit> parse_product() {
    if (++nesting_ > max_nesting) return std::nullopt;
    std::optional<Unit> result = parse_power();
    while (result) {
      skip_blanks();
      if (rest_.empty() || rest_.front() == ')') break;
      const bool divides = accept('/');
      if (!divides) accept('*');
      const std::optional<Unit> factor = parse_power();
      if (!factor) return std::nullopt;
      result = product(*result, divides ? raised(*factor, -1) : *factor);
    }
    --nesting_;
    return result;
  }

  std::optional<Unit> parse_power() {
    const std::optional<Unit> atom = parse_atom();
    if (!atom || !accept('^')) return atom;
    const bool negative = accept('-');
    skip_blanks();
    int exponent = 0;
    if (rest_.empty() || !is_digit(rest_.front())) return std::nullopt;
    while (!rest_.empty() && is_digit(rest_.front())) {
      exponent = 10 * exponent + (rest_.front() - '0');
      if (exponent > max_power) return std::nullopt;
      rest_.remove_prefix(1);
    }
    const Unit result = raised(*atom, negative ? -exponent : exponent);
    // Nested parentheses could multiply exponents beyond any meaning.
    const bool sane = std::ranges::all_of(result.powers, [](int p) { return std::abs(p) < 100; });
    return sane ? std::optional(result) : std::nullopt;
  }

  std::optional<Unit> parse_atom() {
    if (accept('(')) {
      const std::optional<Unit> inner = parse_product();
      return accept(')') ? inner : std::nullopt;
    }
    std::size_t end = 0;
    while (end < rest_.size() && is_name(rest_[end])) ++end;
    if (end == 0 && !rest_.empty() && (rest_.front() == '1' || rest_.front() == '%')) end = 1;
    const std::string_view name = rest_.substr(0, end);
    for (const NamedUnit& entry : table) {
      if (name != entry.name) continue;
      rest_.remove_prefix(end);
      return entry.unit;
    }
    return std::nullopt;
  }

  bool accept(char symbol) {
    skip_blanks();
    if (rest_.empty() || rest_.front() != symbol) return false;
    rest_.remove_prefix(1);
    skip_blanks();
    return true;
  }

  void skip_blanks() {
    while (!rest_.empty() && rest_.front() == ' ') rest_.remove_prefix(1);
  }

  static bool is_digit(char c) { return c >= '0' && c <= '9'; }
  static bool is_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

  std::string_view rest_;
  int nesting_ = 0;
};

}  // namespace

std::optional<Unit> find_unit(std::string_view text) { return UnitParser(text).parse(); }

std::vector<std::string> unit_names() {
  std::vector<std::string> names;
  for (const NamedUnit& entry : table) names.emplace_back(entry.name);
  return names;
}

}  // namespace culm::deck
