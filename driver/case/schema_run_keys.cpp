#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "driver/case/names.hpp"
#include "driver/case/schema_keys.hpp"
#include "driver/case/schema_members.hpp"

namespace tanktread::driver {
namespace {

/// The default of the tangential correction, in words.
std::string with_corrected_kernels() {
  std::vector<std::string> names;
  for (const auto& name : kernel_names()) {
    if (is_corrected_by_default(name)) names.push_back(name);
  }
  return fmt::format("true with {}, else false",
                     names.empty() ? CouplerCase().kernel : fmt::format("{}", fmt::join(names, ", ")));
}

std::string refuse_without_implicit(const Case& the_case, std::size_t) {
  const bool any = std::ranges::any_of(the_case.capsules, [](const CapsuleCase& capsule) {
    return capsule.membrane.viscous.scheme == implicit_scheme;
  });
  return any ? "" : "is of membrane.viscous.scheme = \"implicit\", which no capsule has; remove it";
}

/// The budget needs parts of both components that a program is not asked for.
std::string refuse_with_a_program(const Case& the_case, std::size_t) {
  const bool of_membrane = std::ranges::any_of(
      the_case.capsules, [](const CapsuleCase& capsule) { return !capsule.membrane.command.empty(); });
  const bool is_wanted = the_case.output.energy_every > 0;  // an echo says it also where it is not
  if (!is_wanted || (the_case.flow.command.empty() && !of_membrane)) return "";
  return fmt::format("needs what a program is not asked for, and {} is given; remove one of the two",
                     of_membrane ? "membrane.command" : "flow.command");
}

}  // namespace

std::vector<Key> coupler_run_output_keys() {
  using O = OutputCase;
  return {
      key<InCase<&Case::coupler, &CouplerCase::kernel>>("coupler.kernel", "", "discrete delta")
          .one_of(kernel_names()),
      key<InCase<&Case::coupler, &CouplerCase::tangential_correction>>(
          "coupler.tangential_correction", "",
          "gives nodes back the velocity that smoothing takes off them along the membrane")
          .preset(with_corrected_kernels()),
      key<InCase<&Case::coupler, &CouplerCase::shear_dipole>>(
          "coupler.shear_dipole", "",
          "keeps the flows in and around a capsule of another viscosity from slipping past each other")
          .preset("as coupler.tangential_correction"),
      key<InCase<&Case::coupler, &CouplerCase::keep_volume>>(
          "coupler.keep_volume", "",
          "moves nodes a little along the gradient of each capsule's volume, which stays the same then"),
      key<InCase<&Case::coupler, &CouplerCase::implicit_tolerance>>(
          "coupler.implicit_tolerance", "",
          "how far implicit viscous stresses may be from those of the velocity that the fluid has, of their "
          "norm")
          .above(0)
          .to(0.1)
          .unless(refuse_without_implicit),
      key<InCase<&Case::coupler, &CouplerCase::implicit_iterations>>(
          "coupler.implicit_iterations", "", "the most that these equations may take in a step")
          .from(1)
          .to(1'000'000)
          .free_on_resume()
          .unless(refuse_without_implicit),
      key<InCase<&Case::run, &RunCase::shear_time>>("run.shear_time", "shear times", "end of the run")
          .from(0)
          .free_on_resume(),
      key<InCase<&Case::run, &RunCase::threads>>("run.threads", "", "OpenMP threads; 0: all")
          .from(0)
          .to(1024)
          .free_on_resume(),
      key<InCase<&Case::run, &RunCase::ranks>>("run.ranks", "",
                                               "parts of the box along x, y, z, one a rank of mpirun")
          .from(0)
          .to(1'000'000)
          .preset("[0, 0, 0]: those with the least surface between them")
          .free_on_resume(),
      key<InCase<&Case::run, &RunCase::message_latency_us>>(
          "run.message_latency_us", "us",
          "what a message between two ranks takes beside its bytes; for plan --ranks alone")
          .from(0)
          .to(1e6)
          .free_on_resume(),
      key<InCase<&Case::run, &RunCase::message_bandwidth_GB_s>>(
          "run.message_bandwidth_GB_s", "GB/s",
          "of one rank to its neighbours, and as much from them; for plan --ranks alone")
          .from(1e-6)
          .to(1e6)
          .free_on_resume(),
      key<InCase<&Case::run, &RunCase::checkpoint_every>>("run.checkpoint_every", "shear times",
                                                          "between checkpoints; the last two are kept")
          .above(0)
          .free_on_resume(),
      key<InCase<&Case::run, &RunCase::checkpoint_minutes>>(
          "run.checkpoint_minutes", "min",
          "of wall clock, the most between checkpoints; 0: only by shear time")
          .from(0)
          .free_on_resume(),
      key<InCase<&Case::run, &RunCase::command_time_limit>>(
          "run.command_time_limit", "s", "of a program for an answer; after it the run stops")
          .above(0)
          .free_on_resume(),
      key<InCase<&Case::run, &RunCase::command_directory>>(
          "run.command_directory", "",
          "where packets for programs go; path from the case file; \"\": in memory, removed at the end")
          .free_on_resume(),
      key<InCase<&Case::output, &O::observables_every>>("output.observables_every", "shear times",
                                                        "between rows of observables.csv; 0: never")
          .from(0)
          .free_on_resume(),
      key<InCase<&Case::output, &O::measures_every>>(
          "output.measures_every", "shear times",
          "between rows of measures.csv (contour, its speed, extents, marker, axes); 0: never")
          .from(0)
          .free_on_resume(),
      key<InCase<&Case::output, &O::energy_every>>(
          "output.energy_every", "shear times",
          "between rows of energy.csv (powers of the whole system); 0: never")
          .from(0)
          .free_on_resume()
          .unless(refuse_with_a_program),
      key<InCase<&Case::output, &O::membrane_every>>("output.membrane_every", "shear times",
                                                     "between membrane files; 0: never")
          .from(0)
          .free_on_resume(),
      key<InCase<&Case::output, &O::fluid_every>>("output.fluid_every", "shear times",
                                                  "between fluid files; 0: never")
          .from(0)
          .free_on_resume(),
      key<InCase<&Case::output, &O::fluid_box>>(
          "output.fluid_box", "nodes",
          "[[x0, x1], [y0, y1], [z0, z1]]: first and last node of fluid files (a slice: x0 = x1)")
          .from(0)
          .to(most_nodes_along_axis - 1)
          .preset("the whole box")
          .free_on_resume(),
      key<InCase<&Case::output, &O::whole_file_nodes>>(
          "output.whole_file_nodes", "nodes",
          "of the box, up to which the fluid is one file a time; above, each rank writes a piece of it")
          .from(0)
          .to(std::numeric_limits<int>::max())
          .free_on_resume(),
      key<InCase<&Case::output, &O::whole_file_triangles>>(
          "output.whole_file_triangles", "triangles",
          "of all membranes, up to which they are one file a time; above, pieces of at most so many")
          .from(1)
          .to(1 << 22)  // of more, what an owner sends for a file is over the 2 GiB of a message
          .free_on_resume(),
  };
}

}  // namespace tanktread::driver
