#include "driver/case/node_value.hpp"

#include <algorithm>
#include <optional>
#include <sstream>

namespace tanktread::driver {
namespace {

std::optional<double> real_of(const toml::node& node, const Key& key) {
  double value = 0;
  if (const auto* real = node.as_floating_point()) {
    value = real->get();
  } else if (const auto* integer = node.as_integer()) {
    value = static_cast<double>(integer->get());
  } else {
    return std::nullopt;
  }
  return key.range.contains(value) ? std::optional(value) : std::nullopt;
}

std::optional<int> integer_of(const toml::node& node, const Key& key) {
  const auto* integer = node.as_integer();
  if (integer == nullptr || !key.range.contains(static_cast<double>(integer->get()))) return std::nullopt;
  if (integer->get() != static_cast<int>(integer->get())) return std::nullopt;
  return static_cast<int>(integer->get());
}

std::optional<std::string> text_of(const toml::node& node, const Key& key) {
  const auto* text = node.as_string();
  if (text == nullptr) return std::nullopt;
  const auto& choices = key.choices;
  if (!choices.empty() && std::find(choices.begin(), choices.end(), text->get()) == choices.end()) return {};
  return text->get();
}

/// An array of exactly n elements, each of which `element_of` reads.
template <typename Element, std::size_t n, typename ElementOf>
std::optional<std::array<Element, n>> array_of(const toml::node& node, const Key& key,
                                               const ElementOf& element_of) {
  const auto* array = node.as_array();
  if (array == nullptr || array->size() != n) return std::nullopt;
  std::array<Element, n> elements;
  for (std::size_t k = 0; k < n; ++k) {
    const auto element = element_of(*array->get(k), key);
    if (!element) return std::nullopt;
    elements[k] = *element;
  }
  return elements;
}

/// An array of any length that holds texts only.
std::optional<std::vector<std::string>> texts_of(const toml::node& node, const Key& key) {
  const auto* array = node.as_array();
  if (array == nullptr) return std::nullopt;
  std::vector<std::string> texts;
  for (const auto& element : *array) {
    const auto text = text_of(element, key);
    if (!text) return std::nullopt;
    texts.push_back(*text);
  }
  return texts;
}

template <typename Held>
Value to_value(const std::optional<Held>& held) {
  return held ? Value(*held) : Value();
}

}  // namespace

Value value_of(const toml::node& node, const Key& key) {
  switch (key.kind) {
    case Kind::none:
      break;
    case Kind::boolean:
      return node.is_boolean() ? Value(node.as_boolean()->get()) : Value();
    case Kind::integer:
      return to_value(integer_of(node, key));
    case Kind::real:
      return to_value(real_of(node, key));
    case Kind::text:
      return to_value(text_of(node, key));
    case Kind::integers3:
      return to_value(array_of<int, 3>(node, key, integer_of));
    case Kind::reals3:
      return to_value(array_of<double, 3>(node, key, real_of));
    case Kind::ranges3:
      return to_value(array_of<std::array<int, 2>, 3>(
          node, key, [](const toml::node& n, const Key& k) { return array_of<int, 2>(n, k, integer_of); }));
    case Kind::texts:
      return to_value(texts_of(node, key));
  }
  return {};
}

std::string node_text(const toml::node& node) {
  if (const auto* real = node.as_floating_point()) return toml_text(Value(real->get()));
  if (const auto* text = node.as_string()) return toml_text(Value(text->get()));
  if (const auto* array = node.as_array()) {
    std::string elements;
    for (const auto& element : *array) elements += (elements.empty() ? "" : ", ") + node_text(element);
    return "[" + elements + "]";
  }
  std::ostringstream text;
  node.visit([&](const auto& value) { text << value; });
  return text.str();
}

}  // namespace tanktread::driver
