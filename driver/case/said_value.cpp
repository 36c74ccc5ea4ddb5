#include "driver/case/said_value.hpp"

namespace tanktread::driver {

bool has_place(const Key& key, const Case& the_case, std::size_t capsule) {
  return key.objection == nullptr || key.objection(the_case, capsule).empty();
}

Value said_value(const Key& key, const Case& the_case, std::size_t capsule) {
  return has_place(key, the_case, capsule) ? key.get(the_case, capsule) : Value();
}

bool is_shared(const Key& key, const Case& the_case) {
  for (std::size_t k = 0; k < the_case.capsules.size(); ++k) {
    if (key.get(the_case, k) != key.get(the_case, 0) || !has_place(key, the_case, k)) return false;
  }
  return true;
}

}  // namespace tanktread::driver
