#include "driver/case/schema_keys.hpp"
#include "driver/case/schema_members.hpp"

namespace tanktread::driver {

std::vector<Key> si_keys() {
  using S = SiCase;
  return {
      key<InSi<&S::radius_m>>("si.radius_m", "m", "a of the first capsule").above(0).required(),
      key<InSi<&S::shear_rate_per_s>>("si.shear_rate_per_s", "1/s", "g").above(0).required(),
      key<InSi<&S::viscosity_Pa_s>>("si.viscosity_Pa_s", "Pa s", "mu_o of the fluid outside")
          .above(0)
          .required(),
      key<InSi<&S::inner_viscosity_Pa_s>>("si.inner_viscosity_Pa_s", "Pa s",
                                          "mu_i of the fluid in all capsules, in place of viscosity_ratio")
          .above(0),
      key<InSi<&S::density_kg_per_m3>>("si.density_kg_per_m3", "kg/m^3", "of the fluid")
          .above(0)
          .preset(toml_text(SiCase().density_kg_per_m3)),
      key<InSi<&S::shear_modulus_N_per_m>>("si.shear_modulus_N_per_m", "N/m",
                                           "G_s of a capsule; or interfacial_tension_N_per_m")
          .above(0),
      key<InSi<&S::interfacial_tension_N_per_m>>("si.interfacial_tension_N_per_m", "N/m",
                                                 "gamma of a droplet; or shear_modulus_N_per_m")
          .above(0),
      key<InSi<&S::membrane_shear_viscosity_N_s_per_m>>("si.membrane_shear_viscosity_N_s_per_m", "N s/m",
                                                        "mu_s, in place of boussinesq_shear")
          .from(0),
      key<InSi<&S::membrane_dilatational_viscosity_N_s_per_m>>("si.membrane_dilatational_viscosity_N_s_per_m",
                                                               "N s/m",
                                                               "mu_d, in place of boussinesq_dilatational")
          .from(0),
      key<InSi<&S::bending_modulus_J>>("si.bending_modulus_J", "J", "kappa_b, in place of bending_modulus")
          .from(0),
      key<InSi<&S::spontaneous_curvature_per_m>>("si.spontaneous_curvature_per_m", "1/m",
                                                 "c_0, in place of spontaneous_curvature"),
      key<InSi<&S::global_area_modulus_N_per_m>>("si.global_area_modulus_N_per_m", "N/m",
                                                 "k_A, in place of global_area_modulus")
          .from(0),
      key<InSi<&S::local_area_modulus_N_per_m>>("si.local_area_modulus_N_per_m", "N/m",
                                                "k_d, in place of local_area_modulus")
          .from(0),
      key<InSi<&S::volume_modulus_N_per_m2>>("si.volume_modulus_N_per_m2", "N/m^2",
                                             "k_V, in place of volume_modulus")
          .from(0),
      key<InSi<&S::load_force_N>>("si.load_force_N", "N",
                                  "of each end of each capsule, in place of load.force"),
  };
}

}  // namespace tanktread::driver
