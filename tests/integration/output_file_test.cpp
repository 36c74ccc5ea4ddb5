// No output option of any command replaces what is not of the kind that it writes.
#include <regex>

#include "tests/integration/stages_fixture.hpp"

namespace tanktread::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// An option that names a file to write, the last word of a command.
struct OutputOption {
  std::vector<std::string> command;
  std::string name, extension;
};

class Outputs : public Stages {
 protected:
  void SetUp() override {
    Stages::SetUp();
    stage({"membrane", "--out", path("rest.vtu")});
    stage({"fluid", "--steps", "0", "--out", path("state.vti"), "--fields", path("flow.vti")});
  }
  std::vector<std::string> of_case(std::vector<std::string> command) const {
    command.insert(command.end(), {"--case", path("case.toml")});
    return command;
  }
  std::vector<OutputOption> all() const {
    return {
        {{"mesh", "sphere", "--level", "0"}, "mesh sphere", ".vtu"},
        {of_case({"membrane", "--out"}), "--out", ".vtu"},
        {of_case({"coupler", "spread", "--in", path("rest.vtu"), "--out"}), "--out", ".vti"},
        {of_case({"coupler", "interpolate", "--in", path("rest.vtu"), "--grid", path("flow.vti"), "--out"}),
         "--out", ".vtu"},
        {of_case({"fluid", "--steps", "1", "--out"}), "--out", ".vti"},
        {of_case({"fluid", "--steps", "1", "--out", path("other.vti"), "--fields"}), "--fields", ".vti"},
        {{"study", "maxwell", "--k", "1", "--out"}, "--out", ".csv"},
        {{"study", "kernel", "--out"}, "--out", ".csv"},
        {{"study", "strain-rate-noise", "--interval", "1", "--out"}, "--out", ".csv"},
        {{"study", "layers", "--height", "8", "--lambda", "1", "--form", "sharp", "--out"}, "--out", ".csv"},
        {{"study", "twisting-sphere", "--level", "0", "--period", "8", "--out"}, "--out", ".csv"}};
  }
  /// The command with its output there; --case behind it.
  static std::vector<std::string> to(const OutputOption& option, const std::string& file) {
    auto command = option.command;
    const auto place = std::ranges::find(command, "--case");
    if (place == command.end()) {
      command.push_back(file);
    } else {
      command.insert(place, file);
    }
    return command;
  }
  void expect_refused(const OutputOption& option, const std::string& file, const std::string& why) const {
    const bool is_file = std::filesystem::is_regular_file(file);
    const auto before = is_file ? read_file(file) : "";
    EXPECT_THAT(call(to(option, file), 2), AllOf(HasSubstr(option.name + " " + file + ": "), HasSubstr(why)));
    EXPECT_EQ(std::filesystem::is_regular_file(file), is_file);
    if (is_file) {
      EXPECT_TRUE(read_file(file) == before) << file;
    }
    EXPECT_FALSE(std::filesystem::exists(path("other.vti")));
  }
};

TEST_F(Outputs, AreRefusedUnderANameOfAnotherKind) {
  for (const auto& option : all()) {
    expect_refused(option, path("case.toml"), "give a name that ends in " + option.extension);
    expect_refused(option, path("new.stl"), "give a name that ends in " + option.extension);
    expect_refused(option, path("none/new" + option.extension), "there is no folder");
  }
}

TEST_F(Outputs, AreRefusedAmongTheFilesOfARun) {
  call({"run", path("case.toml"), "--output", path("finished"), "--shear-time", "0"});
  for (const auto& option : all()) {
    for (const std::string place : {"membrane", "fluid", "checkpoints", "checkpoints/step_0000000000"})
      expect_refused(option, path("finished/" + place + "/new" + option.extension),
                     "is a place of the run in ");
  }
  EXPECT_THAT(call({"mesh", "sphere", "--level", "0", path("finished/mine.vtu")}), HasSubstr("mine.vtu"));
}

TEST_F(Outputs, AreRefusedWhereSomethingElseStands) {
  const auto foreign = [&](const std::string& extension) {
    // As another program writes them: without the hash.
    return "<VTKFile type=\"" + std::string(extension == ".vtu" ? "UnstructuredGrid" : "ImageData") +
           "\" version=\"0.1\">\n</VTKFile>\n";
  };
  for (const auto& option : all()) {
    const auto file = path("standing" + option.extension);
    for (const auto& text :
         {read_file(path("case.toml")), std::string("step,shear_time,deformation\n0,0,0\n"), foreign(".vtu"),
          foreign(".vti")}) {
      std::ofstream(file) << text;
      expect_refused(option, file, "is there already and is not a");
    }
    std::filesystem::copy_file(path(option.extension == ".vtu" ? "flow.vti" : "rest.vtu"), file,
                               std::filesystem::copy_options::overwrite_existing);
    expect_refused(option, file, "is there already and is not a");
    std::filesystem::remove(file);
    std::filesystem::create_directory(file);
    expect_refused(option, file, "is a folder");
    std::filesystem::remove(file);
  }
}

TEST_F(Outputs, ReplaceTheirOwnKindAndEmptyFiles) {
  for (const auto& option : all()) {
    const auto file = path("standing" + option.extension);
    std::filesystem::remove(file);
    call(to(option, file));
    const auto first = read_file(file);
    call(to(option, file));
    EXPECT_TRUE(read_file(file) == first);
    std::ofstream(file, std::ios::trunc).close();
    call(to(option, file));
    EXPECT_TRUE(read_file(file) == first);
    std::filesystem::remove(path("other.vti"));
  }
}

