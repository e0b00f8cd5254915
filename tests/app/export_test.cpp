// Tests of `export --to gltf`: files, notes, complete messages.
#include "tests/folders.h"
#include "tests/interchange/glb_file.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

class ExportGltf : public ::testing::Test {
 protected:
  Result call(const std::string& arguments) { return gaitlab(arguments, folder / ""); }
  void refused(const std::string& arguments, const std::string& message) {
    const Result result = call(arguments);
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(result.err, message + "\n");
    EXPECT_EQ(result.out, "");
    EXPECT_FALSE(std::filesystem::exists(folder / "x.glb"));
  }
  void make_run(const std::string& name, const std::string& sets = "") {
    std::filesystem::create_directory_symlink(kScenarios + "modules", folder / "modules");
    folder.write("two.yaml", "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\nduration: 0.1\n");
    ASSERT_EQ(call("run two.yaml --quiet --out " + name + sets).code, 0);
  }

  Folder folder;
};

TEST_F(ExportGltf, OfARunMovesAndOfAScenarioStands) {
  make_run("run");
  Result result = call("export run --to gltf run.glb");
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.out, "run.glb: 6 bodies, 4 joints, 6 frames\n");
  EXPECT_EQ(result.err, "");
  const std::string bytes = read(folder / "run.glb");
  const GlbFile file(bytes);
  EXPECT_EQ(file.json()["asset"], nlohmann::json::parse(R"({"version": "2.0", "generator": "gaitlab 0.1.0"})"));
  EXPECT_EQ(file.times().size(), 6U);

  std::filesystem::create_directory(folder / "elsewhere");
  std::filesystem::rename(folder / "run", folder / "elsewhere/moved");
  EXPECT_EQ(call("export elsewhere/moved --to gltf again.glb").code, 0);
  EXPECT_TRUE(read(folder / "again.glb") == bytes) << "the same bytes from the same run, wherever it lies";

  result = call("export two.yaml --to gltf two.glb --set name=other");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.out, "two.glb: 6 bodies, 4 joints, standing\n");
  EXPECT_EQ(GlbFile(read(folder / "two.glb")).json()["scenes"][0]["name"], "other");
}

TEST_F(ExportGltf, TakesFoldersOfCsv) {
  make_run("csv", " --format csv");
  ASSERT_EQ(call("run two.yaml --quiet --out h5").code, 0);
  EXPECT_EQ(call("export csv --to gltf csv.glb").code, 0);
  EXPECT_EQ(call("export h5 --to gltf h5.glb").code, 0);
  EXPECT_TRUE(read(folder / "csv.glb") == read(folder / "h5.glb"));
}

TEST_F(ExportGltf, Refusals) {
  make_run("run");
  std::filesystem::create_directory(folder / "empty");
  refused("export empty --to gltf x.glb", "empty: error: holds neither trace.h5 nor trace.csv: it is not a run folder");
  refused("export run --to gltf two.yaml", "two.yaml: error: exists; nothing was written");
  refused("export run --to gltf no/x.glb", "no/x.glb: error: cannot be written: its folder does not exist");
  refused("export run --to gltf x.glb --set duration=1",
          "--set duration=1: error: a recorded run cannot be changed; expected a scenario in place of the run");
  // An older run folder contains a trace without poses.
  std::filesystem::create_directory(folder / "old");
  std::filesystem::copy(folder / "run/scenario.resolved.yaml", folder / "old/scenario.resolved.yaml");
  folder.write("old/trace.csv", "t,joint.0.angle\n0,0\n0.1,1\n");
  const Result result = call("export old --to gltf x.glb");
  EXPECT_EQ(result.code, 2);
  EXPECT_TRUE(result.err.starts_with("old: error: does not contain the robot's motion: old/trace.csv contains only rows: "))
      << result.err;
  EXPECT_TRUE(result.err.ends_with("; simulate it again: gaitlab rerun old\n")) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "x.glb"));
}

TEST_F(ExportGltf, NamesWhatIsNotDrawn) {
  folder.write("ghost.yaml", R"(
gaitlab_module: 1
name: ghost
bodies:
  seen: {mass: 1, com: [0, 0, 0], inertia: [0.001, 0.001, 0.001, 0, 0, 0], shape: [{sphere: 0.05}], source: "chosen"}
  unseen: {mass: 1, com: [0, 0, 0.1], inertia: [0.001, 0.001, 0.001, 0, 0, 0], shape: [], source: "chosen"}
hinges:
  - {name: hinge, parent: seen, child: unseen, origin: [0, 0, 0], axis: [0, 1, 0], range: [-3, 3], source: "chosen"}
faces: []
contacts: {feet: [], all: []}
)");
  folder.write("ghost-run.yaml",
               "gaitlab: 1\nrobot: {modules: ghost.yaml, base: fixed, position: [0, 0, 1]}\ncontact: {on: none}\n"
               "actuator: {type: none}\nduration: 0.1\n");
  const Result result = call("export ghost-run.yaml --to gltf ghost.glb");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err, "ghost-run.yaml: note: bodies without a shape, which are not drawn: m0/unseen\n");
}

}  // namespace
}  // namespace gaitlab::test
