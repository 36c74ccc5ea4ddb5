// A case: everything a user says, checked and typed, with the defaults filled in.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "driver/case/case_value.hpp"
#include "driver/program/errors.hpp"

namespace tanktread::driver {

struct FlowCase {
  std::string kind = "shear";  ///< shear | poiseuille | periodic
  std::array<int, 3> box = {60, 60, 60};
  int wall_axis = 2;
  int flow_axis = 0;
  /// Exactly one of reynolds_number, wall_speed (shear_rate if periodic).
  std::optional<double> reynolds_number;
  std::optional<double> wall_speed;  ///< U0, lattice units
  std::optional<double> shear_rate;  ///< periodic only, lattice units
  double relaxation_time = 1.0;
  std::string collision = "trt";  ///< trt | bgk
  double magic_parameter = 0.1875;
  double viscosity_ratio = 1.0;
  std::string start = "rest";  ///< rest | developed
  std::array<double, 3> body_force = {0, 0, 0};
  bool inertia = true;
  std::string storage = "double";     ///< double | single
  std::optional<double> speed_limit;  ///< none: by the wall speed (FlowParameters)
  std::vector<std::string> command;   ///< a program in the place of the flow solver; empty: none

  bool operator==(const FlowCase&) const = default;
};

/// The scheme of a membrane viscosity whose force depends on the velocity of its own time.
inline constexpr const char* implicit_scheme = "implicit";

/// Membrane viscosity: a dashpot mu, or a Maxwell element, the dashpot in series with the artificial spring
/// k' (tau = mu/k'). The explicit schemes cannot do without the spring. It is given in one of three forms,
/// all with the suffix _dilatational for the second part.
struct ViscousCase {
  std::string scheme =
      "none";  ///< none | implicit | fd | int1 | int2; none: the other members have no effect
  double boussinesq_shear = 0;                   ///< Bq_s = mu_s/(mu_o a)
  double boussinesq_dilatational = 0;            ///< Bq_d = mu_d/(mu_o a)
  std::optional<double> spring_stiffness;        ///< kappa = L k'/(U0 mu_s); without walls U0/L is g/2
  std::optional<double> spring_relaxation_time;  ///< tau g
  std::optional<double> spring_modulus;          ///< k', lattice units
  std::optional<double> spring_stiffness_dilatational, spring_relaxation_time_dilatational,
      spring_modulus_dilatational;                     ///< none: the tau of the shear spring
  int interval = 1;                                    ///< N: steps between two updates of the viscous stress
  std::string strain_sampling = "latest";              ///< latest | moving-average
  std::string stress_measure = "rate-of-deformation";  ///< rate-of-deformation | rate-of-strain
  std::string strain_rates = "elements";               ///< elements | nodes; of the implicit scheme

  bool operator==(const ViscousCase&) const = default;
};

/// Energies of the whole membrane beside its elastic law (docs/energy-terms.md), in units of G: the modulus
/// of its law (G_s; gamma of a tension; kappa_b/a^2 without a law). 0: there is none.
struct EnergyCase {
  double bending_modulus = 0;        ///< kappa_b/(G a^2), 1 over the Foeppl-von Karman number
  double spontaneous_curvature = 0;  ///< c_0 a; a sphere of the radius a has 2
  double global_area_modulus = 0;    ///< k_A/G
  double local_area_modulus = 0;     ///< k_d/G
  double volume_modulus = 0;         ///< k_V a/G
  double reference_area = 1;         ///< A_0 over the area of the mesh
  double reference_volume = 1;       ///< V_0 over its volume

  bool operator==(const EnergyCase&) const = default;
};

/// The name of no elastic law: the membrane is then of its energies alone, as a vesicle.
inline constexpr const char* no_elastic_law = "none";

struct MembraneCase {
  std::string elastic_law = "skalak";
  double capillary_number = 0.3;
  std::string capillary_modulus =
      "E_s";  ///< E_s = 2 G_s | G_s | gamma (interfacial-tension) | kappa_b (none)
  double area_ratio = 1.0;
  double poisson_ratio = 0.5;
  EnergyCase energy;
  std::vector<std::string> command;  ///< a program in the place of the laws; empty: none
  ViscousCase viscous;

  bool operator==(const MembraneCase&) const = default;
};

struct MeshCase {
  std::string shape = "sphere";  ///< sphere | biconcave | spheroid
  int level = 3;
  std::optional<double> aspect_ratio;    ///< of a spheroid, its axis over its diameter; or
  std::optional<double> reduced_volume;  ///< of an oblate one, V/(4 pi/3 (A/(4 pi))^(3/2))
  std::string file;  ///< a .vtu instead of a shape, absolute; scaled to `radius` by its volume; "": none

  std::string file_hash;  ///< of the points and triangles in `file` (geometry_hash); "": not known, not asked

  /// How the mesh is turned about its centre: at most one of these; none: as it is, its axis along z.
  std::optional<std::array<double, 3>> direction;     ///< where its z goes, by the shortest turn
  std::optional<std::array<double, 3>> euler_angles;  ///< degrees, about z, the new x, the new z

  bool operator==(const MeshCase&) const = default;
};

/// The shape in which the elastic law has no stress, where it is not that of the mesh: of the same triangles,
/// scaled to the area of the mesh, turned as it is.
struct StressFreeCase {
  std::string shape = "mesh";            ///< mesh | sphere | biconcave | spheroid
  std::optional<double> aspect_ratio;    ///< as MeshCase
  std::optional<double> reduced_volume;  ///< as MeshCase
  std::string file;                      ///< a .vtu of the same triangles instead, absolute; "": none
  std::string file_hash;                 ///< as MeshCase

