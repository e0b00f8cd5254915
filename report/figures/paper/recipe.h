// The recipe of a figure for a paper: which runs, which panels, how large. YAML, read as strictly as a scenario.
#pragma once
#include <string>
#include <vector>

#include "core/names.h"
#include "core/plugin/fields.h"
#include "core/settings/node.h"

namespace gaitlab {

namespace report {

enum class PanelKind { curves, envelope, heat, footfalls, views };

}  // namespace report

template <>
struct EnumNames<report::PanelKind> {
  using enum report::PanelKind;
  static constexpr EnumName<report::PanelKind> kTable[] = {
      {curves, "curves"}, {envelope, "envelope"}, {heat, "heat"}, {footfalls, "footfalls"}, {views, "views"}};
};

namespace report {

/// The left or the right axis of a panel with curves.
struct AxisRecipe {
  std::vector<std::string> columns, names;
  std::string label;
  std::vector<double> range;
  void fields(Fields& f);
};

struct PanelRecipe {
  PanelKind kind = PanelKind::curves;
  std::vector<std::string> runs;  ///< curves; empty: all
  std::string run;                ///< other kinds; empty: the only one
  AxisRecipe left, right;
  std::string stance;                    ///< name of a leg
  std::vector<std::string> joints{"*"};  ///< patterns; without those that have no motor
  std::string joint;
  std::vector<double> times;  ///< s
  bool legend = true;
  double from = 0, to = 0;  ///< s; to 0: the end
  double height = 0;        ///< mm; 0: chosen
  void fields(Fields& f);
};

struct Recipe {
  std::string file;
  std::vector<Named> runs;  ///< name and folder as it is written
  double width = 88.9;      ///< mm
  double height = 0;        ///< mm; 0: what the panels need
  double font = 8;          ///< pt
  bool letters = true;
  std::vector<PanelRecipe> panels;
  Node root;  ///< of the file

  /// All keys but `gaitlab` and `size`.
  void fields(Fields& f);
  /// Of a value in the file, by keys and numbers of items; as far as the path goes.
  [[nodiscard]] SourceLocation place(const std::vector<std::string>& path) const;
};

/// InputError with every finding at FILE:LINE:COL; the runs themselves are not looked at.
Recipe read_recipe(const std::string& file);

/// What a kind of panel shows; the first line is a sentence of its own.
std::string about_panel(PanelKind kind);
/// The manual of a kind of panel: `gaitlab explain figure KIND`.
std::string explain_panel(PanelKind kind);
/// All of them: docs/reference/figure.md.
std::string recipe_page();

}  // namespace report
}  // namespace gaitlab
