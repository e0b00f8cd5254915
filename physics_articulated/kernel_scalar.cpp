#include "core/math/functions.h"
#include "physics_articulated/lane_kernel.h"

namespace gaitlab::articulated {

namespace {

class ScalarSolo final : public Solo {
 public:
  ScalarSolo(const KernelSettings& s, std::size_t lane)
      : tree_(s.rollouts[lane].tree),
        environment_(environment<double>({s.rollouts.subspan(lane, 1), s.actuator, s.method, s.query, nullptr, {}})),
        lanes_{lane, s.rollouts.size()},
        implicit_(tree_, environment_, s.actuator, lanes_) {
    if (s.method == StepMethod::adaptive) implicit_.allow(s.rollouts[lane].accuracy);
    torque = implicit_.done.torque;
    speed = implicit_.done.speed;
    angle = implicit_.done.angle;
    slope = implicit_.motors.slope;
  }

  void step(Out x, In command, double h, double end) override {
    implicit_.stops.holds.at(end);
    implicit_.switched = false;
    implicit_.step(x, command, h, true);
    contact = implicit_.done.contact;
    friction = implicit_.done.friction;
    stops = implicit_.done.stops;
    hinges = implicit_.done.hinges;
    solves = implicit_.solves;
    off = implicit_.off;
    unfinished = implicit_.unfinished;
    slides = implicit_.contacts.mostly_slide();
    switches = implicit_.switched;
  }

  void change(In hold, In since) override { implicit_.change(hold, since, lanes_); }

 private:
  Tree<double> tree_;
  Environment<double> environment_;
  LaneRange lanes_;
  Implicit<double> implicit_;
};

}  // namespace

std::vector<std::unique_ptr<Solo>> make_solos(const KernelSettings& s) {
  if (s.actuator != nullptr && s.actuator->dc_motors() == nullptr) return {};
  std::vector<std::unique_ptr<Solo>> solos;
  solos.reserve(s.rollouts.size());
  for (std::size_t l = 0; l < s.rollouts.size(); ++l) solos.push_back(std::make_unique<ScalarSolo>(s, l));
  return solos;
}

std::unique_ptr<Kernel> make_kernel_1(const KernelSettings& s) { return std::make_unique<LaneKernel<double>>(s); }

}  // namespace gaitlab::articulated
