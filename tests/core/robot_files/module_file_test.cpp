#include "core/robot_files/module_file.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/core/scenario/fakes.h"
#include "tests/folders.h"
#include "tests/messages.h"

namespace gaitlab {
namespace {

class ModuleFileTest : public testing::Test {
 protected:
  /// Message of the error for the module of two bodies with one text replaced.
  std::string error(const std::string& from, const std::string& to) {
    std::string text = fakes::kDuo;
    const std::size_t at = text.find(from);
    if (at == std::string::npos) return "the test's text is not there: " + from;
    text.replace(at, from.size(), to);
    const std::string path = folder_.write("m.yaml", text);
    return folder_.shown(test::message_of([&] { read_module_file(path); }));
  }
  fakes::Folder folder_;
};

TEST_F(ModuleFileTest, ReadsAModule) {
  const ModuleType type = read_module_file(folder_.write("m.yaml", fakes::kDuo)).type;
  EXPECT_EQ(type.name, "duo");
  EXPECT_FALSE(type.lattice);
  ASSERT_EQ(type.bodies.size(), 2U);
  EXPECT_EQ(type.bodies[1].name, "b");
  EXPECT_EQ(type.bodies[1].mass, 0.5);
  EXPECT_EQ(type.bodies[1].inertia(1, 1), 2);
  EXPECT_EQ(type.bodies[1].shapes.at(0).size.x(), 0.1);
  EXPECT_EQ(type.hinges.at(0).axis, Vec3::UnitY());  // axes are normalised
  EXPECT_EQ(type.hinges.at(0).in_parent.p.x(), 0.05);
  EXPECT_EQ(type.hinges.at(0).hi, 1.5);
  EXPECT_EQ(type.faces.at(1).gender, Gender::passive);
  EXPECT_EQ(type.feet.at(0).body, 1U);
  EXPECT_EQ(type.all.at(0).radius, 0.1);
  EXPECT_EQ(type.root, 0U);
}

TEST_F(ModuleFileTest, ShippedTypesAreValid) {
  for (const auto& file :
       std::filesystem::directory_iterator(std::string(gaitlab::test::source_folder()) + "/scenarios/modules")) {
    if (file.path().extension() != ".yaml") continue;
    EXPECT_NO_THROW(read_module_file(file.path().string())) << file.path();
  }
}

TEST_F(ModuleFileTest, KeysAndVersion) {
  EXPECT_EQ(error("gaitlab_module: 1\n", ""), "DIR/m.yaml:1:1: error: missing key 'gaitlab_module'; write gaitlab_module: 1");
  EXPECT_EQ(error("gaitlab_module: 1", "gaitlab_module: 4"),
            "DIR/m.yaml:1:17: error: gaitlab_module is 4; expected 1, the only format version");
  EXPECT_EQ(error("name: duo", "name: my duo"),
            "DIR/m.yaml:2:7: error: name 'my duo' is not allowed; expected letters, digits, `_` and `-`");
  EXPECT_EQ(error("mass: 0.5", "mas: 0.5"), "DIR/m.yaml:6:5: error: unknown key 'mas'; did you mean 'mass'?");
  EXPECT_EQ(error("range: [-1.5, 1.5]", "range: [-1.5, .inf]"),
            "DIR/m.yaml:12:89: error: range[1] is .inf; expected a finite number in rad");
  EXPECT_EQ(error("mass: 1,", "mass: -1,"), "DIR/m.yaml:4:13: error: mass is -1 kg; expected at least 0 kg");
  EXPECT_EQ(error("name: h, ", ""), "DIR/m.yaml:12:5: error: missing key 'name'");
  EXPECT_EQ(error("gender: active", "gender: male"),
            "DIR/m.yaml:14:30: error: gender 'male' is unknown; known names: active, passive, none");
  EXPECT_EQ(error("faces:", "faces: 3\nfaces2:"),
            "DIR/m.yaml:13:8: error: faces is 3; expected a list of maps\n"
            "DIR/m.yaml:14:1: error: unknown key \'faces2\'; did you mean \'faces\'?");
}

TEST_F(ModuleFileTest, HingesFacesAndConnectors) {
  const auto read = [&](const std::string& from, const std::string& to) {
    std::string text = fakes::kDuo;
    text.replace(text.find("gaitlab_module: 1"), 17, "gaitlab_module: 1");
    text.replace(text.find(from), from.size(), to);
    return read_module_file(folder_.write("m.yaml", text)).type;
  };
  const auto wrong = [&](const std::string& from, const std::string& to) {
    return folder_.shown(test::message_of([&] { read(from, to); }));
  };
  const std::string range = "range: [-1.5, 1.5]";
  EXPECT_EQ(read(range, "range: free").hinges[0].hi, kNoStop);
  EXPECT_EQ(read(range, "range: free").hinges[0].lo, -kNoStop);
  EXPECT_FALSE(read(range, range).hinges[0].passive);
  const ModuleType sprung = read(range, range + ", drive: none, stiffness: 2, rest: 0.1, damping: 0.3, friction: 4");
  ASSERT_TRUE(sprung.hinges[0].passive);
  EXPECT_EQ(sprung.hinges[0].passive->stiffness, 2);
  EXPECT_EQ(sprung.hinges[0].passive->rest, 0.1);
  EXPECT_EQ(sprung.hinges[0].passive->damping, 0.3);
  EXPECT_EQ(sprung.hinges[0].passive->friction, 4);
  EXPECT_EQ(sprung.hinges[0].passive->friction_speed, 0.1);
  const ModuleType docks = read("gender: active", "gender: none, connector: hook, turns: [2, 0]");
  EXPECT_EQ(docks.faces[0].gender, Gender::none);
  EXPECT_EQ(docks.faces[0].connector, "hook");
  EXPECT_EQ(docks.faces[0].turns, (std::array{true, false, true, false}));
  EXPECT_EQ(docks.faces[1].turns, (std::array{true, true, true, true}));
  const ModuleType known = read("faces:", "connectors: {hook: {tension: 110, shear: 50, source: paper}, eye: {}}\nfaces:");
  EXPECT_EQ(known.connectors.at("hook").shear, 50);
  EXPECT_EQ(known.connectors.at("hook").bending, 0) << "not stated";
  EXPECT_EQ(known.connectors.at("hook").source, "paper");

  EXPECT_EQ(wrong(range, "range: loose"),
            "DIR/m.yaml:12:82: error: range is 'loose'; expected a list of 2 numbers in rad, or free");
  EXPECT_EQ(wrong(range, range + ", stiffness: 2"),
            "DIR/m.yaml:12:106: error: stiffness is only for a hinge without a motor, and this hinge has one; add drive: none, "
            "or remove stiffness");
  EXPECT_EQ(wrong(range, range + ", drive: none, damping: -1"),
            "DIR/m.yaml:12:117: error: damping is -1 N m s/rad; expected 0 to 1000000 N m s/rad");
  EXPECT_EQ(wrong(range, range + ", drive: none, actuator: {R: 1}"),
            "DIR/m.yaml:12:118: error: hinge 'h' has actuator and drive: none; expected one of them");
  EXPECT_EQ(wrong(range, range + ", drive: loose"),
            "DIR/m.yaml:12:102: error: drive 'loose' is unknown; known names: motor, none");
  EXPECT_EQ(wrong("gender: active", "gender: active, turns: [0, 1.5]"),
            "DIR/m.yaml:14:45: error: turns has 1.5; expected some of 0, 1, 2, 3 (times pi/2)");
  EXPECT_EQ(wrong("gender: active", "gender: active, turns: []"),
            "DIR/m.yaml:14:45: error: turns is empty; expected some of 0, 1, 2, 3 (times pi/2)");
  EXPECT_EQ(wrong("gender: active", "gender: active, turns: [4]"), "DIR/m.yaml:14:46: error: turns[0] is 4; expected 0 to 3");
  EXPECT_EQ(wrong("faces:", "connectors: {hook: {tension: 0}}\nfaces:"),
            "DIR/m.yaml:13:30: error: tension is 0 N; expected more than 0 N");
}

TEST_F(ModuleFileTest, BodiesByName) {
  EXPECT_EQ(error("parent: a, child: b", "parent: a, child: bb"), "DIR/m.yaml:12:33: error: no body 'bb'; did you mean 'b'?");
  EXPECT_EQ(error("body: b, point", "body: foot, point"), "DIR/m.yaml:17:17: error: no body 'foot'; known bodies: a, b");
  EXPECT_EQ(error("  b:\n    mass", "  a:\n    mass"),
            "DIR/m.yaml:5:3: error: duplicate key \'a\'\nDIR/m.yaml:4:3: note: it is given here first");
}

TEST_F(ModuleFileTest, OneTree) {
  EXPECT_EQ(error("child: b", "child: a"),
            "DIR/m.yaml:12:33: error: hinge 'h' joins body 'a' to itself\n"
            "DIR/m.yaml:5:3: error: body 'b' is not connected to 'a' by a hinge; expected one tree\n"
            "DIR/m.yaml:4:3: note: 'a' is the root: no hinge's child");
  const std::string hinge = "  - {name: g, parent: b, child: a, axis: [0, 1, 0], range: [-1, 1]}\nfaces:";
  EXPECT_EQ(
      error("faces:", hinge),
      "DIR/m.yaml:4:3: error: every body is the child of a hinge, so that the hinges form a loop; expected one root body");
  const std::string twice = "  - {name: h, parent: a, child: b, axis: [0, 0, 0], range: [1, -1]}\nfaces:";
  EXPECT_EQ(error("faces:", twice),
            "DIR/m.yaml:13:33: error: body 'b' is the child of two hinges, 'h' and 'h'; expected one tree\n"
            "DIR/m.yaml:12:33: note: the first is here\n"
            "DIR/m.yaml:13:12: error: duplicate hinge name 'h'\n"
            "DIR/m.yaml:12:12: note: it is given here first\n"
            "DIR/m.yaml:13:42: error: axis has length 0; expected a direction\n"
            "DIR/m.yaml:13:60: error: range is 1 to -1 rad; expected the smaller angle first");
  const std::string loop =
      "  c: {mass: 1, inertia: [1, 1, 1, 0, 0, 0]}\n  d: {mass: 1, inertia: [1, 1, 1, 0, 0, 0]}\nhinges:\n"
      "  - {name: x, parent: c, child: d, axis: [0, 1, 0], range: [-1, 1]}\n"
      "  - {name: y, parent: d, child: c, axis: [0, 1, 0], range: [-1, 1]}\n";
  EXPECT_EQ(error("hinges:\n", loop), "DIR/m.yaml:11:3: error: body 'c' is part of a loop of hinges; expected one tree");
}

TEST_F(ModuleFileTest, MassAndInertia) {
  EXPECT_EQ(error("mass: 0.5", "mass: 0"),
            "DIR/m.yaml:5:3: error: body 'b' has no mass; only a body between two hinges may have mass 0");
  EXPECT_EQ(error("[1, 2, 2, 0, 0, 0]", "[1, 2, 4, 0, 0, 0]"),
            "DIR/m.yaml:5:3: error: the inertia of body 'b' is not possible: its principal moments are 1, 2, 4 kg m^2, but the "
            "largest must not exceed the sum of the other two");
  EXPECT_EQ(error("[1, 2, 2, 0, 0, 0]", "[1, 2, 2, 2, 0, 0]"),
            "DIR/m.yaml:5:3: error: the inertia of body 'b' is not positive definite; its principal moments are -0.561553, 2, "
            "3.56155 kg m^2");
  EXPECT_EQ(
      error("[1, 2, 2, 0, 0, 0]", "[0, 0, 0, 0, 0, 0]"),
      "DIR/m.yaml:5:3: error: the inertia of body 'b' is not positive definite; its principal moments are 0, 0, 0 kg m^2");
}

/// A module whose bodies have only mass and shape.
class ShapeModuleTest : public ModuleFileTest {
 protected:
  static constexpr const char* kShaped =
      "gaitlab_module: 1\nname: shaped\nbodies:\n"
      "  block:\n    mass: 0.16\n    shape:\n      - {box: [0.0325, 0.065, 0.065], origin: [-0.01625, 0, 0]}\n"
      "      - {half_cylinder: [0.0325, 0.065]}\ncontacts: {all: shapes}\n";
  ModuleType read_shaped(const std::string& from, const std::string& to) {
    std::string text = kShaped;
    text.replace(text.find(from), from.size(), to);
    return read_module_file(folder_.write("m.yaml", text)).type;
  }
  std::string wrong(const std::string& from, const std::string& to) {
    return folder_.shown(test::message_of([&] { read_shaped(from, to); }));
  }
};

/// The numbers of the active block of scenarios/modules/mtran.yaml, 32.5 mm further along x.
TEST_F(ShapeModuleTest, InertiaAndCentreFollowFromShapes) {
  const BodyType block = read_shaped("shaped", "shaped").bodies[0];
  EXPECT_NEAR(block.com.x(), 0.0325 - 0.0355338704148542687, 1e-15);
  EXPECT_NEAR(block.inertia(0, 0), 0.00010647139641195444, 1e-17);
  EXPECT_NEAR(block.inertia(1, 1), 9.880342700618174e-05, 1e-17);
  const BodyType placed = read_shaped("mass: 0.16", "mass: 0.16\n    com: [0.01, 0, 0]").bodies[0];
  EXPECT_EQ(placed.com, Vec3(0.01, 0, 0));
  EXPECT_EQ(placed.inertia, block.inertia) << "about the centre of mass, wherever it is stated";
  const BodyType stated = read_shaped("mass: 0.16", "mass: 0.16\n    inertia: [1, 2, 2, 0, 0, 0]").bodies[0];
  EXPECT_EQ(stated.com, Vec3::Zero());
  EXPECT_EQ(stated.inertia(1, 1), 2);
}

TEST_F(ShapeModuleTest, ContactsFollowFromShapes) {
  const ModuleType type = read_shaped("shaped", "shaped");
  EXPECT_EQ(type.all.size(), 14U);
  EXPECT_EQ(type.feet.size(), 14U) << "the same as all";
  EXPECT_EQ(read_shaped("all: shapes", "all: [], feet: shapes").feet.size(), 14U);
  EXPECT_EQ(read_shaped("all: shapes", "all: shapes, feet: []").feet.size(), 0U);
  EXPECT_EQ(read_shaped("all: shapes", "all: [{body: block, point: [0, 0, 0]}]").feet.size(), 1U);
  EXPECT_EQ(read_shaped("{all: shapes}", "{}").feet.size(), 0U);
}

/// The module Y1 gets the inertias and contact points of the shipped file from its masses and shapes alone.
TEST_F(ShapeModuleTest, Y1HasItsNumbers) {
  const ModuleFile shipped = read_module_file(std::string(gaitlab::test::source_folder()) + "/scenarios/modules/y1.yaml");
  Node document = shipped.document;
  const auto drop = [](Node& map, const std::string& key) {
    for (std::size_t i = map.keys.size(); i-- > 0;) {
      if (map.keys[i].first != key) continue;
      map.keys.erase(map.keys.begin() + static_cast<std::ptrdiff_t>(i));
      map.items.erase(map.items.begin() + static_cast<std::ptrdiff_t>(i));
    }
  };
  drop(document, "contacts");
  for (std::size_t i = 0; i < document.keys.size(); ++i) {
    if (document.keys[i].first != "bodies") continue;
    for (Node& body : document.items[i].items) {
      drop(body, "inertia");
      drop(body, "com");
    }
  }
  const std::string text = print_yaml(document) + "contacts: {all: shapes}\n";
  const ModuleType type = read_module_file(folder_.write("y1.yaml", text)).type;
  for (std::size_t b = 0; b < 2; ++b) {
    const BodyType& stated = shipped.type.bodies[b];
    EXPECT_LT((type.bodies[b].inertia - stated.inertia).norm(), 1e-11 * stated.inertia.norm()) << "12 digits in the file";
    EXPECT_LT((type.bodies[b].com - stated.com).norm(), 1e-15);
  }
  ASSERT_EQ(type.all.size(), shipped.type.all.size());
  for (const ContactType& one : shipped.type.all) {
    EXPECT_TRUE(std::any_of(type.all.begin(), type.all.end(), [&](const ContactType& found) {
      return found.body == one.body && (found.centre - one.centre).norm() < 1e-15;
    })) << one.centre;
  }
}

TEST_F(ShapeModuleTest, Errors) {
  EXPECT_EQ(wrong("all: shapes", "all: boxes"), "DIR/m.yaml:9:17: error: all is 'boxes'; expected a list of maps, or shapes");
  const std::string shape = std::string(kShaped).substr(std::string(kShaped).find("    shape"), 116);
  EXPECT_EQ(wrong(shape, ""),
            "DIR/m.yaml:4:3: error: body 'block' has neither inertia nor shape; expected inertia, or shape, "
            "from which it follows");
  EXPECT_EQ(wrong("0.0325, 0.065]}\ncon", "1e200, 0.065]}\ncon"),
            "DIR/m.yaml:4:3: error: the shapes of body 'block' are too small or too large for an inertia; expected sizes in m");
  std::string many;
  for (int i = 0; i < 101; ++i) many += "      - {sphere: 1}\n";
  EXPECT_EQ(wrong("      - {half_cylinder: [0.0325, 0.065]}\n", many),
            "DIR/m.yaml:4:3: error: body 'block' has 102 shapes and no inertia; inertia follows from at most 100 shapes");
  EXPECT_TRUE(read_shaped("mass: 0.16", "mass: 0.16").bodies[0].inertia.allFinite());
}

TEST_F(ModuleFileTest, Faces) {
  EXPECT_EQ(error("id: 4", "id: 1"),
            "DIR/m.yaml:15:10: error: duplicate face id 1\nDIR/m.yaml:14:10: note: it is given here first");
  EXPECT_EQ(error("reference: [0, 1, 0]", "reference: [1, 1, 0]"),
            "DIR/m.yaml:14:88: error: reference is not at right angles to the normal of face 1");
  EXPECT_EQ(error("normal: [-1, 0, 0]", "normal: [0, 0, 0]"),
            "DIR/m.yaml:14:65: error: normal has length 0; expected a direction");
}

TEST_F(ModuleFileTest, ShapesAndContacts) {
  EXPECT_EQ(error("{box: [0.1, 0.1, 0.1]}", "{box: [0.1, 0.1, 0.1], sphere: 1}"),
            "DIR/m.yaml:10:9: error: the shape has 2 of box, cylinder, half_cylinder, sphere and hull; expected exactly one of "
            "them");
  const std::string expected = "; expected 4 to 64 points [x, y, z] that are not all in one plane";
  EXPECT_EQ(error("{box: [0.1, 0.1, 0.1]}", "{hull: [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]}"),
            "DIR/m.yaml:10:16: error: all points of the hull are in one plane" + expected);
  EXPECT_EQ(error("{box: [0.1, 0.1, 0.1]}", "{hull: [[0, 0], [1, 0], [0, 1], [1, 1]]}"),
            "DIR/m.yaml:10:16: error: a point of the hull has 2 numbers" + expected);
  std::string many;
  for (int k = 0; k < 65; ++k) many += (k > 0 ? ", " : "") + std::string("[0, 0, ") + std::to_string(k) + "]";
  EXPECT_EQ(error("{box: [0.1, 0.1, 0.1]}", "{hull: [" + many + "]}"),
            "DIR/m.yaml:10:16: error: the hull has 65 points" + expected);
  EXPECT_EQ(error("{box: [0.1, 0.1, 0.1]}", "{half_cylinder: [0.1, 0]}"),
            "DIR/m.yaml:10:31: error: half_cylinder[1] is 0 m; expected more than 0 m");
  EXPECT_EQ(error("sphere: [0, 0, 0], radius: 0.1", "sphere: [0, 0, 0]"), "DIR/m.yaml:18:9: error: missing key 'radius'");
  EXPECT_EQ(error("point: [0.1, 0, -0.1]", "pnt: [0.1, 0, -0.1]"),
            "DIR/m.yaml:17:10: error: expected {body, point: [x, y, z]} or {body, sphere: [x, y, z], radius: r}\n"
            "DIR/m.yaml:17:20: error: unknown key 'pnt'; known keys: source, body, point, sphere, radius");
}

}  // namespace
}  // namespace gaitlab
