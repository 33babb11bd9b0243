// Where a handle's particles are, how fast and how accelerated, at any time.
#pragma once

#include "core/forces/model.h"

namespace flexcast {

// The rigid motion at one moment: x = about + R (base - about) + translation.
struct HandleMotion {
  Mat3 R = Mat3::Identity();
  Vec3 about = Vec3::Zero();             // m, as given; it has moved by `translation`
  Vec3 translation = Vec3::Zero();       // m
  Vec3 velocity = Vec3::Zero();          // m/s, of `about`
  Vec3 angular_velocity = Vec3::Zero();  // rad/s

  Vec3 calc_position(const Vec3& base) const { return about + R * (base - about) + translation; }
  Vec3 calc_velocity(const Vec3& base) const { return velocity + angular_velocity.cross(R * (base - about)); }
  Vec3 calc_acceleration(const Vec3& base) const {  // m/s^2
    return angular_velocity.cross(angular_velocity.cross(R * (base - about)));
  }
};

// The turn by |r| rad about r; the identity, exactly, for r = 0.
Mat3 calc_rotation_matrix(const Vec3& rotation_vector);

// How far the motion has come: 0 before start, 1 after start + duration.
double calc_progress(const Handle& handle, double time);

// At `time`; a handle without duration is where it is at `jump_time`. Velocities are those that follow: a motion that
// begins now has its full speed.
HandleMotion calc_handle_motion(const Handle& handle, double time, double jump_time);

}  // namespace flexcast
