#include "driver/program/number_option.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <optional>
#include <system_error>
#include <vector>

#include "driver/program/errors.hpp"

namespace tanktread::driver {
namespace {

/// How a number lies in a target, and how many of them.
template <class Target>
struct Layout {
  using Number = Target;
  static constexpr int least = 1, most = 1;
  static void store(Target& target, const std::vector<Number>& numbers) { target = numbers.front(); }
  static std::string text(const Target& target) { return fmt::format("{}", target); }
};

template <class Held>
struct Layout<std::optional<Held>> : Layout<Held> {
  static void store(std::optional<Held>& target, const std::vector<Held>& numbers) {
    target = numbers.front();
  }
  static std::string text(const std::optional<Held>&) { return ""; }
};

template <class Held>
struct Layout<std::vector<Held>> {
  using Number = Held;
  static constexpr int least = 1, most = CLI::detail::expected_max_vector_size;
  static void store(std::vector<Held>& target, const std::vector<Held>& numbers) { target = numbers; }
  static std::string text(const std::vector<Held>& target) {
    return fmt::format("[{}]", fmt::join(target, ","));
  }
};

template <class Held, std::size_t n>
struct Layout<std::array<Held, n>> {
  using Number = Held;
  static constexpr int least = n, most = n;
  static void store(std::array<Held, n>& target, const std::vector<Held>& numbers) {
    std::copy_n(numbers.begin(), n, target.begin());
  }
  static std::string text(const std::array<Held, n>& target) {
    return fmt::format("[{}]", fmt::join(target, ","));
  }
};

template <class Number>
constexpr bool is_integer = std::is_integral_v<Number>;

/// A sign + is none to from_chars, but to everybody else.
std::string_view without_plus(const std::string& text) {
  const bool has_plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
  return std::string_view(text).substr(has_plus ? 1 : 0);
}

/// The number that the whole of a text is, or why it is none.
template <class Number>
std::errc parse(const std::string& text, Number& number) {
  const auto digits = without_plus(text);
  const auto end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, number);
  return stop == end ? error : std::errc::invalid_argument;
}

/// What to write in place of 3,5; "" for any other text.
std::string comma_hint(std::string text, bool is_list) {
  const auto comma = text.find(',');
  if (comma == std::string::npos) return "";
  text[comma] = '.';
  double number = 0;
  const bool is_decimal = parse(text, number) == std::errc();
  if (!is_list) return is_decimal ? fmt::format("; write {}", text) : "";
  if (is_decimal) {
    auto two = text;
    two[comma] = ' ';
    return fmt::format("; write {}, or {} for two values", text, two);
  }
  return "; separate values by spaces";
}

template <class Number>
Number number_of(const std::string& text, const std::string& option, const NumberRange& range, bool is_list) {
  const auto allowed = (is_integer<Number> ? "an integer in decimal digits" : "a number") + range.text();
  const auto refuse = [&](const std::string& what) {
    throw InputError(fmt::format("{} {}: {}", option, text.empty() ? "\"\"" : text, what));
  };
  using Parsed = std::conditional_t<is_integer<Number>, std::int64_t, double>;
  Parsed number = 0;
  const auto error = parse(text, number);
  if (error == std::errc::result_out_of_range && !is_integer<Number>)
    refuse("is beyond what a number of double precision holds; must be " + allowed);
  if (error == std::errc::invalid_argument && !is_integer<Number>) {
    const auto hint = comma_hint(text, is_list);
    refuse(hint.empty() ? "is no number; must be " + allowed : "is no number" + hint);
  }
  if (!std::isfinite(static_cast<double>(number))) refuse("is not finite; must be " + allowed);
  if (error != std::errc() || !range.contains(static_cast<double>(number))) {
    refuse("must be " + allowed + (is_list && is_integer<Number> ? comma_hint(text, true) : ""));
  }
  return static_cast<Number>(number);
}

}  // namespace

template <class Target>
CLI::Option* add_number(CLI::App& command, const std::string& name, Target& target,
                        const std::string& meaning, const NumberRange& range) {
  using Form = Layout<Target>;
  using Number = typename Form::Number;
  const auto read = [&target, name, range](const CLI::results_t& texts) {
    std::vector<Number> numbers;
    for (const auto& text : texts)
      numbers.push_back(number_of<Number>(text, name, range, Form::most > Form::least));
    Form::store(target, numbers);
    return true;
  };
  auto* option = command.add_option(name, CLI::callback_t(read), meaning, false,
                                    [&target] { return Form::text(target); });
  option->type_name(is_integer<Number> ? integer_type : number_type);
  // A list may go on over several words, "--n 1 2 3".
  return option->expected(Form::least, Form::most)->allow_extra_args(Form::most > Form::least);
}

template CLI::Option* add_number(CLI::App&, const std::string&, int&, const std::string&, const NumberRange&);
template CLI::Option* add_number(CLI::App&, const std::string&, std::int64_t&, const std::string&,
                                 const NumberRange&);
template CLI::Option* add_number(CLI::App&, const std::string&, std::optional<std::int64_t>&,
                                 const std::string&, const NumberRange&);
template CLI::Option* add_number(CLI::App&, const std::string&, std::vector<int>&, const std::string&,
                                 const NumberRange&);
template CLI::Option* add_number(CLI::App&, const std::string&, double&, const std::string&,
                                 const NumberRange&);
template CLI::Option* add_number(CLI::App&, const std::string&, std::vector<double>&, const std::string&,
                                 const NumberRange&);
template CLI::Option* add_number(CLI::App&, const std::string&, std::array<double, 3>&, const std::string&,
                                 const NumberRange&);

}  // namespace tanktread::driver
