// Meshes of URDF files as hulls: vertices of their files, also of damaged ones, and the few that are kept.
#include "interchange/mesh_points.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>

#include "core/model/solid.h"
#include "tests/folder.h"
#include "tests/interchange/from_urdf.h"
#include "tests/messages.h"
#include "tests/program/fixture.h"

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
TEST_F(MeshPoints, RefusesDamagedFiles) {
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
  for (int i = 0; i <= 4; ++i) {
    for (int j = 0; j <= 4; ++j) {
      for (int k = 0; k <= 4; ++k) points.push_back({i * 0.1, j * 0.2, k * 0.3});
    }
  }
  const std::vector<Vec3> hull = hull_of_few(points).points;
  EXPECT_EQ(hull.size(), 8U);
  for (const Vec3& one : hull)
    for (const double at : {one.x() / 0.4, one.y() / 0.8, one.z() / 1.2}) EXPECT_NEAR(std::abs(2 * at - 1), 1, 1e-12);
}

/// Triangles of a box between two corners, counter-clockwise as seen from outside.
std::vector<Vec3> box_triangles(const Vec3& low, const Vec3& high) {
  std::vector<Vec3> all;
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool far : {false, true}) {
      const auto corner = [&](bool u, bool v) {
        Vec3 at;
        at[axis] = far ? high[axis] : low[axis];
        at[(axis + 1) % 3] = u ? high[(axis + 1) % 3] : low[(axis + 1) % 3];
        at[(axis + 2) % 3] = v ? high[(axis + 2) % 3] : low[(axis + 2) % 3];
        return at;
      };
      const std::array<Vec3, 4> around{corner(false, false), corner(far, !far), corner(true, true), corner(!far, far)};
      for (const int k : {1, 2}) all.insert(all.end(), {around[0], around[k], around[k + 1]});
    }
  }
  return all;
}

TEST(EnclosedVolume, IsThatOfClosedSurfaces) {
  const std::vector<Vec3> box = box_triangles({1, 2, 3}, {1.5, 4, 6});
  EXPECT_NEAR(enclosed_volume(box), 3, 1e-12);
  const std::vector<Vec3> open(box.begin(), box.end() - 3);
  EXPECT_TRUE(std::isnan(enclosed_volume(open)));
  EXPECT_EQ(enclosed_volume({}), 0);
}

/// A frame of four bars fills 0.36 of its hull, and a bar all of it.
TEST_F(FromUrdf, FramesAreNamed) {
  std::vector<Vec3> frame = box_triangles({0, 0, 0}, {1, 0.1, 0.2});
  for (const auto& [low, high] : {std::pair(Vec3(0, 0.9, 0), Vec3(1, 1, 0.2)), std::pair(Vec3(0, 0.1, 0), Vec3(0.1, 0.9, 0.2)),
                                  std::pair(Vec3(0.9, 0.1, 0), Vec3(1, 0.9, 0.2))}) {
    const std::vector<Vec3> bar = box_triangles(low, high);
    frame.insert(frame.end(), bar.begin(), bar.end());
  }
  folder_.write("frame.stl", stl(frame, static_cast<std::uint32_t>(frame.size() / 3)));
  folder_.write("bar.stl", stl(box_triangles({0, 0, 0}, {1, 0.1, 0.2}), 12));
  const auto read = [&](const std::string& file) {
    read_urdf(urdf_link("a", kInertial + ("<collision><geometry><mesh filename='" + file + "'/></geometry></collision>")) +
              urdf_link("b") + urdf_joint("ab", "revolute", "a", "b", kLimit));
    return notes().back();
  };
  EXPECT_EQ(
      read("frame.stl"),
      "2 Changed: 1 mesh fills less than half of the hull, whose openings and bays touch as if they were filled; link 'a' "
      "fills 36 %");
  EXPECT_TRUE(contains(read("bar.stl"), "1 mesh is the convex hull")) << read("bar.stl");
}

/// Text of an OBJ file with the corners of a box between two corners.
std::string obj_box(const Vec3& low, const Vec3& high) {
  std::string text;
  for (const Vec3& at : box_corners(high - low)) {
    const Vec3 corner = at + (low + high) / 2;
    text += fmt::format("v {} {} {}\n", corner.x(), corner.y(), corner.z());
  }
  return text;
}

