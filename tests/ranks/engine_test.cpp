// What goes wrong in the membranes of a run on any number of ranks, where no case of a user's is known that
// makes it: the engine of many ranks says of a spoilt state what that of one process says.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <utility>

#include "driver/case/case.hpp"
#include "driver/engine/followers.hpp"
#include "driver/engine/many_ranks.hpp"
#include "driver/engine/one_process.hpp"
#include "driver/packets/saved_state.hpp"
#include "driver/program/errors.hpp"
#include "driver/system/run_ranks.hpp"
#include "tests/ranks/world.hpp"

namespace tanktread::driver::test {
namespace {

using ranks::test::all_ranks;

/// Two spheres in shear, a diameter and a half from each other, which cuts in two, four and six parts divide.
constexpr auto two_spheres = R"(
[flow]
kind = "shear"
box = [24, 20, 18]
wall_speed = 0.02
[[capsule]]
radius = 3
position = [7.2, 10.1, 9]
mesh = { shape = "sphere", level = 1 }
[[capsule]]
radius = 3
position = [16.3, 10.1, 9]
mesh = { shape = "sphere", level = 1 }
[membrane]
elastic_law = "skalak"
capillary_number = 0.3
[run]
shear_time = 0.01
)";

/// Undoes something whatever is thrown; else the other ranks would wait.
class Finally {
 public:
  explicit Finally(std::function<void()> undo) : undo_(std::move(undo)) {}
  ~Finally() { undo_(); }
  Finally(const Finally&) = delete;
  Finally& operator=(const Finally&) = delete;

 private:
  std::function<void()> undo_;
};

/// The case, and its state before the first step, on the first rank.
class Spoilt {
 public:
  explicit Spoilt(const std::string& viscosity_ratio)
      : folder_(std::filesystem::temp_directory_path() / ("tanktread-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "case.toml") << two_spheres;
    the_case = read_case(folder_ / "case.toml", {"flow.viscosity_ratio=" + viscosity_ratio});
    parameters = driver::parameters(the_case);
    OneProcess engine(the_case, parameters);
    engine.begin({});
    engine.write_state(folder_ / "state");
    state = read_state(folder_ / "state");
  }
  ~Spoilt() { std::filesystem::remove_all(folder_); }
  Spoilt(const Spoilt&) = delete;
  Spoilt& operator=(const Spoilt&) = delete;

  /// What the program would print after `use` of either engine.
  std::string said_by_one(const std::function<void(Engine&)>& use) const {
    OneProcess engine(the_case, parameters);
    return message_of(use, engine);
  }
  std::string said_by_many(const std::function<void(Engine&)>& use) const {
    const Finally alone([] { set_ranks(nullptr); });
    set_ranks(all_ranks);
    ManyRanks engine(the_case, parameters);
    return message_of(use, engine);
  }

  Case the_case;
  Parameters parameters;
  SavedState state;

 private:
  static std::string message_of(const std::function<void(Engine&)>& use, Engine& engine) {
    try {
      use(engine);
    } catch (const InputError& error) {
      return std::string("bad input: ") + error.what();
    } catch (const RunError& error) {
      return std::string("run failed: ") + error.what();
    }
    return "";
  }

  std::filesystem::path folder_;
};

/// A test of the first rank, which the others follow.
void on_all_ranks(const std::string& viscosity_ratio, const std::function<void(Spoilt&)>& test) {
  if (all_ranks->size() == 1) GTEST_SKIP() << "is of several ranks";
  if (!all_ranks->is_first()) return follow(*all_ranks);
  const Finally over([] { end_followers(*all_ranks); });
  Spoilt spoilt(viscosity_ratio);
  test(spoilt);
}

TEST(Engine, of_many_ranks_says_of_capsules_that_overlap_what_one_process_says) {
  on_all_ranks("3", [](Spoilt& spoilt) {
    auto& positions = spoilt.state.positions[1];
    positions.row(0).array() -= 4.6;  // the middles 4.5 apart
    const auto restore = [&](Engine& engine) { engine.restore(spoilt.state); };
    const auto restored = spoilt.said_by_one(restore);
    EXPECT_TRUE(restored.starts_with("bad input: ")) << restored;
    EXPECT_NE(restored.find("surface 1"), std::string::npos) << restored;
    EXPECT_EQ(spoilt.said_by_many(restore), restored);

    auto shapes = spoilt.state.shapes;
    shapes.meshes[1].points = positions;
    const auto begin = [&](Engine& engine) { engine.begin(shapes); };
    const auto begun = spoilt.said_by_one(begin);
    EXPECT_NE(begun.find("move the capsule"), std::string::npos) << begun;
    EXPECT_EQ(spoilt.said_by_many(begin), begun);
  });
}

TEST(Engine, of_many_ranks_says_of_a_node_without_a_normal_what_one_process_says) {
  on_all_ranks("1", [](Spoilt& spoilt) {
    auto& positions = spoilt.state.positions[1];
    const auto& triangles = spoilt.state.shapes.meshes[1].triangles;
    positions.col(triangles(0, 7)) = positions.col(triangles(1, 7));
    const std::function<void(Engine&)> uses[] = {[](Engine& engine) { engine.advance(); },
                                                 [](Engine& engine) { engine.energy_budget(); }};
    for (const auto& use : uses) {
      const auto after_restore = [&](Engine& engine) {
        engine.restore(spoilt.state);
        use(engine);
      };
      const auto said = spoilt.said_by_one(after_restore);
      EXPECT_TRUE(said.starts_with("run failed: step ")) << said;
      EXPECT_NE(said.find("normal"), std::string::npos) << said;
      EXPECT_EQ(spoilt.said_by_many(after_restore), said);
    }
  });
}

}  // namespace
}  // namespace tanktread::driver::test
