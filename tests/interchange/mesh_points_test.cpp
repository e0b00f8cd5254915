// Vertices of mesh files, also of files that lie, and the few whose hull nearly is that of all.
#include "interchange/mesh_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numbers>

#include "tests/folder.h"
#include "tests/messages.h"

namespace gaitlab::test {
namespace {

using namespace interchange;

/// Bytes of a binary STL with these vertices, three per triangle, that announces `count` triangles.
std::string stl(const std::vector<Vec3>& vertices, std::uint32_t count) {
  std::string bytes(80, '\0');
  bytes.append(reinterpret_cast<const char*>(&count), 4);
  for (std::size_t v = 0; v < vertices.size(); v += 3) {
    bytes.append(12, '\0');
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3f one = vertices[v + k].cast<float>();
      bytes.append(reinterpret_cast<const char*>(one.data()), 12);
    }
    bytes.append(2, '\0');
  }
  return bytes;
}

class MeshPoints : public ::testing::Test {
 protected:
  std::string refused(const std::string& name, const std::string& bytes) {
    const std::string file = folder_.write(name, bytes);
    std::string text = message_of([&] { mesh_vertices(file); });
    return text.substr(text.find(name));
  }
  Folder folder_;
};

TEST_F(MeshPoints, ReadsStlAndObj) {
  const std::vector<Vec3> triangle{{0, 0, 0}, {1, 0, 0}, {0, 2, 0.5}};
  EXPECT_EQ(mesh_vertices(folder_.write("a.STL", stl(triangle, 1))), triangle);
  EXPECT_EQ(mesh_vertices(folder_.write("b.stl",
                                        "solid b\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n  vertex 1 0 0\r\nvertex 0 +2 "
                                        "5e-1\nendloop\nendfacet\nendsolid\n")),
            triangle);
  EXPECT_EQ(mesh_vertices(folder_.write("c.obj", "# c\nv 0 0 0\nvn 9 9 9\nv 1 0 0 1\nv 0 2 .5\nf 1 2 3\n")), triangle);
}

/// The number of triangles in a file is compared with its length.
TEST_F(MeshPoints, RefusesFilesThatLie) {
  EXPECT_EQ(refused("a.stl", stl({{0, 0, 0}, {1, 0, 0}, {0, 2, 0}}, 4'000'000'000U)),
            "a.stl: error: 4000000000 triangles are announced, the file has 1 and 0 further bytes");
  EXPECT_EQ(refused("b.stl", stl({{0, 0, 0}, {1, 0, 0}, {0, std::numeric_limits<double>::infinity(), 0}}, 1)),
            "b.stl: error: a vertex has a coordinate that is not finite");
  EXPECT_EQ(refused("c.obj", "v 0 0 0\nv 1 x 0\n"), "c.obj:2:5: error: expected a number of a vertex, found 'x 0'");
  EXPECT_EQ(refused("d.obj", "f 1 2 3\n"), "d.obj: error: has no vertices");
  EXPECT_EQ(refused("e.stl", ""), "e.stl: error: has no vertices");
}

/// The eight corners of a box are its hull; points within it are not taken.
TEST_F(MeshPoints, ABoxHasItsCorners) {
  std::vector<Vec3> points;
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; j <= 4; ++j)
      for (int k = 0; k <= 4; ++k) points.push_back({i * 0.1, j * 0.2, k * 0.3});
  const std::vector<Vec3> hull = hull_of_few(points).points;
  EXPECT_EQ(hull.size(), 8U);
  for (const Vec3& one : hull)
    for (const double at : {one.x() / 0.4, one.y() / 0.8, one.z() / 1.2}) EXPECT_NEAR(std::abs(2 * at - 1), 1, 1e-12);
}

}  // namespace
}  // namespace gaitlab::test
