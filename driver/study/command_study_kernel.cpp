#include <memory>

#include "driver/case/names.hpp"
#include "driver/study/command_study.hpp"
#include "driver/study/study_kernel.hpp"

namespace tanktread::driver {

void add_kernel_study(CLI::App& study, int& exit_code) {
  auto* command = study.add_subcommand("kernel", "A discrete delta as a table, for the theory of its errors");
  auto kernel = std::make_shared<KernelStudy>();
  auto file = std::make_shared<std::string>();
  command->add_option("--kernel", kernel->kernel, names_text("Discrete delta", kernel_names()))
      ->capture_default_str();
  add_number(*command, "--points", kernel->points, "Distances a grid step, an even number",
             between(2, KernelStudy::most_points))
      ->capture_default_str();
  add_file_option(*command, *file);
  command->callback([=, &exit_code] {
    write_table(*file, kernel_table_header, [&] { return kernel_table(*kernel); });
    exit_code = 0;
  });
}

}  // namespace tanktread::driver
