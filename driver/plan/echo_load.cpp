#include "driver/plan/echo_load.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "driver/system/loads.hpp"
#include "driver/units/load_units.hpp"
#include "driver/units/schedule.hpp"

namespace tanktread::driver {
namespace {

void put_patch(EchoTable& table, const Subject& subject, const std::string& name,
               const membrane::EndPatch& patch, double mesh_area) {
  table.row(name, fmt::format("{} nodes", patch.nodes.size()), "",
            fmt::format("{:.4g} of the area", patch.area / mesh_area));
  table.row("  its width", fmt::format("{:.4g}", patch.width), in_si(subject, patch.width, metre, "m"),
            "grid steps, along the axis");
}

}  // namespace

std::optional<membrane::EndPatches> load_patches_of(const CapsuleCase& capsule,
                                                    const membrane::TriangleMesh& start) {
  if (!has_load(capsule)) return std::nullopt;
  return load_patches(capsule.load, start);
}

void put_load(EchoTable& table, const Subject& subject, std::size_t number_of_it,
              const std::optional<membrane::EndPatches>& patches) {
  const auto& capsule = subject.the_case.capsules[number_of_it];
  if (!has_load(capsule)) return;
  const auto& parameters = subject.parameters.capsules[number_of_it];
  const double force = load_force(capsule, parameters);
  const auto& direction = capsule.load.direction;
  table.row("load F/(G a)", number(capsule.load.force), "",
            force > 0 ? "pulls each end outwards" : "presses each end inwards");
  table.row("load F", number(force), in_si(subject, force, newton, "N"), "on each end");
  table.row("load along", fmt::format("{:.4g}, {:.4g}, {:.4g}", direction[0], direction[1], direction[2]));
  const auto end = load_end(capsule.load, subject.parameters);
  table.row("load until", end > most_steps ? "never off" : fmt::format("step {}", end),
            end > most_steps ? "" : in_si(subject, static_cast<double>(end), second, "s"),
            end > most_steps ? "" : "there, and later, it is off");
  if (!patches) return;
  put_patch(table, subject, "patch ahead", patches->ahead, patches->mesh_area);
  put_patch(table, subject, "patch behind", patches->behind, patches->mesh_area);
  // What is of rounding is none.
  const double offset = patches->offset() < 1e-9 * parameters.radius ? 0 : patches->offset();
  table.row("load moment", fmt::format("{:.4g}", std::abs(force) * offset), "",
            fmt::format("{:.3g} grid steps between the forces", offset));
}

}  // namespace tanktread::driver
