#include "physics_articulated/tree.h"

namespace gaitlab::articulated {

Tree::Tree(const Robot& robot, Base base_kind, const std::vector<ContactElement>& contacts) : base(base_kind) {
  // Turns a link's frame so that its z is the joint axis; the base frame stays what the state describes.
  std::vector<Mat3> frames{Mat3::Identity()};
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    const Link& link = robot.links[i];
    TreeLink one;
    if (i > 0) {
      const Vec3 x = link.axis.unitOrthogonal();
      Mat3 frame;
      frame << x, link.axis.cross(x), link.axis;
      frames.push_back(frame);
      one.parent = static_cast<std::size_t>(link.parent);
      one.joint = static_cast<std::size_t>(link.joint);
      one.at_zero = mat(frames[one.parent].transpose() * link.in_parent.R * frame);
      one.origin = vec(frames[one.parent].transpose() * link.in_parent.p);
    }
    one.mass = link.mass;
    one.com = vec(frames[i].transpose() * link.com);
    one.inertia = sym(frames[i].transpose() * link.inertia * frames[i]);
    links.push_back(one);
  }
  for (const ContactElement& element : contacts) {
    points.push_back({element.link, vec(frames[element.link].transpose() * element.centre), element.radius});
  }
  for (const Joint& joint : robot.joints) {
    lo.push_back(joint.lo);
    hi.push_back(joint.hi);
  }
}

}  // namespace gaitlab::articulated
