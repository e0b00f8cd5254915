// Settings that a remedy changes, with their numbers in a scenario.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/plugin/controller.h"
#include "core/scenario/scenario.h"
#include "core/settings/node.h"

namespace gaitlab::report {

/// A setting, or several that change by the same factor.
struct RemedyKey {
  const char* name;                ///< name in messages and in remedy.json
  std::vector<const char*> paths;  ///< keys of the scenario
  const char* unit;
  std::vector<const char*> also = {};  ///< keys that change by the same factor if the scenario has them
  bool stretches = false;              ///< true: a smaller value makes the duration longer, so that the run has as many periods
  bool of_option = false;  ///< true: a key of a section that most scenarios lack; only a scenario with it lists the key
  bool is_gain = false;    ///< true: the position gain, under the key that the controller declares
};

/// All settings that a remedy may change, in the order in which they are printed.
std::span<const RemedyKey> remedy_keys();

/// Numbers of a resolved scenario, by key. The `u_max` of a servo is its `voltage` if it is 0 or not stated, unless the
/// scenario has a supply, which then is its bound. Values of single joints and entries of lists count as numbers of their key.
/// A path `ground.boxes.friction` means this key in every entry of a list.
class RemedySettings {
 public:
  /// `gains`: law of the scenario's controller. Throws InputError if the text is not a scenario.
  explicit RemedySettings(const std::string& resolved, const std::vector<PositionGains>& gains = {});

  /// Keys of the scenario, and name of a setting with a single key in messages.
  [[nodiscard]] std::vector<std::string> paths(const RemedyKey& key) const;
  [[nodiscard]] std::string name(const RemedyKey& key) const;

  /// Reason why the key cannot be changed: a path is missing, has only numbers 0, or is set by an entry of `at`. Empty
  /// if it can be changed.
  [[nodiscard]] std::string missing(const RemedyKey& key) const;
  /// True if the section of a key is there, or if every scenario can have it.
  [[nodiscard]] bool concerns(const RemedyKey& key) const;
  /// The number of the first path; NaN if there are several numbers or paths.
  [[nodiscard]] double value(const RemedyKey& key) const;
  /// True if all numbers of a path are equal.
  [[nodiscard]] bool uniform(const std::string& path) const;
  /// Settings in the form of --set that multiply every number of the key by `factor`. A key that stretches also sets the
  /// duration, rounded up to 1 ms.
  [[nodiscard]] std::vector<std::string> scaled(const RemedyKey& key, double factor) const;

 private:
  void take_voltage();
  void take_gain(const std::vector<PositionGains>& gains);
  [[nodiscard]] const Node* find(const std::string& path) const;
  [[nodiscard]] std::vector<double> numbers(const std::string& path) const;
  [[nodiscard]] std::string none_of(const std::string& path) const;
  [[nodiscard]] bool changes_in_time(const std::string& path) const;
  void add_scaled(const std::string& path, double factor, std::vector<std::string>& sets) const;

  Node root_;
  std::string gain_;  ///< key of the position gain
};

/// Settings of a scenario. Throws PluginError.
RemedySettings settings_of(const Scenario& scenario);

/// Rounds the value of a setting to a hundredth of its change from `now` or finer: up if `up`, else down.
double rounded_setting(double value, double now, bool up);

}  // namespace gaitlab::report