TEST_F(Outputs, AreNotWhatTheSameCommandReads) {
  stage({"fluid", "--out", path("state.vti"), "--fields", path("flow.vti")});
  stage({"coupler", "spread", "--in", path("rest.vtu"), "--out", path("force.vti")});
  call({"mesh", "sphere", "--level", "1", path("ball.vtu")});
  const std::vector<std::pair<std::vector<std::string>, std::string>> all = {
      {{"fluid", "--state", path("state.vti"), "--out", path("new.vti"), "--fields", path("state.vti")},
       "--state"},
      {{"fluid", "--force", path("force.vti"), "--out", path("new.vti"), "--fields", path("force.vti")},
       "--force"},
      {{"membrane", "--in", path("rest.vtu"), "--out", path("rest.vtu")}, "--in"},
      {{"membrane", "--in", path("rest.vtu"), "--state", path("./rest.vtu"), "--out", path("rest.vtu")},
       "--in"},
      {{"coupler", "interpolate", "--in", path("rest.vtu"), "--grid", path("flow.vti"), "--out",
        path("rest.vtu")},
       "--in"},
      {{"membrane", "--set", "capsule.0.mesh={file = \"" + path("ball.vtu") + "\"}", "--out",
        path("ball.vtu")},
       "mesh.file"}};
  for (const auto& [command, option] : all)
    EXPECT_THAT(stage(command, 2), HasSubstr("is the file that " + option + " names, which is read"));
  // But a state may be carried on in its place.
  stage({"fluid", "--state", path("state.vti"), "--out", path("state.vti")});
}

TEST_F(Outputs, ThatAreDirectoriesAreNew) {
  record();
  const std::vector<std::pair<std::vector<std::string>, std::string>> all = {
      {of_case({"membrane", "--motion", "twist", "--out"}), "--out"},
      {{"replay", path("record"), "--only", "fluid", "--out"}, "--out"},
      {{"run", path("case.toml"), "--output"}, "--output"},
      {{"run", path("case.toml"), "--output", path("new"), "--record"}, "--record"}};
  std::filesystem::create_directory(path("full"));
  std::ofstream(path("full/notes.txt")) << "mine";
  const auto text = read_file(path("case.toml"));
  for (const auto& [command, name] : all) {
    const OutputOption option{command, name, ""};
    EXPECT_THAT(call(to(option, path("full")), 2), HasSubstr(name + " " + path("full") + ": "));
    EXPECT_THAT(call(to(option, path("case.toml")), 2), HasSubstr(name + " " + path("case.toml") + ": "));
  }
  EXPECT_EQ(read_file(path("full/notes.txt")), "mine");
  EXPECT_EQ(read_file(path("case.toml")), text);
  EXPECT_FALSE(std::filesystem::exists(path("new")));
  EXPECT_THAT(call({"run", path("case.toml"), "--output", path("new"), "--record", path("new")}, 2),
              HasSubstr("is a place of the run's own output"));
  EXPECT_THAT(call({"run", path("case.toml"), "--output", path("record"), "--force"}, 2),
              HasSubstr("holds a record"));
  EXPECT_FALSE(std::filesystem::exists(path("new")));
}

/// The case with the first capsule of this file.
std::vector<std::string> with_mesh(const std::string& file) {
  return {"--set", "capsule.0.mesh={file = \"" + file + "\"}"};
}

TEST_F(Outputs, OfARunAreNotTakenForAStressFreeShapeWithoutARemark) {
  // One capsule: two would be two parts.
  std::ofstream(path("case.toml")) << R"([flow]
box = [18, 18, 18]
wall_speed = 0.02
[[capsule]]
radius = 4
position = [9, 9, 9]
mesh = { level = 1 }
[membrane]
capillary_number = 0.3
[run]
shear_time = 0.01
[output]
membrane_every = 0.01
)";
  call({"run", path("case.toml"), "--output", path("out")});
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(path("out/membrane")))
    files.push_back(entry.path());
  std::ranges::sort(files);
  ASSERT_EQ(files.size(), 2);
  const auto plan_with = [&](const std::string& file, int exit_code) {
    auto command = with_mesh(file);
    command.insert(command.begin(), {"plan", path("case.toml")});
    // Warnings are broken into lines.
    return std::regex_replace(call(command, exit_code), std::regex("\\s+"), " ");
  };
  const auto remark = HasSubstr("is the deformed membrane of shear time");
  EXPECT_THAT(plan_with(files[0], 0), ::testing::Not(remark));
  EXPECT_THAT(plan_with(files[1], 0), AllOf(remark, HasSubstr("stress-free")));
  std::vector<std::string> checkpoints;
  for (const auto& entry : std::filesystem::directory_iterator(path("out/checkpoints")))
    checkpoints.push_back(entry.path() / "membrane.vtu");
  std::ranges::sort(checkpoints);
  EXPECT_THAT(plan_with(checkpoints.front(), 0), ::testing::Not(remark))
      << "at rest it is the stress-free shape";
  EXPECT_THAT(plan_with(checkpoints.back(), 2),
              AllOf(HasSubstr("is the state of a deformed membrane"), HasSubstr("reference_position")));
}

}  // namespace
}  // namespace tanktread::testing
