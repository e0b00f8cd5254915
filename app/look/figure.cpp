// `gaitlab figure` draws a figure for a paper from run folders and a recipe, and writes the numbers that it shows.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>

#include "app/shell/commands.h"
#include "core/errors.h"
#include "core/files/atomic_file.h"
#include "core/recording/csv.h"
#include "core/recording/recording_file.h"
#include "core/recording/run_files.h"
#include "core/settings/shipped_files.h"
#include "core/settings/text_file.h"
#include "core/settings/wording.h"
#include "kit/stored_scenario.h"
#include "report/figures/paper/paper_figure.h"
#include "report/plot/pdf.h"
#include "report/plot/svg.h"

namespace gaitlab::app {

namespace {

namespace fs = std::filesystem;

struct FigureArguments {
  std::string recipe;
  std::optional<std::string> out, csv;
  std::vector<std::string> runs;  ///< texts NAME=FOLDER
  PluginArguments plugins;
};

/// Path of the data of a panel: FIG.csv, or for several panels FIG-a.csv, FIG-b.csv etc.; FIG is the name of the figure, or
/// that of --csv.
fs::path data_file(const fs::path& named, std::size_t panel, std::size_t panels) {
  fs::path file = named;
  file.replace_extension();
  if (panels > 1) file += fmt::format("-{:c}", static_cast<char>('a' + panel));
  file += ".csv";
  return file;
}

/// Name and folder of every run of the recipe. A folder from --run replaces that of the recipe.
std::vector<Named> folders_of(const report::Recipe& recipe, const std::vector<std::string>& given) {
  std::vector<Named> folders = recipe.runs;
  std::vector<std::string> names;
  for (Named& run : folders) {
    names.push_back(run.name);
    run.text = (fs::path(recipe.file).parent_path() / run.text).lexically_normal().string();
  }
  Problems problems;
  for (const std::string& text : given) {
    const std::size_t equals = text.find('=');
    const std::string name = text.substr(0, equals);
    const auto run = std::ranges::find(folders, name, &Named::name);
    if (equals == std::string::npos || equals + 1 == text.size()) {
      problems.add(SourceLocation{"--run " + text}, "expected NAME=FOLDER");
    } else if (run == folders.end()) {
      problems.add(SourceLocation{"--run " + text},
                   "run " + in_quotes(name) + " is not in the recipe" + offer(name, names, "runs"));
    } else {
      run->text = text.substr(equals + 1);
    }
  }
  problems.raise();
  return folders;
}

/// Reads a run that a recipe in `folder` names.
StoredRun read_named_run(const std::string& run, const std::string& folder, Catalog& catalog) {
  try {
    return read_run(run, catalog);
  } catch (const InputError& error) {
    Problems found;
    Problems told;
    add_all(error, found);
    add_found(found, {trace_file(run).string(), folder, "recording", ""}, told);
    told.raise();
    throw;
  }
}

/// A run of the recipe, as read from its folder.
struct ReadRun {
  std::string name;
  StoredRun stored;
};

std::vector<ReadRun> read_runs(const report::Recipe& recipe, const std::vector<std::string>& given, Catalog& catalog) {
  const std::vector<Named> folders = folders_of(recipe, given);
  Problems problems;
  for (const Named& run : folders) {
    if (kind_of(run.text) == fs::file_type::not_found) {
      problems.add(recipe.place({"runs", run.name}),
                   fmt::format("run {}: {} does not exist; simulate it first, or name its folder with --run {}=FOLDER",
                               in_quotes(run.name), run.text, run.name));
    }
  }
  problems.raise();
  std::vector<ReadRun> runs;
  const std::string folder = fs::path(recipe.file).parent_path().string();
  for (const Named& run : folders) {
    const bool typed = std::ranges::any_of(given, [&](const std::string& text) { return text.starts_with(run.name + "="); });
    StoredRun read = typed ? read_run(run.text, catalog) : read_named_run(run.text, folder, catalog);
    Recording& recording = read.stored.recording;
    if (recording.trace.columns.empty() || recording.trace.columns.front().name != "t")
      throw InputError(SourceLocation{run.text}, "its trace has no column t");
    if (recording.rows() > 0) recording.simulated = recording.trace.at(recording.rows() - 1, 0);
    runs.push_back({run.name, std::move(read)});
  }
  return runs;
}

/// Throws InputError if the numbers would replace another kind of file, that is, one with another first line.
void check_free(const fs::path& file, const std::string& numbers) {
  const fs::file_type kind = kind_of(file);
  if (kind == fs::file_type::not_found) return;
  const std::string head = numbers.substr(0, numbers.find('\n') + 1);
  if (kind == fs::file_type::regular && read_start(file, head.size()) == head) return;
  throw InputError(SourceLocation{file.string()},
                   "has other columns than this figure, and is not replaced; move it away, or name another file with --csv "
                   "FILE.csv. Nothing was written");
}

/// Throws InputError if the folder of a file does not exist.
void check_folder(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (kind_of(folder) != fs::file_type::directory)
    throw InputError(SourceLocation{file.string()}, "cannot be written: its folder does not exist");
}

std::string picture(const report::PaperFigure& figure, const fs::path& file) {
  if (file.extension() == ".svg") {
    report::Svg svg(figure.paper(), figure.title());
    figure.draw(svg);
    return svg.finish();
  }
  report::Pdf pdf(figure.paper(), figure.title());
  figure.draw(pdf);
  for (const char32_t code : pdf.missing()) {
    say(file.string(), "note",
        fmt::format("U+{:04X} is not in the font of figures; the PDF shows ? instead", static_cast<unsigned>(code)));
  }
  return pdf.finish();
}

/// Path of the figure, which must not exist: -o, or RECIPE.svg in the working folder.
fs::path target(const FigureArguments& arguments) {
  fs::path file = arguments.out ? fs::path(*arguments.out) : fs::path(arguments.recipe).stem().replace_extension(".svg");
  if (file.extension() != ".svg" && file.extension() != ".pdf")
    throw InputError(SourceLocation{"-o " + file.string()}, "expected a file named .svg or .pdf");
  if (!arguments.out && kind_of(file) != fs::file_type::not_found)
    throw InputError(SourceLocation{file.string()}, "exists; name it with -o to replace it. Nothing was written");
  if (kind_of(file) == fs::file_type::directory) throw InputError(SourceLocation{file.string()}, "is a folder");
  check_folder(file);
  return file;
}

/// Path that determines the names of the CSV files: --csv, or that of the figure.
fs::path numbers_target(const FigureArguments& arguments, const fs::path& figure) {
  if (!arguments.csv) return figure;
  fs::path file = *arguments.csv;
  if (file.extension() != ".csv") throw InputError(SourceLocation{"--csv " + file.string()}, "expected a file named .csv");
  check_folder(file);
  return file;
}

/// File of a recipe: the file at that path, or else the shipped recipe of that name. Throws InputError if there is neither.
std::string recipe_file(const std::string& named) {
  const fs::file_type kind = kind_of(named);
  if (kind == fs::file_type::directory && kind_of(trace_file(named)) == fs::file_type::regular) {
    throw InputError(
        SourceLocation{named},
        fmt::format(
            "this is a run folder, not a recipe for figures; its figure is {}; a recipe draws the run with --run NAME={}",
            (fs::path(named) / "figure.svg").string(), named));
  }
  if (kind != fs::file_type::not_found) return named;
  const std::map<std::string, std::string> shipped = shipped_files("recipe");
  if (const auto found = shipped.find(named); found != shipped.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [name, file] : shipped) names.push_back(name);
  throw InputError(SourceLocation{named}, "does not exist" + offer(named, names, "recipes"));
}

int figure(const FigureArguments& arguments) {
  const report::Recipe recipe = report::read_recipe(recipe_file(arguments.recipe));
  const fs::path file = target(arguments);
  const fs::path numbers = numbers_target(arguments, file);
  Catalog catalog = careful_catalog(arguments.plugins);
  const std::vector<ReadRun> read = read_runs(recipe, arguments.runs, catalog);
  std::vector<report::PaperRun> runs;
  for (const auto& [name, run] : read) runs.push_back({name, run.scenario, run.stored.recording});
  const report::PaperFigure figure(recipe, runs);
  const std::vector<Trace> tables = figure.data();
  std::vector<fs::path> files;
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    files.push_back(data_file(numbers, i, tables.size()));
    texts.push_back(csv_text(tables[i], files.back()));
    check_free(files.back(), texts.back());
  }
  const std::string drawn = picture(figure, file);
  for (std::size_t i = 0; i < files.size(); ++i) write_file(files[i], texts[i]);
  write_file(file, drawn, arguments.out ? Existing::replaced : Existing::refused);
  for (const std::string& note : figure.notes()) say(arguments.recipe, "note", note);
  const report::Paper& paper = figure.paper();
  fmt::print("{}: {:.1f} x {:.1f} mm\n", one_line(file.string()), paper.width * paper.mm, paper.height * paper.mm);
  for (std::size_t i = 0; i < files.size(); ++i)
    fmt::print("{}: {} rows of {} columns\n", one_line(files[i].string()), tables[i].rows(), tables[i].columns.size());
  return 0;
}

}  // namespace

void add_figure(Commands& commands) {
  add_command<FigureArguments>(
      commands, "figure", "Draw a figure for a paper from run folders, with the numbers that it shows as CSV.", figure,
      [](CLI::App& command, FigureArguments& arguments) {
        command.add_option("RECIPE", arguments.recipe, "recipe (YAML); its keys: gaitlab explain figure curves")->required();
        command.add_option("-o,--out", arguments.out,
                           "FIG.svg or FIG.pdf, replaced if it exists; the numbers go to FIG.csv (default: RECIPE.svg, new)");
        command.add_option("--csv", arguments.csv, "FILE.csv for the numbers, instead of FIG.csv");
        add_trust(command, arguments.plugins);
        command.add_option("--run", arguments.runs, "NAME=FOLDER: another folder for a run of the recipe; may be repeated")
            ->expected(1)
            ->allow_extra_args(false)
            ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
      });
}

}  // namespace gaitlab::app
