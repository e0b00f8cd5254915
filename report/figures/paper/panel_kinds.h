// The table of panel kinds of a figure for a paper; its first entry is the default.
#pragma once
#include <memory>

namespace gaitlab {
class Fields;
}

namespace gaitlab::report {

class PaperPanel;
struct PanelRecipe;
struct PanelSource;

/// A kind of panel. Each is defined in the file of its `PaperPanel`.
struct PanelKind {
  const char* name;
  const char* about;                                        ///< manual text, whose first line is a complete sentence
  bool one_run;                                             ///< true if the key `run` chooses one run; false if `runs` chooses
                                                            ///< several
  void (*fields)(PanelRecipe& panel, Fields& f);            ///< declares the keys of the kind besides `kind` and `run`
  const char* (*lacking)(const PanelRecipe& panel);         ///< message about missing keys, or nullptr if none is missing
  std::unique_ptr<PaperPanel> (*make)(const PanelSource&);  ///< makes the panel and collects problems of its keys
};

extern const PanelKind kCurvesPanel, kEnvelopePanel, kHeatPanel, kFootfallsPanel, kViewsPanel;
inline constexpr const PanelKind* kPanelKinds[] = {&kCurvesPanel, &kEnvelopePanel, &kHeatPanel, &kFootfallsPanel, &kViewsPanel};

}  // namespace gaitlab::report
