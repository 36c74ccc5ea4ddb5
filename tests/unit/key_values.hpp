// Values for tests that go over all keys of the schema.
#pragma once

#include "driver/case/schema.hpp"

namespace tanktread::testing {

/// A key that is true where no case says anything.
inline bool is_true_by_default(const driver::Key& key) {
  driver::Case defaults;
  defaults.capsules.emplace_back();
  return std::get<bool>(key.get(defaults, 0));
}

/// A value the key may hold that is not its default.
inline driver::Value another_value(const driver::Key& key) {
  using driver::Kind;
  switch (key.kind) {
    case Kind::boolean:
      return driver::Value(!is_true_by_default(key));
    case Kind::integer:
      return 7;
    case Kind::real:
      return 0.625;
    case Kind::text:
      return key.choices.size() < 2 ? std::string("another") : key.choices.back();
    case Kind::integers3:
      return std::array<int, 3>{7, 8, 9};
    case Kind::reals3:
      return std::array<double, 3>{0.5, 1.5, 2.5};
    case Kind::ranges3:
      return driver::Ranges3{{{1, 2}, {3, 4}, {5, 6}}};
    case Kind::texts:
      return std::vector<std::string>{"one", "two words"};
    case Kind::none:
      break;
  }
  return {};
}

}  // namespace tanktread::testing
