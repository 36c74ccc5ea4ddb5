#include "driver/system/run_ranks.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <cstdint>
#include <stdexcept>

#include "driver/program/errors.hpp"

namespace tanktread::driver {
namespace {

const ranks::World* all_ranks = nullptr;

/// A part needs three nodes along x (fluid::GridPart).
constexpr ranks::Triple least_nodes = {3, 1, 1};

std::string text(const ranks::Triple& numbers) {
  return fmt::format("{} x {} x {}", numbers[0], numbers[1], numbers[2]);
}

/// Threads that share too few processors wait for each other at every turn.
std::string binding_warning(int threads) {
  const int n_processors = omp_get_num_procs();  // that this process may run on
  if (threads <= n_processors) return "";
  return fmt::format(
      "warning: the {} threads of a rank have {} to run on; if mpirun has bound them, start it with "
      "--bind-to none, or --map-by ppr:RANKS:socket:pe={}, else set run.threads (OMP_NUM_THREADS)\n",
      threads, n_processors == 1 ? "one processor" : fmt::format("{} processors", n_processors), threads);
}

}  // namespace

void set_ranks(const ranks::World* world) {
  all_ranks = world;
}

const ranks::World* other_ranks() {
  return all_ranks != nullptr && all_ranks->size() > 1 ? all_ranks : nullptr;
}

ranks::Box box_of_ranks(const Case& the_case) {
  ranks::Box box{the_case.flow.box, {true, true, true}, least_nodes};
  if (the_case.flow.kind != "periodic") box.periodic[the_case.flow.wall_axis] = false;
  return box;
}

ranks::Division division_of(const Case& the_case, int n_ranks) {
  const auto& wanted = the_case.run.ranks;
  const auto box = box_of_ranks(the_case);
  const bool is_given = wanted != RunCase().ranks;
  const auto n_wanted = std::int64_t{wanted[0]} * wanted[1] * wanted[2];
  if (is_given && n_wanted == 0) {
    throw InputError(fmt::format(
        "run.ranks = [{}, {}, {}]: a number of parts must be 1 at least along each axis, or 0 along all",
        wanted[0], wanted[1], wanted[2]));
  }
  if (is_given && n_wanted != n_ranks) {
    throw InputError(fmt::format(
        "run.ranks = [{0}, {1}, {2}]: is for {3} ranks, and there {4}; start the program with mpirun -n {3}, "
        "or "
        "remove the key (from echo.toml in the output directory, to resume a run)",
        wanted[0], wanted[1], wanted[2], n_wanted, n_ranks == 1 ? "is 1" : fmt::format("are {}", n_ranks)));
  }
  try {
    return is_given ? ranks::Division(box, wanted) : ranks::least_surface(box, n_ranks);
  } catch (const std::invalid_argument& error) {
    throw InputError(
        fmt::format("{}: {}", is_given ? "run.ranks" : fmt::format("mpirun -n {}", n_ranks), error.what()));
  }
}

std::string ranks_line(const Case& the_case) {
  const auto* world = other_ranks();
  const auto division = division_of(the_case, world ? world->size() : 1);
  if (world == nullptr) return "";
  const auto block = division.block(0);
  const int threads = the_case.run.threads > 0 ? the_case.run.threads : omp_get_max_threads();
  return fmt::format("on {} ranks ({}) of {} thread{}: {} parts, the first of {} nodes\n{}", world->size(),
                     ranks::World::library(), threads, threads == 1 ? "" : "s", text(division.parts()),
                     text(block.n), binding_warning(threads));
}

}  // namespace tanktread::driver
