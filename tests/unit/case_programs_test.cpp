// Programs in the place of components, as a case names them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "driver/case/case_programs.hpp"
#include "driver/plan/echo.hpp"
#include "driver/plan/warnings.hpp"
#include "driver/system/capsule_shape.hpp"
#include "driver/system/components.hpp"
#include "tests/integration/program.hpp"
#include "tests/unit/case_samples.hpp"

namespace {

using namespace tanktread::driver;
using namespace tanktread::testing;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(CasePrograms, ArgumentsAreFilesBesideTheCaseFileIfTheyAreThere) {
  const TemporaryDirectory folder;
  std::ofstream(folder / "mine.py") << "";
  const auto the_case =
      parse_case(least_case, "case.toml", folder.path(),
                 {"membrane.command=[\"/bin/sh\", \"mine.py\", \"--file=mine.py\", \"other.py\", \".\"]",
                  "flow.command=[\"sh\", \"../" + folder.path().filename().string() + "/mine.py\"]",
                  "run.command_directory=packets"});
  const auto mine = (folder / "mine.py").string();
  EXPECT_THAT(the_case.capsules[0].membrane.command,
              ElementsAre("/bin/sh", mine, "--file=mine.py", "other.py", "."));
  EXPECT_THAT(the_case.flow.command, ElementsAre("sh", mine));
  EXPECT_EQ(the_case.run.command_directory, (folder / "packets").string());
}

TEST(CasePrograms, AProgramThatIsNotThereIsRefused) {
  EXPECT_THAT(refusal(least_case, {"membrane.command=[\"no-such-program\"]"}),
              AllOf(HasSubstr("--set membrane.command=[\"no-such-program\"]: there is no program "
                              "'no-such-program' that can be run"),
                    HasSubstr("PATH")));
  EXPECT_THAT(refusal(least_case, {"flow.command=[\"/bin/no-such-program\"]"}), HasSubstr("flow.command"));
  EXPECT_THAT(refusal(least_case, {"flow.command=[\"\"]"}), HasSubstr("there is no program ''"));
  EXPECT_THAT(refusal(least_case, {"flow.command=[\"/bin\"]"}), HasSubstr("there is no program '/bin'"));
  EXPECT_THAT(refusal(full_case, {"capsule.1.membrane.command=[\"no-such-program\"]"}),
              HasSubstr("--set capsule.1.membrane.command"));
  EXPECT_EQ(refusal(least_case, {"flow.command=[\"sh\"]", "membrane.command=[\"/bin/sh\"]"}), "");
}

TEST(CasePrograms, AFluidHasOneViscosity) {
  EXPECT_THAT(refusal(least_case, {"flow.command=[\"sh\"]", "flow.viscosity_ratio=5"}),
              HasSubstr("flow.command=[\"sh\"]: a program in the place of the fluid has the same viscosity"));
  EXPECT_THAT(refusal(si_case, {"flow.command=[\"sh\"]", "si.inner_viscosity_Pa_s=6e-3"}),
              AllOf(HasSubstr("flow.command=[\"sh\"]: a program in the place of the fluid has the same"),
                    HasSubstr("si.inner_viscosity_Pa_s = 0.006")));
  EXPECT_EQ(refusal(si_case, {"flow.command=[\"sh\"]", "si.inner_viscosity_Pa_s=1.2e-3"}), "");
}

TEST(CasePrograms, HasProgram) {
  EXPECT_FALSE(has_program(parse(full_case)));
  EXPECT_TRUE(has_program(parse(full_case, {"flow.command=[\"sh\"]"})));
  EXPECT_TRUE(has_program(parse(full_case, {"capsule.1.membrane.command=[\"sh\"]"})));
}

TEST(CasePrograms, TheEchoNamesThem) {
  const auto text_of = [](const std::vector<std::string>& assignments) {
    const auto the_case = parse(full_case, assignments);
    return echo(the_case, parameters(the_case), {}, {});
  };
  const auto text = text_of({"capsule.1.membrane.command=[\"/bin/sh\", \"/somewhere/mine.sh\", \"-x\"]"});
  EXPECT_THAT(text, AllOf(HasSubstr("  membrane program        sh mine.sh -x\n"),
                          HasSubstr("  elastic law             skalak"),
                          HasSubstr("  moduli by elastic law   hookean"), HasSubstr("the run will tell")));
  EXPECT_THAT(text_of({"flow.command=[\"sh\"]"}), HasSubstr("  program                 sh\n"));
  EXPECT_THAT(text_of({}), AllOf(Not(HasSubstr("program")), Not(HasSubstr("moduli by"))));
}

TEST(CasePrograms, ShortTextFitsIntoALine) {
  EXPECT_EQ(short_text({"python3", "a/b.py", "/c/d.py"}), "python3 a/b.py d.py");
  EXPECT_EQ(short_text({std::string(200, 'x')}).size(), 70u);
}

TEST(CasePrograms, AViscousLawBesideAProgramIsWarnedOf) {
  const std::string viscous =
      "membrane.viscous={scheme = \"fd\", boussinesq_shear = 1, spring_stiffness = 1}";
  const auto lines_of = [](const std::vector<std::string>& assignments) {
    const auto the_case = parse(least_case, assignments);
    return warnings(the_case, parameters(the_case), {},
                    Placement(the_case, membrane_shapes(the_case).meshes));
  };
  EXPECT_THAT(lines_of({viscous, "membrane.command=[\"sh\"]"}),
              ::testing::Contains(HasSubstr("membrane.viscous has no effect")));
  EXPECT_THAT(lines_of({viscous}), Not(::testing::Contains(HasSubstr("has no effect"))));
}

}  // namespace
