#include "driver/plan/echo.hpp"

#include <fmt/format.h>

#include "driver/case/case_programs.hpp"
#include "driver/plan/duration.hpp"
#include "driver/plan/echo_capsule.hpp"
#include "driver/plan/step_advice.hpp"
#include "driver/program/memory.hpp"
#include "driver/units/schedule.hpp"

namespace tanktread::driver {
namespace {

std::string kind_note(const FlowCase& flow) {
  const char wall = "xyz"[flow.wall_axis], along = "xyz"[flow.flow_axis];
  if (flow.kind == "shear") return fmt::format("walls across {} move with -+U0 along {}", wall, along);
  if (flow.kind == "poiseuille") return fmt::format("walls across {}, body force along {}", wall, along);
  return "no walls";
}

void put_flow(EchoTable& table, const Subject& subject) {
  const auto& flow = subject.the_case.flow;
  const auto& p = subject.parameters;
  const double n_nodes = static_cast<double>(flow.box[0]) * flow.box[1] * flow.box[2];
  table.section("flow");
  table.row("kind", flow.kind, "", kind_note(flow));
  table.row("program", short_text(flow.command), "", "", !flow.command.empty());
  table.row("start", flow.start, "", flow.inertia ? "" : "no inertia: Stokes flow");
  table.row("box", fmt::format("{} x {} x {}", flow.box[0], flow.box[1], flow.box[2]), "",
            fmt::format("{:.3g} million nodes", 1e-6 * n_nodes));
  table.row("grid step", "1", in_si(subject, 1, metre, "m"), "radius_m / radius", subject.si.has_value());
  table.row("time step", "1", in_si(subject, 1, second, "s"), "g / shear_rate_per_s", subject.si.has_value());
  table.row("force unit", "1", in_si(subject, 1, newton, "N"), "viscosity_Pa_s / nu dx^2 / dt",
            subject.si.has_value());
  table.row("wall speed U0", number(p.wall_speed), in_si(subject, p.wall_speed, metre_per_second, "m/s"),
            flow.kind == "poiseuille" ? "g L/2, undisturbed centre speed" : "g L/2", flow.kind != "periodic");
  table.row("shear rate g", number(p.shear_rate), in_si(subject, p.shear_rate, per_second, "1/s"),
            flow.kind == "periodic" ? "as given" : "2 U0/L");
  const auto& force = p.body_force;
  const bool has_force = force != std::array<double, 3>{0, 0, 0};
  for (int axis = 0; axis < 3; ++axis) {
    table.row(
        fmt::format("body force {}", "xyz"[axis]), number(force[axis]),
        in_si(subject, force[axis], newton, "N"),
        flow.kind == "poiseuille" && axis == flow.flow_axis ? "a node; 8 nu U0/L^2 + body_force" : "a node",
        has_force && force[axis] != 0);
  }
  table.row("relaxation time tau+", number(p.relaxation_time), "", "1/2 + 3 nu");
  table.row("relaxation time tau-", number(p.relaxation_time_odd), "",
            flow.collision == "bgk" ? "bgk: tau+" : "1/2 + Lambda/(tau+ - 1/2)");
  table.row("magic parameter Lambda", number(flow.magic_parameter), "", "(tau+ - 1/2)(tau- - 1/2)",
            flow.collision == "trt");
  table.row("viscosity mu_o = nu", number(p.kinematic_viscosity),
            in_si(subject, p.kinematic_viscosity, pascal_second, "Pa s"), "(tau+ - 1/2)/3, density 1");
  table.row("Reynolds number Re", number(p.reynolds_number), "", "g a^2/nu, a of capsule 0");
  table.row("precision of the fluid", flow.storage, "", "19 numbers a node; forces and membranes are double",
            flow.storage != FlowCase().storage);
  table.row("speed limit", number(p.speed_limit), in_si(subject, p.speed_limit, metre_per_second, "m/s"),
            "a fluid that is as fast stops the run");
  table.row("Mach number", fmt::format("{:.4g}", p.mach_number), "",
            flow.kind == "periodic" ? "g a sqrt(3)" : "U0 sqrt(3)");
}

/// Which Reynolds number the physical values have, and how far the run is from it.
void put_override(EchoTable& table, const Subject& subject) {
  if (!subject.si) return;
  const auto run = si_of(subject.the_case, subject.parameters, *subject.si);
  table.section("from [si]");
  table.row("density", "1", fmt::format("{:.5g} kg/m^3", run.density_kg_per_m3),
            fmt::format("given: {:.5g} kg/m^3", subject.the_case.si->density_kg_per_m3));
  table.row("physical Re", fmt::format("{:.6g}", subject.si->reynolds_number_physical), "",
            fmt::format("the run has {:.4g} times that",
                        subject.parameters.reynolds_number / subject.si->reynolds_number_physical));
}

void put_schedule(EchoTable& table, const Subject& subject, const std::string& name, double every) {
  const auto& p = subject.parameters;
  const auto n_steps = last_step_of(subject.the_case, p);
  const auto interval = schedule_of(every, p).interval;
  if (interval == 0) {
    table.row(name, "never");
    return;
  }
  const auto note = interval > n_steps ? std::string("times, at the start and the end")
                                       : fmt::format("times, every {} steps", interval);
  table.row(name, fmt::format("{}", times_due({interval}, n_steps)),
            in_si(subject, static_cast<double>(interval), second, "s"), note);
}

std::string said_of(const Case& the_case) {
  const auto& coupler = the_case.coupler;
  std::vector<std::string> parts;
  if (coupler.tangential_correction) parts.emplace_back("with the tangential correction");
  if (coupler.shear_dipole && has_contrast(the_case)) parts.emplace_back("with the shear dipole");
  if (coupler.keep_volume) parts.emplace_back("the volume is kept");
  return fmt::format("{}", fmt::join(parts, "; "));
}

void put_run(EchoTable& table, const Subject& subject) {
  const auto& the_case = subject.the_case;
  const auto& p = subject.parameters;
  const auto n_steps = last_step_of(the_case, p);
  table.section("run");
  table.row("kernel", the_case.coupler.kernel, "", said_of(the_case));
  table.row("steps a shear time", fmt::format("{:.1f}", p.steps_per_shear_time),
            in_si(subject, p.steps_per_shear_time, second, "s"), "1/g");
  table.row("steps", fmt::format("{}", n_steps), in_si(subject, static_cast<double>(n_steps), second, "s"),
            fmt::format("to shear time {:.6g}", the_case.run.shear_time));
  put_step(table, subject);
  put_schedule(table, subject, "observables", the_case.output.observables_every);
  if (the_case.output.measures_every > 0)
    put_schedule(table, subject, "measures", the_case.output.measures_every);
  if (the_case.output.energy_every > 0) put_schedule(table, subject, "energy", the_case.output.energy_every);
  put_schedule(table, subject, "membrane files", the_case.output.membrane_every);
  put_schedule(table, subject, "fluid files", the_case.output.fluid_every);
  put_schedule(table, subject, "checkpoints", the_case.run.checkpoint_every);
}

void put_files(EchoTable& table, const FilesCost& files) {
  constexpr double worth_saying = 0.5;
  const double seconds = files.n_written * files.seconds;
  table.row("size of " + files.name, bytes_text(files.n_kept * files.bytes), "",
            fmt::format("{:.0f} of {}{}", files.n_written, bytes_text(files.bytes),
                        seconds >= worth_saying ? " in " + duration_text(seconds) : ""),
            files.n_written > 0);
}

/// Notes are short: with an SI column 39 letters are left for them.
void put_cost(EchoTable& table, const Cost& cost, bool with_program) {
  table.section("cost, estimated");
  table.row("memory", bytes_text(cost.memory_bytes), "", "at its peak", cost.memory_bytes > 0);
  for (const auto& files : cost.files) put_files(table, files);
  table.row("disk", bytes_text(cost.disk_bytes()), "",
            fmt::format("with 2 checkpoints; at most {}", bytes_text(cost.disk_peak_bytes())),
            cost.disk_bytes() > 0);
  if (cost.mlups == 0) {
    table.row("run time", "not measured", "",
              with_program             ? "a program has its own time: the run will tell"
              : cost.breakdown.empty() ? "not tried"
                                       : "the first steps break down: see warning");
    return;
  }
  const auto writing = cost.write_seconds();
  table.row("run time", duration_text(cost.step_seconds + writing), "",
            fmt::format("steps {}, writing {}", duration_text(cost.step_seconds),
                        writing > 0 ? duration_text(writing) : "not measured"));
  table.row("speed", fmt::format("{:.1f} MLUPS", cost.mlups), "",
            writing > 0 ? "measured now, as the time to write" : "measured now");
}

}  // namespace

std::string echo(const Case& the_case, const Parameters& parameters, const Cost& cost,
                 const std::vector<std::string>& warnings, const std::vector<ShapeNumbers>& shapes,
                 const LoadPatches& patches) {
  const Subject subject{the_case, parameters, si_scales(the_case, parameters)};
  EchoTable table(subject.si.has_value());
  table.title(the_case.title);
  put_flow(table, subject);
  put_override(table, subject);
  for (std::size_t k = 0; k < the_case.capsules.size(); ++k) {
    put_capsule(table, subject, k, k < shapes.size() ? shapes[k] : ShapeNumbers());
    put_load(table, subject, k, k < patches.size() ? patches[k] : std::nullopt);
  }
  put_run(table, subject);
  put_cost(table, cost, has_program(the_case));
  for (const auto& warning : warnings) table.paragraph("warning: " + warning);
  return table.text();
}

}  // namespace tanktread::driver
