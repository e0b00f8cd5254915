#include "interchange/mesh_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string_view>

#include "core/errors.h"
#include "core/files/atomic_file.h"
#include "core/settings/shell_word.h"
#include "core/settings/wording.h"

namespace gaitlab::interchange {

namespace {

constexpr std::uintmax_t kMostBytes = 200'000'000;
constexpr std::size_t kMostVertices = 4'000'000;
constexpr std::size_t kStlHead = 84, kStlTriangle = 50;  // bytes
constexpr double kGap = 0.01;                            // share of the longest edge
constexpr int kSteps = 16;                               // of the octahedron's edges: 4 steps^2 + 2 directions

std::string ending_of(const std::string& file) {
  std::string ending = std::filesystem::path(file).extension().string();
  std::ranges::transform(ending, ending.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return ending;
}
bool is_stl(const std::string& file) { return ending_of(file) == ".stl"; }

/// Integer points of the octahedron |i| + |j| + |k| = steps, as unit vectors, sorted.
const std::vector<Vec3>& directions() {
  static const std::vector<Vec3> kDirections = [] {
    std::vector<Vec3> all;
    for (int i = -kSteps; i <= kSteps; ++i) {
      const int rest = kSteps - std::abs(i);
      for (int j = -rest; j <= rest; ++j) {
        const int k = rest - std::abs(j);
        for (const int sign : {-1, 1}) {
          if (k > 0 || sign > 0) all.push_back(Vec3(i, j, sign * k).normalized());
        }
      }
    }
    return all;
  }();
  return kDirections;
}

/// Farthest point along each direction, and its distance.
struct Support {
  std::vector<double> extent;
  std::vector<Vec3> point;
};

bool before(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

Support support(std::span<const Vec3> points) {
  const std::vector<Vec3>& ways = directions();
  Support made{std::vector<double>(ways.size(), -std::numeric_limits<double>::infinity()), std::vector<Vec3>(ways.size())};
  for (std::size_t d = 0; d < ways.size(); ++d) {
    for (const Vec3& point : points) {
      const double at = ways[d].dot(point);
      if (at < made.extent[d] || (at == made.extent[d] && !before(point, made.point[d]))) continue;
      made.extent[d] = at;
      made.point[d] = point;
    }
  }
  return made;
}

class MeshReader {
 public:
  MeshReader(const std::string& file, std::string_view bytes) : file_(file), bytes_(bytes) {}

  std::vector<Vec3> stl() {
    if (bytes_.size() >= kStlHead) {
      std::uint32_t count = 0;
      std::memcpy(&count, bytes_.data() + kStlHead - sizeof count, sizeof count);
      const std::size_t there = (bytes_.size() - kStlHead) / kStlTriangle;
      if (bytes_.size() == kStlHead + std::uint64_t{count} * kStlTriangle) return binary(there);
      if (!is_text()) {
        throw InputError(SourceLocation{file_}, fmt::format("{} triangles are announced, the file has {} and {} further bytes",
                                                            count, there, (bytes_.size() - kStlHead) % kStlTriangle));
      }
    }
    return text("vertex");
  }
  std::vector<Vec3> obj() { return text("v"); }

 private:
  [[nodiscard]] bool is_text() const { return bytes_.find('\0') == std::string_view::npos; }

  void add(const Vec3& point, const SourceLocation& place) {
    if (!point.allFinite()) throw InputError(place, "a vertex has a coordinate that is not finite");
    if (points_.size() == kMostVertices)
      throw InputError(SourceLocation{file_}, fmt::format("has more than {} vertices", kMostVertices));
    points_.push_back(point);
  }

  std::vector<Vec3> binary(std::size_t triangles) {
    static_assert(std::endian::native == std::endian::little, "STL is little-endian");
    for (std::size_t t = 0; t < triangles; ++t) {
      float numbers[12];
      std::memcpy(numbers, bytes_.data() + kStlHead + t * kStlTriangle, sizeof numbers);
      for (std::size_t v = 3; v < 12; v += 3) add(Vec3(numbers[v], numbers[v + 1], numbers[v + 2]), {file_});
    }
    return std::move(points_);
  }

  /// Vertices of lines that begin with `word`.
  std::vector<Vec3> text(std::string_view word) {
    int line = 1;
    for (std::size_t at = 0; at < bytes_.size(); ++line) {
      const std::size_t end = std::min(bytes_.find('\n', at), bytes_.size());
      read_line(bytes_.substr(at, end - at), word, line);
      at = end + 1;
    }
    return std::move(points_);
  }

  void read_line(std::string_view line, std::string_view word, int number) {
    constexpr std::string_view kBlanks = " \t\r";
    std::size_t at = std::min(line.find_first_not_of(kBlanks), line.size());
    const std::string_view rest = line.substr(at);
    if (!rest.starts_with(word) || rest.size() == word.size() || kBlanks.find(rest[word.size()]) == std::string_view::npos)
      return;
    at += word.size();
    Vec3 point;
    for (double& coordinate : point) {
      at = std::min(line.find_first_not_of(kBlanks, at), line.size());
      const char* const begin = line.data() + at;
      const char* const last = line.data() + line.size();
      const auto [end, error] = std::from_chars(begin < last && *begin == '+' ? begin + 1 : begin, last, coordinate);
      if (error != std::errc()) {
        throw InputError({file_, number, static_cast<int>(at) + 1},
                         fmt::format("expected a number of a vertex, found {}", in_quotes(std::string(line.substr(at)))));
      }
      at = static_cast<std::size_t>(end - line.data());
    }
    add(point, {file_, number, 1});
  }

  const std::string& file_;
  std::string_view bytes_;
  std::vector<Vec3> points_ = {};
};

}  // namespace

bool has_triangles(const std::string& file) { return is_stl(file); }

bool is_mesh_file(const std::string& file) { return is_stl(file) || ending_of(file) == ".obj"; }

std::vector<Vec3> mesh_vertices(const std::string& file) {
  if (!is_mesh_file(file)) {
    const std::string to = std::filesystem::path(file).stem().string() + ".stl";
    throw InputError(SourceLocation{file}, fmt::format("is a mesh of kind {}; expected STL or OBJ: assimp export {} {}",
                                                       in_quotes(ending_of(file)), shell_word(file), shell_word(to)));
  }
  const std::string bytes = read_file(file, kMostBytes);
  MeshReader reader(file, bytes);
  std::vector<Vec3> points = is_stl(file) ? reader.stl() : reader.obj();
  if (points.empty()) throw InputError(SourceLocation{file}, "has no vertices");
  return points;
}

double enclosed_volume(std::span<const Vec3> triangles) {
  constexpr double kOpen = 1e-3;
  Vec3 areas = Vec3::Zero();
  double size = 0;
  double six_volumes = 0;
  for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
    const Vec3 a = triangles[i] - triangles[0];
    const Vec3 b = triangles[i + 1] - triangles[0];
    const Vec3 c = triangles[i + 2] - triangles[0];
    const Vec3 area = (b - a).cross(c - a);
    areas += area;
    size += area.norm();
    six_volumes += a.dot(b.cross(c));
  }
  const bool closed = areas.norm() <= kOpen * size;
  return closed ? std::abs(six_volumes) / 6 : std::numeric_limits<double>::quiet_NaN();
}

MeshHull hull_of_few(std::span<const Vec3> points) {
  if (points.empty()) return {};
  const std::vector<Vec3>& ways = directions();
  const Support whole = support(points);
  Vec3 low = points[0];
  Vec3 high = points[0];
  for (const Vec3& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const double edge = (high - low).maxCoeff();
  std::vector<double> reached(ways.size(), -std::numeric_limits<double>::infinity());
  MeshHull made;
  while (true) {
    std::size_t worst = 0;
    for (std::size_t d = 1; d < ways.size(); ++d) {
      if (whole.extent[d] - reached[d] > whole.extent[worst] - reached[worst]) worst = d;
    }
    const double missing = whole.extent[worst] - reached[worst];
    made.gap = edge > 0 ? missing / edge : 0;
    if (!(made.gap > kGap) || made.points.size() == kFewPoints) return made;
    made.points.push_back(whole.point[worst]);
    for (std::size_t d = 0; d < ways.size(); ++d) reached[d] = std::max(reached[d], ways[d].dot(made.points.back()));
  }
}

}  // namespace gaitlab::interchange
