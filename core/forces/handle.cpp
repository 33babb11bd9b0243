#include "core/forces/handle.h"

#include <algorithm>

namespace flexcast {
namespace {

// Times are sums of steps: the last bits of a start do not count.
bool has_begun(const Handle& handle, double time) {
  return time >= handle.start * (1.0 - 1e-12);
}

}  // namespace

Mat3 calc_rotation_matrix(const Vec3& rotation_vector) {
  const double angle = rotation_vector.stableNorm();
  if (angle == 0.0) return Mat3::Identity();
  return Eigen::AngleAxisd(angle, rotation_vector / angle).toRotationMatrix();
}

double calc_progress(const Handle& handle, double time) {
  if (!has_begun(handle, time)) return 0.0;
  return handle.duration > 0.0 ? std::clamp((time - handle.start) / handle.duration, 0.0, 1.0) : 1.0;
}

HandleMotion calc_handle_motion(const Handle& handle, double time, double jump_time) {
  const double progress = calc_progress(handle, handle.duration > 0.0 ? time : jump_time);
  HandleMotion motion;
  motion.R = calc_rotation_matrix(progress * handle.rotate);
  motion.about = handle.about;
  motion.translation = progress * handle.translate;
  const bool moving = handle.duration > 0.0 && has_begun(handle, time) && progress < 1.0 - 1e-12;
  if (moving) {
    motion.velocity = handle.translate / handle.duration;
    motion.angular_velocity = handle.rotate / handle.duration;
  }
  return motion;
}

}  // namespace flexcast
