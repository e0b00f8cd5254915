// Files of a run folder, written from a run that has ended.
#pragma once
#include <exception>
#include <filesystem>
#include <functional>
#include <new>
#include <set>
#include <string>

#include "core/errors.h"
#include "report/verdict/verdict.h"

namespace gaitlab::kit {

inline constexpr const char* kPageFile = "report.html";  ///< name of the page in a run folder

/// Writer of the files of a run. A file is written even if others failed, so that one failure does not lose hours of
/// simulation.
class RunWriter {
 public:
  /// `lost` is called immediately with the reason if a file cannot be written. Each reason is reported only once.
  RunWriter(std::filesystem::path folder, std::function<void(const std::string& why)> lost)
      : folder_(std::move(folder)), lost_(std::move(lost)) {}

  template <class Write>
  void write(const char* name, const Write& file) {
    try {
      file(folder_ / name);
      ++written_;
    } catch (const std::bad_alloc&) {
      lose((folder_ / name).string() + ": cannot be written: out of memory");
    } catch (const RunError& error) {
      lose(error.what());
    }
  }
  void write_text(const char* name, const std::function<std::string()>& text);
  /// Writes trace.h5 or, if `format` is csv, trace.csv and recording.h5; scenario.resolved.yaml; and, if that file names a file
  /// of heights, the file of heights.
  void write_run(const std::string& format, const Scenario& scenario, const Recording& recording);
  /// Writes figure.svg, verdict.json, with `page` report.html, and then summary.json, so that a folder with a summary is
  /// complete except for files that failed.
  void write_report(const Scenario& scenario, const Recording& recording, const report::Summary& summary,
                    const report::Verdict& verdict, bool page);
  [[nodiscard]] bool lost_any() const { return !losses_.empty(); }
  [[nodiscard]] bool wrote_any() const { return written_ > 0; }

 private:
  void lose(const std::string& why) {
    if (losses_.insert(why).second) lost_(why);
  }

  std::filesystem::path folder_;
  std::function<void(const std::string&)> lost_;
  int written_ = 0;
  std::set<std::string> losses_;
};

}  // namespace gaitlab::kit
