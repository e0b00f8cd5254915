#include "core/settings/shipped_files.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "core/settings/data_folder.h"

namespace gaitlab {

namespace {

namespace fs = std::filesystem;

/// Folder in the data, and ending of its files, for each kind.
struct ShippedKind {
  const char* kind;
  std::array<const char*, 3> folders;
  const char* ending;
};
constexpr ShippedKind kShipped[] = {
    {"module", {"modules", nullptr}, ".yaml"}, {"robot", {"robots", nullptr}, ".dat"},
    {"servo", {"servos", nullptr}, ".yaml"},   {"scenario", {".", "library", "imported"}, ".yaml"},
    {"cpg", {"cpg", nullptr}, ".yaml"},        {"study", {"studies", nullptr}, ".yaml"},
    {"recipe", {"figures", nullptr}, ".yaml"}};

}  // namespace

std::map<std::string, std::string> shipped_files(const std::string& kind) {
  std::map<std::string, std::string> files;
  const ShippedKind& shipped = *std::ranges::find(kShipped, kind, &ShippedKind::kind);
  for (const char* folder : shipped.folders) {
    if (folder == nullptr) continue;
    std::error_code none;  // ignored: an installation without data has an empty list
    for (const auto& file : fs::directory_iterator((fs::path(data_folder()) / folder).lexically_normal(), none)) {
      if (file.path().extension() == shipped.ending)
        files[file.path().stem().string()] = file.path().lexically_normal().string();
    }
  }
  return files;
}

}  // namespace gaitlab
