// Which member of a case a key is: the pieces from which the table of keys (schema_keys.cpp) is made.
#pragma once

#include <optional>
#include <type_traits>
#include <utility>

#include "driver/case/schema.hpp"

namespace tanktread::driver {

/// A member of the case by the path of members that leads to it.
template <auto... members>
struct InCase {
  static bool is_there(const Case&) { return true; }
  static auto& of(auto& the_case, std::size_t) { return (the_case.*....*members); }
};

/// A member of a capsule.
template <auto... members>
struct InCapsule {
  static bool is_there(const Case&) { return true; }
  static auto& of(auto& the_case, std::size_t capsule) { return (the_case.capsules[capsule].*....*members); }
};

/// A member of [si]. To set one makes the table.
template <auto member>
struct InSi {
  static bool is_there(const Case& the_case) { return the_case.si.has_value(); }
  static const auto& of(const Case& the_case, std::size_t) { return (*the_case.si).*member; }
  static auto& of(Case& the_case, std::size_t) {
    if (!the_case.si) the_case.si.emplace();
    return (*the_case.si).*member;
  }
};

template <typename Member>
struct HeldBy {
  using type = Member;
};
template <typename Member>
struct HeldBy<std::optional<Member>> {
  using type = Member;
};

template <typename Place>
using MemberType = std::remove_cvref_t<decltype(Place::of(std::declval<Case&>(), 0))>;

template <typename Place>
Value get_member(const Case& the_case, std::size_t capsule) {
  if (!Place::is_there(the_case)) return {};
  const auto& member = Place::of(the_case, capsule);
  if constexpr (std::is_same_v<MemberType<Place>, typename HeldBy<MemberType<Place>>::type>) {
    return member;
  } else {
    return member ? Value(*member) : Value();
  }
}

template <typename Place>
void set_member(Case& the_case, std::size_t capsule, const Value& value) {
  using Member = typename HeldBy<MemberType<Place>>::type;
  if constexpr (!std::is_same_v<MemberType<Place>, Member>) {
    if (!is_given(value)) {  // the default of a key that is optional
      Place::of(the_case, capsule).reset();
      return;
    }
  }
  Place::of(the_case, capsule) = std::get<Member>(value);
}

/// An axis is 0, 1, 2 in the case and a letter in the file.
template <typename Place>
Value get_axis(const Case& the_case, std::size_t capsule) {
  return std::string(1, "xyz"[Place::of(the_case, capsule)]);
}

template <typename Place>
void set_axis(Case& the_case, std::size_t capsule, const Value& value) {
  Place::of(the_case, capsule) = std::get<std::string>(value)[0] - 'x';
}

/// A key in the making: `key<Place>(...)` and then what it may hold.
struct KeyMaker {
  Key key;

  KeyMaker above(double least) {
    return key.range.least = least, key.range.least_included = false, std::move(*this);
  }
  KeyMaker from(double least) { return key.range.least = least, std::move(*this); }
  KeyMaker to(double greatest) { return key.range.greatest = greatest, std::move(*this); }
  KeyMaker below(double greatest) {
    return key.range.greatest = greatest, key.range.greatest_included = false, std::move(*this);
  }
  KeyMaker one_of(std::vector<std::string> choices) {
    return key.choices = std::move(choices), std::move(*this);
  }
  KeyMaker preset(std::string words) { return key.preset = std::move(words), std::move(*this); }
  KeyMaker required() { return preset("required"); }
  KeyMaker unless(std::string (*objection)(const Case&, std::size_t)) {
    return key.objection = objection, std::move(*this);
  }
  KeyMaker free_on_resume() { return key.may_change_on_resume = true, std::move(*this); }
  operator Key() && { return std::move(key); }
};

/// The default is that of the member, as the structs of case.hpp have it, unless `preset` says otherwise.
template <typename Place>
KeyMaker key(std::string path, std::string unit, std::string meaning) {
  Case defaults;
  defaults.capsules.emplace_back();
  KeyMaker maker;
  maker.key.path = std::move(path);
  maker.key.kind =
      static_cast<Kind>(Value(std::in_place_type<typename HeldBy<MemberType<Place>>::type>).index());
  maker.key.unit = std::move(unit);
  maker.key.meaning = std::move(meaning);
  maker.key.get = get_member<Place>;
  maker.key.set = set_member<Place>;
  maker.key.preset = toml_text(get_member<Place>(defaults, 0));
  return maker;
}

template <typename Place>
KeyMaker axis_key(std::string path, std::string meaning) {
  auto maker = key<Place>(std::move(path), "", std::move(meaning));
  Case defaults;
  maker.key.kind = Kind::text;
  maker.key.get = get_axis<Place>;
  maker.key.set = set_axis<Place>;
  maker.key.preset = toml_text(get_axis<Place>(defaults, 0));
  return std::move(maker).one_of({"x", "y", "z"});
}

/// For KeyMaker::unless(): a viscosity ratio that [si] says as two viscosities.
inline std::string refuse_beside_inner_viscosity(const Case& the_case, std::size_t) {
  if (!the_case.si || !the_case.si->inner_viscosity_Pa_s) return "";
  return "contradicts si.inner_viscosity_Pa_s, from which it follows; remove one of them";
}

}  // namespace tanktread::driver
