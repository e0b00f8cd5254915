// The recipe of a figure for a paper, which is a YAML file with runs, panels and size. The reader rejects unknown keys, like
// the reader of scenarios.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/plugin/fields.h"
#include "core/settings/node.h"

namespace gaitlab::report {

struct PanelKind;

inline constexpr double kLongestTime = 1e9;  ///< s

/// The left or the right axis of a panel of curves.
struct AxisRecipe {
  std::vector<std::string> columns = {}, names = {};
  std::string label = {};
  std::vector<double> range = {};
  bool log = false;
  double least = 0;  ///< least half range of the axis; 0 if there is none
  void fields(Fields& f);
};

struct PanelRecipe {
  const PanelKind* kind;
  std::vector<std::string> runs;  ///< names of runs, in a panel of curves; empty for all runs
  std::string run;                ///< name of the run in panels of other kinds; empty for the only run
  AxisRecipe left, right;
  std::string title;                     ///< above the panel; empty if there is none
  std::string stance;                    ///< name of the leg whose stance phases are shaded
  std::string motor;                     ///< name of the joint whose motor limits are shown
  std::vector<double> marks;             ///< s, times that are marked
  std::vector<std::string> joints{"*"};  ///< patterns of joint names; joints without a motor are left out
  std::string joint;
  std::vector<double> times;  ///< s
  bool legend = true;
  double from = 0, to = 0;  ///< s; `to` 0 means the end of the run
  double height = 0;        ///< mm; 0 if the panel chooses it
  PanelRecipe();
  void fields(Fields& f);
  void time_fields(Fields& f);  ///< declares the keys from, to
  void height_field(Fields& f);
  void joint_fields(Fields& f);  ///< declares the keys of panels with joints over time: joints, from, to, height
};

struct Recipe {
  std::string file;
  std::string title;        ///< above the figure; empty if there is none
  std::vector<Named> runs;  ///< name and folder of each run, as written in the file
  double width = 88.9;      ///< mm
  double height = 0;        ///< mm; 0 for the sum of the panels
  double font = 8;          ///< pt
  bool letters = true;
  double margin = 5;  ///< px, at the sides; 1.1 mm with text of 8 pt, because presses cut and viewers round at the edge
  std::vector<PanelRecipe> panels;
  Node root;  ///< YAML tree of the file

  /// Declares all keys except `gaitlab` and `size`.
  void fields(Fields& f);
  /// Place in the file of the value with this path of keys and item numbers, or of its innermost parent that exists.
  [[nodiscard]] SourceLocation place(const std::vector<std::string>& path) const;
};

/// Reads a recipe, but not its runs. Throws InputError with every problem at FILE:LINE:COL.
Recipe read_recipe(const std::string& file);

/// Names of all panel kinds, and the kind with a given name, which must exist.
std::span<const char* const> panel_names();
const PanelKind& panel_kind(std::string_view name);
/// Text of `gaitlab explain figure KIND`.
std::string explain_panel(const PanelKind& kind);
/// Text of docs/reference/figure.md, which contains the manuals of all kinds.
std::string recipe_page();

}  // namespace gaitlab::report
