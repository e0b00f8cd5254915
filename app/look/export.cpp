#include <fmt/format.h>

#include <filesystem>

#include "app/shell/commands.h"
#include "core/build_id.h"
#include "core/errors.h"
#include "core/files/atomic_file.h"
#include "core/recording/csv.h"
#include "core/recording/run_files.h"
#include "core/settings/wording.h"
#include "interchange/gltf.h"
#include "interchange/mesh.h"
#include "interchange/mjcf.h"
#include "interchange/urdf.h"
#include "kit/stored_scenario.h"
#include "report/figures/run/views.h"

namespace gaitlab::app {

namespace {

struct ExportArguments {
  ScenarioArguments source;  ///< `file` is a run folder or trace file (csv, gltf) or a scenario (mjcf, urdf, gltf)
  std::string format;        ///< csv, gltf, mjcf or urdf
  std::string file;          ///< file to write, which must not exist
  bool strict = false;       ///< mjcf: exact dynamics, without contacts and controller
  PluginArguments plugins;
};

void refuse_sets(const ExportArguments& arguments, const char* expected) {
  if (arguments.source.sets.empty()) return;
  throw InputError(SourceLocation{"--set " + arguments.source.sets.front()},
                   fmt::format("a recorded run cannot be changed; expected {}", expected));
}

void export_trace(const ExportArguments& arguments) {
  refuse_sets(arguments, "--to mjcf or urdf");
  const Trace trace = read_trace(arguments.source.file).trace;
  write_csv(trace, arguments.file, Existing::refused);
  fmt::print("{}: {} rows of {} columns\n", one_line(arguments.file), trace.rows(), trace.columns.size());
}

void export_robot(const ExportArguments& arguments) {
  std::error_code none;
  if (std::filesystem::is_directory(arguments.source.file, none)) {
    throw InputError(SourceLocation{arguments.source.file},
                     fmt::format("is a folder, but --to {} needs a scenario file; a run folder contains scenario.resolved.yaml",
                                 arguments.format));
  }
  Catalog catalog = careful_catalog(arguments.plugins);
  const Scenario scenario = read(arguments.source, catalog);
  const auto model = arguments.strict ? interchange::MjcfModel::strict : interchange::MjcfModel::walking;
  write_file(arguments.file,
             arguments.format == "mjcf" ? interchange::to_mjcf(scenario, model) : interchange::to_urdf(scenario),
             Existing::refused);
  fmt::print("{}: {} bodies, {} joints\n", one_line(arguments.file), scenario.robot->bodies.size(),
             scenario.robot->joints.size());
}

/// Appearance with the colours of the figures. The generator is the version without the commit, so that the bytes depend only
/// on the content.
interchange::GltfLook look() {
  const std::string build = build_id();
  return {.generator = "gaitlab " + build.substr(0, build.find('+')),
          .body = report::body_colour,
          .ground = report::colour::kWhite,
          .tile = report::colour::kPale,
          .box = report::colour::kGrey,
          .moving_box = report::colour::kGreen};
}

void write_gltf(const ExportArguments& arguments, const Scenario& scenario, const Recording* recording) {
  const interchange::Gltf made = interchange::to_gltf(scenario, recording, look());
  write_file(arguments.file, made.bytes, Existing::refused);
  fmt::print("{}: {} bodies, {} joints, {}\n", one_line(arguments.file), scenario.robot->bodies.size(),
             scenario.robot->joints.size(), made.frames > 1 ? fmt::format("{} frames", made.frames) : "standing");
  if (const auto hidden = interchange::bodies_without_shape(*scenario.robot); !hidden.empty()) {
    say(arguments.source.file, "note", "bodies without a shape, which are not drawn: " + joined(hidden));
  }
  const Heightfield* relief = scenario.ground.relief();
  if (relief == nullptr) return;
  if (const std::size_t stride = interchange::drawn_stride(*relief); stride > 1)
    say(arguments.source.file, "note", fmt::format("only one height in {} along x and y is drawn", stride));
}

void export_gltf(const ExportArguments& arguments) {
  const std::string& source = arguments.source.file;
  const std::filesystem::path path = source;
  Catalog catalog = careful_catalog(arguments.plugins);
  std::error_code none;
  if (!std::filesystem::is_directory(path, none) && path.extension() != ".h5" && path.extension() != ".csv") {
    write_gltf(arguments, read(arguments.source, catalog), nullptr);
    return;
  }
  refuse_sets(arguments, "a scenario in place of the run");
  const auto [stored, scenario] = read_run(source, catalog);
  const Recording& recording = stored.recording;
  if (!recording.has_states(*scenario.robot)) {
    throw InputError(
        SourceLocation{source},
        fmt::format("does not contain the robot's motion: {}; simulate it again: gaitlab rerun {}",
                    stored.missing.empty() ? "it has no rows" : fmt::format("{}", fmt::join(stored.missing, "; ")), source));
  }
  write_gltf(arguments, scenario, &recording);
  for (const std::size_t box : interchange::boxes_without_way(scenario, recording)) {
    say(source, "note",
        fmt::format("ground.boxes[{0}] is drawn at its start pose, because its columns box.{0}.* are not recorded", box));
  }
}

int export_to(const ExportArguments& arguments) {
  if (arguments.strict && arguments.format != "mjcf") {
    throw InputError(SourceLocation{"--strict"}, fmt::format("found --to {}; expected --to mjcf", arguments.format));
  }
  check_new(arguments.file);
  const auto& make = arguments.format == "csv" ? export_trace : arguments.format == "gltf" ? export_gltf : export_robot;
  make(arguments);
  return 0;
}

}  // namespace

void add_export(Commands& commands) {
  add_command<ExportArguments>(
      commands, "export", "Write a trace, a robot or its motion in another format.", export_to,
      [](CLI::App& command, ExportArguments& arguments) {
        offering(
            command.add_option("SOURCE", arguments.source.file),
            "csv: run folder or trace file; gltf: run folder, trace file or scenario file; mjcf, urdf: scenario file, or a "
            "name of {}",
            {.kinds = {"scenarios"}})
            ->required()
            ->transform(named_file_or_run);
        command
            .add_option(
                "--to", arguments.format,
                fmt::format("csv; gltf (a binary .glb file with the moving robot and its ground: keyframes at rows of the "
                            "trace, at most {} per second; for a scenario, the robot at its start); mjcf (MuJoCo); urdf",
                            interchange::kGltfRate))
            ->required()
            ->check(CLI::IsMember({"csv", "gltf", "mjcf", "urdf"}));
        command.add_option("FILE", arguments.file, "file to write; must not exist")->required();
        command.add_flag(
            "--strict", arguments.strict,
            "with --to mjcf: write only the robot's dynamics, for comparison; the model has no contacts and its controls are "
            "torques. Without --strict the model can stand and walk, and its controls are set points");
        add_trust(command, arguments.plugins);
        offering(command.add_option("--set", arguments.source.sets), "{} in the scenario", {.settings = true})
            ->expected(1)
            ->allow_extra_args(false)
            ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
      });
}

}  // namespace gaitlab::app
