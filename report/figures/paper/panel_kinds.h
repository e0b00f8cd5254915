// The table of the kinds of panels; the first is the default.
#pragma once
#include <memory>

#include "report/figures/paper/recipe.h"

namespace gaitlab::report {

class PaperPanel;
struct PanelSource;

/// A kind of panel, defined beside its `PaperPanel`.
struct PanelKind {
  const char* name;
  const char* about;                                        ///< its first line is a complete sentence
  bool one_run;                                             ///< it draws `run`; otherwise `runs`
  void (*fields)(PanelRecipe& panel, Fields& f);            ///< its keys besides `kind` and `run`
  const char* (*lacking)(const PanelRecipe& panel);         ///< message on missing keys; nullptr: none is missing
  std::unique_ptr<PaperPanel> (*make)(const PanelSource&);  ///< collects problems of the panel
};

extern const PanelKind kCurvesPanel, kEnvelopePanel, kHeatPanel, kFootfallsPanel, kViewsPanel;
inline constexpr const PanelKind* kPanelKinds[] = {&kCurvesPanel, &kEnvelopePanel, &kHeatPanel, &kFootfallsPanel, &kViewsPanel};

}  // namespace gaitlab::report
