#include "kit/run_writer.h"

#include "core/build_id.h"
#include "core/files/atomic_file.h"
#include "core/recording/recording_file.h"
#include "core/scenario/height_file.h"
#include "core/scenario/resolved.h"
#include "report/figures/paper/run_figure.h"
#include "report/page/page.h"
#include "report/verdict/numbers/summary_text.h"

namespace gaitlab::kit {

void RunWriter::write_text(const char* name, const std::function<std::string()>& text) {
  write(name, [&](const std::filesystem::path& file) { write_file(file, text()); });
}

void RunWriter::write_run(const std::string& format, const Scenario& scenario, const Recording& recording) {
  if (const Heightfield* relief = scenario.ground.relief(); needs_height_file(relief)) {
    write(heights_name(*relief).c_str(), [&](const std::filesystem::path& file) { write_file(file, packed_heights(*relief)); });
  }
  write(format == "csv" ? "trace.csv" : "trace.h5", [&](const std::filesystem::path& file) {
    write_recording(recording, {resolved(scenario), scenario.seed, build_id(), recording.outcome.text()}, format,
                    file.parent_path());
  });
  write_text("scenario.resolved.yaml", [&] { return resolved(scenario); });
}

void RunWriter::write_report(const Scenario& scenario, const Recording& recording, const report::Summary& summary,
                             const report::Verdict& verdict, bool page) {
  write_text("figure.svg", [&] { return report::run_figure(scenario, recording, summary); });
  write_text("verdict.json", [&] { return report::to_json(verdict); });
  if (page) write_text(kPageFile, [&] { return report::page(report::page_data(scenario, recording, summary, verdict)); });
  write_text("summary.json", [&] { return report::to_json(summary, scenario, recording); });
}

}  // namespace gaitlab::kit
