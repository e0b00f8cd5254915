#include "physics_articulated/tree.h"

#include "core/model/robot.h"
#include "physics_articulated/eigen.h"

namespace gaitlab::articulated {

Tree<double> tree(const Robot& robot, Base base, const std::vector<ContactElement>& contacts) {
  Tree<double> all;
  all.base = base;
  // Each link frame is turned so that z is the joint axis. The base frame is unchanged, because the state describes it.
  std::vector<Mat3> frames{Mat3::Identity()};
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    const Link& link = robot.links[i];
    TreeLink<double> one;
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
    all.links.push_back(one);
  }
  for (std::size_t i = all.links.size(); i-- > 1;) {
    TreeLink<double>& parent = all.links[all.links[i].parent];
    all.links[i].last_child = parent.leaf;
    parent.leaf = false;
  }
  for (const ContactElement& element : contacts) {
    all.points.push_back(
        {element.link, vec(frames[element.link].transpose() * element.centre), element.radius, element.friction});
  }
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const Joint& joint = robot.joints[j];
    all.lo.push_back(joint.lo);
    all.hi.push_back(joint.hi);
    if (joint.play.any()) all.plays.push_back({j, law(joint.play)});
    if (joint.driven()) continue;
    all.passive.push_back(j);
    all.hinges.push_back(law(*joint.passive));
  }
  return all;
}

}  // namespace gaitlab::articulated