  bool operator==(const StressFreeCase&) const = default;
};

/// Two forces that pull a capsule apart along an axis, each on a patch at an end, as tweezers do.
struct LoadCase {
  double force = 0;                             ///< F/(G a) on each patch; negative: pressed together
  std::array<double, 3> direction = {1, 0, 0};  ///< the axis; any length but 0
  double patch = 0.02;                          ///< area of a patch over that of the mesh
  std::optional<double> until;                  ///< shear times; none: never switched off

  bool operator==(const LoadCase&) const = default;
};

struct CapsuleCase {
  double radius = 0;  ///< grid steps
  std::array<double, 3> position = {0, 0, 0};
  MeshCase mesh;
  StressFreeCase stress_free;
  LoadCase load;
  MembraneCase membrane;  ///< [membrane] with the capsule's own table laid over it
  double viscosity_ratio = 1.0;

  bool operator==(const CapsuleCase&) const = default;
};

struct CouplerCase {
  std::string kernel = "stockie6";
  bool tangential_correction = true;  ///< where a case does not say: by the kernel
  bool shear_dipole = true;           ///< likewise: as the tangential correction
  bool keep_volume = false;
  double implicit_tolerance = 1e-3;  ///< of implicit viscosities: what their rates may be off
  int implicit_iterations = 1000;    ///< the most that a step may take

  bool operator==(const CouplerCase&) const = default;
};

struct RunCase {
  double shear_time = 10.0;
  int threads = 0;
  std::array<int, 3> ranks = {0, 0, 0};  ///< parts along x, y, z; 0 0 0: with the least surface
  double message_latency_us = 2;         ///< of the network, for `plan --ranks`
  double message_bandwidth_GB_s = 10;    ///< likewise, each way
  double checkpoint_every = 1.0;         ///< shear times
  double checkpoint_minutes = 0;         ///< of wall clock; 0: no matter
  double command_time_limit = 60;        ///< seconds a program may take for an answer
  std::string command_directory;         ///< of the packets for programs, absolute; "": a fresh one

  bool operator==(const RunCase&) const = default;
};

struct OutputCase {
  double observables_every = 0.02;  ///< shear times, all five; 0: never
  double measures_every = 0;
  double energy_every = 0;
  double membrane_every = 0.25;
  double fluid_every = 1.0;
  /// First and last node (both included) along x, y, z that fluid output covers; none: the whole box.
  std::optional<Ranges3> fluid_box;
  /// Of a box with more nodes, fluid files and states of the fluid are written in pieces.
  int whole_file_nodes = 256 * 256 * 256;
  /// Membranes of more triangles together are written in pieces of at most so many.
  int whole_file_triangles = 1 << 18;

  bool operator==(const OutputCase&) const = default;
};

/// The [si] form (docs/case-file.md): physical values as given; all members positive.
struct SiCase {
  double radius_m = 0;  ///< of the first capsule; the others follow by the ratio of their radii
  double shear_rate_per_s = 0;
  double viscosity_Pa_s = 0;
  std::optional<double> inner_viscosity_Pa_s =
      std::nullopt;  ///< of the fluid in all capsules; none: by viscosity_ratio
  double density_kg_per_m3 = 1000;
  /// Exactly one, and none without an elastic law.
  std::optional<double> shear_modulus_N_per_m, interfacial_tension_N_per_m;
  std::optional<double> membrane_shear_viscosity_N_s_per_m = std::nullopt;
  std::optional<double> membrane_dilatational_viscosity_N_s_per_m = std::nullopt;
  // In the place of the numbers of EnergyCase and LoadCase; of all capsules. None: 0.
  std::optional<double> bending_modulus_J = std::nullopt;
  std::optional<double> spontaneous_curvature_per_m = std::nullopt;  ///< of either sign
  std::optional<double> global_area_modulus_N_per_m = std::nullopt;
  std::optional<double> local_area_modulus_N_per_m = std::nullopt;
  std::optional<double> volume_modulus_N_per_m2 = std::nullopt;
  std::optional<double> load_force_N = std::nullopt;  ///< of either sign

  bool operator==(const SiCase&) const = default;
};

struct Case {
  std::string title;
  FlowCase flow;
  std::vector<CapsuleCase> capsules;  ///< at least one
  CouplerCase coupler;
  RunCase run;
  OutputCase output;
  std::optional<SiCase> si;
  std::filesystem::path file;  ///< where it came from, for messages and relative mesh paths

  bool operator==(const Case&) const = default;
};

/// Whether the fluid in a capsule has another viscosity than outside.
bool has_contrast(const Case& the_case);

/// What of the files and programs that a case names is going to be used. Only that must be there.
struct FilesUsed {
  bool meshes = true;
  bool fluid_program = true;
  bool membrane_programs = true;
};

/// Reads a case file, lays the `--set` assignments ("dotted.path=TOML value") over it, checks everything.
/// @throws InputError that names all problems, a line each with file and line (or the assignment), key,
/// value, what is allowed and the fix: unknown keys ("did you mean"), wrong types, values out of range,
/// contradictory or missing keys, a syntax error, a missing file
Case read_case(const std::filesystem::path& file, const std::vector<std::string>& assignments = {},
               const FilesUsed& used = {});

/// The same from text; `name` stands for the file in messages, relative paths are taken from `directory`.
Case parse_case(const std::string& text, const std::string& name, const std::filesystem::path& directory,
                const std::vector<std::string>& assignments = {}, const FilesUsed& used = {});

/// The case as TOML with every key resolved: itself a valid case that reproduces the run. Read back (with the
/// same file name and directory) it equals the case, to the last bit.
std::string to_toml(const Case& the_case);

}  // namespace tanktread::driver
