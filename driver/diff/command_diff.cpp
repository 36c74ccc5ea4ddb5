#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "driver/diff/file_difference.hpp"
#include "driver/program/commands.hpp"
#include "driver/program/errors.hpp"
#include "driver/program/number_option.hpp"

namespace tanktread::driver {
namespace {

struct DiffArguments {
  std::string a, b;
  std::vector<std::string> ignored;
  double tolerance = 0;
};

int compare(const DiffArguments& arguments) {
  const auto report = compare_outputs(
      arguments.a, arguments.b, {{arguments.ignored.begin(), arguments.ignored.end()}, arguments.tolerance});
  for (const auto& line : report.lines()) fmt::print("{}\n", line);
  fmt::print("{}\n", report.summary());
  return report.different() ? exit_different : 0;
}

}  // namespace

void add_diff_command(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand(
      "diff", "Compare two files, or two output directories, bit for bit; exit code 1 if they differ");
  auto arguments = std::make_shared<DiffArguments>();
  command
      ->add_option("first", arguments->a,
                   "File (.vtu, .vti, in pieces .pvtu, .pvti; .pvd, .csv, other) or directory")
      ->required();
  command->add_option("second", arguments->b, "The one to compare it with")->required();
  command
      ->add_option("--ignore", arguments->ignored,
                   "Name of an array, column or file to leave out; may be given many times")
      ->allow_extra_args(false);
  add_number(*command, "--tolerance", arguments->tolerance,
             "Largest |a - b| of an array or column that counts as equal; 0: bit for bit", at_least(0))
      ->capture_default_str();
  command->callback([=, &exit_code] { exit_code = compare(*arguments); });
}

}  // namespace tanktread::driver
