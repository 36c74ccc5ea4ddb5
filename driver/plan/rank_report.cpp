#include "driver/plan/rank_report.hpp"

#include <fmt/format.h>

#include <optional>
#include <stdexcept>

#include "driver/plan/echo_table.hpp"
#include "driver/program/memory.hpp"

namespace tanktread::driver {
namespace {

std::string by_text(const ranks::Triple& n) {
  return fmt::format("{} x {} x {}", n[0], n[1], n[2]);
}

std::string bytes_text(std::int64_t bytes) {
  return driver::bytes_text(static_cast<double>(bytes));
}

std::string time_text(double seconds) {
  if (seconds >= 1) return fmt::format("{:.3g} s", seconds);
  return seconds >= 1e-3 ? fmt::format("{:.3g} ms", 1e3 * seconds) : fmt::format("{:.3g} us", 1e6 * seconds);
}

void put_parts(EchoTable& table, const RankPlan& plan) {
  table.row("parts", by_text(plan.parts), "", "of the box, along x, y, z");
  table.row("largest part", by_text(plan.largest), "", fmt::format("{} nodes", nodes_in(plan.largest)));
  table.row("smallest part", by_text(plan.smallest), "", fmt::format("{} nodes", nodes_in(plan.smallest)));
  table.row("halo", fmt::format("{} nodes", plan.halo_nodes), "",
            fmt::format("{:.3g} % of the largest part", 100.0 * static_cast<double>(plan.halo_nodes) /
                                                            static_cast<double>(nodes_in(plan.largest))));
}

void put_messages(EchoTable& table, const RankPlan& plan) {
  table.row("messages", fmt::format("{} a step", plan.n_messages), "",
            fmt::format("out, as many in; {} neighbours", plan.n_neighbours));
  table.row("largest message", bytes_text(plan.largest_message_bytes), "",
            "to one neighbour, as much from it");
  table.row("all messages", bytes_text(plan.message_bytes), "", "of a rank out, as much in");
}

void put_memory(EchoTable& table, const RankPlan& plan) {
  table.row(
      "memory of a rank", driver::bytes_text(plan.memory_bytes()), "",
      fmt::format("fluid {}, membranes {}, program {}", driver::bytes_text(plan.fluid_memory_bytes),
                  driver::bytes_text(plan.membrane_memory_bytes), driver::bytes_text(program_memory_bytes)));
  table.row("of the first, more", driver::bytes_text(plan.first_rank_bytes), "", "what it gathers for files",
            plan.first_rank_bytes > 0);
}

void put_capsules(EchoTable& table, const RankPlan& plan, const RankSubject& subject) {
  const auto n_capsules = static_cast<std::int64_t>(subject.membranes.size());
  table.row("capsules of a rank", fmt::format("{}", capsules_of_a_rank(n_capsules, plan.n_ranks())), "",
            "at most, if they are shared evenly", n_capsules > 0);
}

void put_times(EchoTable& table, const RankPlan& plan) {
  if (plan.efficiency == 0) {
    table.row("time of a step", "not measured");
    return;
  }
  table.row("time of a step", time_text(plan.step_seconds()), "",
            fmt::format("fluid {}, messages {}, membranes {}", time_text(plan.fluid_seconds),
                        time_text(plan.message_seconds), time_text(plan.membrane_seconds)));
  table.row("efficiency", fmt::format("{:.3g} %", 100 * plan.efficiency), "", "t(1)/(N t(N))");
}

std::string row_of(const RankPlan& plan) {
  return fmt::format("  {:>8}  {:<16} {:>12} {:>10} {:>12} {:>12} {:>11}\n", plan.n_ranks(),
                     by_text(plan.parts), nodes_in(plan.largest), driver::bytes_text(plan.memory_bytes()),
                     bytes_text(plan.message_bytes),
                     plan.efficiency > 0 ? time_text(plan.step_seconds()) : "-",
                     plan.efficiency > 0 ? fmt::format("{:.3g} %", 100 * plan.efficiency) : "-");
}

/// Fewer ranks are cut with the least surface; a number that cannot be has a row that says so.
std::string table_up_to(const RankPlan& last, const RankSubject& subject, const RankModel& model) {
  std::string table = fmt::format("\n  {:>8}  {:<16} {:>12} {:>10} {:>12} {:>12} {:>11}\n", "ranks", "parts",
                                  "nodes a part", "memory", "out a step", "a step", "efficiency");
  for (const int n : rank_steps(last.n_ranks())) {
    if (n == last.n_ranks()) {
      table += row_of(last);
      continue;
    }
    std::optional<ranks::Division> division;
    try {
      division = ranks::least_surface(subject.box, n);
    } catch (const std::invalid_argument&) {
      table += fmt::format("  {:>8}  no way to cut the box into so many parts\n", n);
      continue;
    }
    table += row_of(rank_plan(subject, *division, model));
  }
  return table;
}

}  // namespace

std::string rank_report(const Plan& plan, const ranks::Division& division) {
  const auto subject = rank_subject(plan.the_case, plan.parameters, plan.sizes);
  const auto model = rank_model(plan.the_case, plan.cost);
  const auto numbers = rank_plan(subject, division, model);
  EchoTable table(false);
  table.section(fmt::format("on {} ranks, by the model of docs/many-ranks.md", division.n_ranks()));
  put_parts(table, numbers);
  put_messages(table, numbers);
  put_capsules(table, numbers, subject);
  put_memory(table, numbers);
  put_times(table, numbers);
  EchoTable warnings(false);
  for (const auto& warning : rank_warnings(plan.the_case, numbers)) warnings.paragraph("warning: " + warning);
  return table.text() + table_up_to(numbers, subject, model) + warnings.text();
}

}  // namespace tanktread::driver