/// A mesh is the hull of its points, at the place and scale of the URDF file. Its file is found beside the URDF file, above it
/// by the name of its package, or in the folder of --meshes, which comes first.
TEST_F(FromUrdf, MeshesAreHulls) {
  folder_.write("box.obj", obj_box({-0.1, -0.2, -0.3}, {0.3, 0.2, 0.1}));
  std::filesystem::create_directories(folder_ / "dog/meshes");
  folder_.write("dog/meshes/box.obj", obj_box({0, 0, 0}, {2, 2, 2}));
  const auto mesh = [](const std::string& attributes) {
    return "<collision><origin xyz='0 0 1'/><geometry><mesh " + attributes + "/></geometry></collision>";
  };
  const auto bounds_of = [&](const std::string& attributes) {
    const ModuleType type = read_urdf(urdf_link("a", kInertial + mesh(attributes)) + urdf_link("b") +
                                      urdf_joint("ab", "revolute", "a", "b", kLimit));
    EXPECT_EQ(type.bodies[0].shapes.front().kind, Shape::Kind::hull);
    return bounds(type.bodies[0].shapes);
  };
  const auto [low, high] = bounds_of("filename='box.obj' scale='1 0.5 -1'");
  EXPECT_LT((low - Vec3(-0.1, -0.1, 0.9)).norm(), 1e-12);
  EXPECT_LT((high - Vec3(0.3, 0.1, 1.3)).norm(), 1e-12);
  EXPECT_EQ(notes().back(),
            "2 Changed: 1 mesh is the convex hull of at most 32 of its points; the widest gap is 0 % of its "
            "longest edge, in link 'a'");
  for (const char* name : {"package://dog/meshes/box.obj", "dog/meshes/box.obj", "model://dog/meshes/box.obj"})
    EXPECT_EQ(bounds_of("filename='" + std::string(name) + "'").second, Vec3(2, 2, 3)) << name;
  options_.meshes = folder_ / "dog/meshes";
  EXPECT_EQ(bounds_of("filename='package://cat/box.obj'").second, Vec3(2, 2, 3));
  EXPECT_EQ(bounds_of("filename='box.obj'").second, Vec3(2, 2, 3)) << "--meshes comes first";
}

/// Meshes that cannot be read are problems at their link, unless the visual has other shapes; a flat mesh has no shape.
TEST_F(FromUrdf, MeshesThatCannotBeRead) {
  folder_.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n");
  folder_.write("short.stl", std::string(80, '\0') + "\1\1\1\1");
  const auto robot = [](const std::string& parts) {
    return urdf_link("a", kInertial + parts) + urdf_link("b") + urdf_joint("ab", "revolute", "a", "b", kLimit);
  };
  const auto mesh = [](const std::string& file) {
    return "<collision><geometry><mesh filename='" + file + "'/></geometry></collision>";
  };
  const std::string box = "<visual><geometry><box size='1 1 1'/></geometry></visual>";
  const std::string damaged = refused(robot(mesh("short.stl")));
  EXPECT_TRUE(contains(damaged, "r:2:1: error: link 'a' has the mesh 'short.stl': ")) << damaged;
  EXPECT_TRUE(contains(damaged, "16843009 triangles are announced, the file has 0 and 0 further bytes")) << damaged;
  folder_.write("mm.obj", obj_box({0, 0, 0}, {40, 212, 30}));
  EXPECT_EQ(
      refused(robot(mesh("mm.obj"))),
      "r:2:1: error: link 'a' has the mesh 'mm.obj', which is 212 m large; if its numbers are mm, expected scale=\"0.001 0.001 "
      "0.001\"");
  EXPECT_EQ(read_urdf(robot(mesh("none.stl") + box)).bodies[0].shapes.front().kind, Shape::Kind::box);
  EXPECT_EQ(notes().back(),
            "2 Changed: link 'a' has meshes that cannot be read as collision; its visual shapes are its contact");
  EXPECT_TRUE(read_urdf(robot(mesh("flat.obj"))).bodies[0].shapes.empty());
  EXPECT_EQ(notes().back(),
            "2 Changed: link 'a' has the mesh 'flat.obj', all points of which are in one plane; it has no shape");
}

}  // namespace
}  // namespace gaitlab::test
