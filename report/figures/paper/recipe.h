// The recipe of a figure for a paper: its runs, panels and size. YAML, read as strictly as a scenario.
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

/// The left or the right axis of a panel with curves.
struct AxisRecipe {
  std::vector<std::string> columns, names;
  std::string label;
  std::vector<double> range;
  void fields(Fields& f);
};

struct PanelRecipe {
  const PanelKind* kind;
  std::vector<std::string> runs;  ///< curves; empty: all
  std::string run;                ///< other kinds; empty: the only one
  AxisRecipe left, right;
  std::string stance;                    ///< name of a leg
  std::vector<std::string> joints{"*"};  ///< patterns; joints without a motor are left out
  std::string joint;
  std::vector<double> times;  ///< s
  bool legend = true;
  double from = 0, to = 0;  ///< s; to 0: the end
  double height = 0;        ///< mm; 0: chosen by the panel
  PanelRecipe();
  void fields(Fields& f);
  void time_fields(Fields& f);  ///< from, to
  void height_field(Fields& f);
  void joint_fields(Fields& f);  ///< joints over time: joints, from, to, height
};

struct Recipe {
  std::string file;
  std::vector<Named> runs;  ///< name and folder as written
  double width = 88.9;      ///< mm
  double height = 0;        ///< mm; 0: sum of the panels
  double font = 8;          ///< pt
  bool letters = true;
  std::vector<PanelRecipe> panels;
  Node root;  ///< of the file

  /// All keys except `gaitlab` and `size`.
  void fields(Fields& f);
  /// Place of a value in the file, by keys and numbers of items; as far as the path exists.
  [[nodiscard]] SourceLocation place(const std::vector<std::string>& path) const;
};

/// Reads a recipe. Throws InputError with every finding at FILE:LINE:COL; the runs are not read.
Recipe read_recipe(const std::string& file);

/// Names of the kinds of panels; a kind by its name, which exists.
std::span<const char* const> panel_names();
const PanelKind& panel_kind(std::string_view name);
/// The manual of a kind of panel: `gaitlab explain figure KIND`.
std::string explain_panel(const PanelKind& kind);
/// Manuals of all kinds: docs/reference/figure.md.
std::string recipe_page();

}  // namespace gaitlab::report
