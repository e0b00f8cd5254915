#include "core/scenario/height_file.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

#include "core/files/atomic_file.h"
#include "core/files/gzip.h"
#include "core/files/hash.h"
#include "core/files/number_table.h"
#include "core/settings/grid.h"
#include "core/settings/text_file.h"

namespace gaitlab {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMostBytes = sizeof(double) * kMostHeights + (std::uintmax_t{1} << 20);

enum class HeightFormat { text, npy, npy_in_gzip, png };

/// Format of a file, by its first bytes or its extension.
HeightFormat format_of(const std::string& path, const std::string& start) {
  const fs::path extension = fs::path(path).extension();
  if (start.starts_with(kNpyMagic) || extension == ".npy") return HeightFormat::npy;
  if (start.starts_with(kGzipMagic) || extension == ".gz") return HeightFormat::npy_in_gzip;
  if (start.starts_with(kPngMagic) || extension == ".png") return HeightFormat::png;
  return HeightFormat::text;
}

/// Reader of a file of heights into a heightfield.
class HeightFile {
 public:
  HeightFile(const Node& map, const std::string& folder, Problems& problems)
      : map_(map), file_(*map.find("file")), folder_(folder), path_(path_from(folder, file_.text)), problems_(problems) {}

  SourceLocation read(Heightfield& field) {
    std::optional<NumberTable> table = numbers();
    if (!table) return place_;
    std::vector<double> heights = std::move(table->values);
    for (std::size_t i = 0; i < heights.size(); ++i) {
      heights[i] *= field.source.scale;
      if (std::abs(heights[i]) <= kHeights.max) continue;  // the comparison is false for NaN as well
      problems_.add({path_}, fmt::format("height [{}, {}], counted from 0, is {}; expected {}", i / table->columns,
                                         i % table->columns, with_unit(heights[i], kHeights.unit), range_text(kHeights)));
      return place_;
    }
    field.columns = table->columns;
    field.values = std::move(heights);
    field.source.hash = heights_hash(field);
    if (!is_of_record(field.source.hash)) return place_;
    field.source.file = fs::canonical(path_).string();
    if (field.values.size() <= kMostWritten) field.source = {};
    return place_;
  }

 private:
  /// Numbers of the file. If the file is invalid, adds a problem and returns nothing.
  std::optional<NumberTable> numbers() try {
    const HeightFormat format = format_of(path_, read_start(path_, kPngMagic.size()));
    if (format == HeightFormat::text) return text();
    if (format == HeightFormat::png && map_.find("scale") == nullptr) {
      problems_.add(
          file_.place,
          fmt::format("file '{}' holds grey values from 0 to 65535; expected `scale`, the metres per grey value", path_));
      return {};
    }
    std::string bytes = read_file(path_, kMostBytes);
    place_ = {path_};
    if (format == HeightFormat::npy_in_gzip) bytes = gunzip(bytes, kMostBytes);
    return format == HeightFormat::png ? read_grey_png(bytes, kMostHeights) : read_npy(bytes, kMostHeights);
  } catch (const TableError& error) {
    problems_.add({path_}, error.what());
    return {};
  } catch (const InputError& error) {
    problems_.add(file_.place, fmt::format("file '{}' {}", path_, error.problems().front().text));
    return {};
  }

  std::optional<NumberTable> text() {
    Problems found;
    Rows rows;
    try {
      const std::string bytes = read_text(path_, file_.place);
      const Node node = grid_node(bytes, path_);
      place_ = node.place;
      rows = read_rows(node, "row", kHeights, found);
    } catch (const InputError& error) {
      add_all(error, found);
    }
    const bool sound = found.empty();
    add_found(found, {path_, folder_, "file of heights", ""}, problems_);
    if (!sound) return {};
    NumberTable table{rows.size(), rows.empty() ? 0 : rows[0].size(), {}};
    for (const std::vector<double>& row : rows) table.values.insert(table.values.end(), row.begin(), row.end());
    return table;
  }

  /// Returns false, with a problem, if the scenario records another hash of the heights.
  bool is_of_record(const std::string& of_heights) {
    const Node* recorded = map_.find("hash");
    if (recorded == nullptr || recorded->text == of_heights) return true;
    problems_.add(recorded->place, fmt::format("file '{}' is not the recorded file: its hash is {}, but {} is recorded", path_,
                                               of_heights, clipped(recorded->text)));
    return false;
  }

  const Node& map_;
  const Node& file_;
  std::string folder_, path_;
  Problems& problems_;
  SourceLocation place_ = file_.place;
};

/// The heights as bytes.
std::string_view bytes_of(const Heightfield& field) {
  static_assert(std::endian::native == std::endian::little);
  const std::vector<double>& heights = field.values.list();
  return {reinterpret_cast<const char*>(heights.data()), heights.size() * sizeof(double)};
}

}  // namespace

std::string heights_hash(const Heightfield& field) {
  const std::string head = npy_head(field.rows(), field.columns);
  const std::string_view heights = bytes_of(field);
  WordHash hash;
  hash.add_length(head.size() + heights.size());
  hash.add_words(head);
  hash.add_words(heights);
  return hash.text();
}

std::string heights_name(const Heightfield& field) { return fmt::format("heights-{}.npy.gz", field.source.hash); }

std::string packed_heights(const Heightfield& field) {
  std::string matrix = npy_head(field.rows(), field.columns);
  matrix += bytes_of(field);
  return gzip(matrix);
}

SourceLocation read_height_file(const Node& map, const std::string& folder, Heightfield& field, Problems& problems) {
  return HeightFile(map, folder, problems).read(field);
}

}  // namespace gaitlab
