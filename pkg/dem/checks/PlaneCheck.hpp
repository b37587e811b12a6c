// What would lead out of the x-y plane and is left out of the contact problem: forces, torques and gravity along other
// directions, and engines that free bodies for them.
#pragma once

#include <core/Scene.hpp>

namespace yade::nscd {

/// Refuses gravity out of the plane, also that of a ramp's end. Throws std::runtime_error that names the integrator,
/// the value and what would do.
void checkGravity(const Scene& scene, const Vector3r& gravity, const Vector3r& final);

/// Whether a force [N] and a torque [N m] on a body that may move have parts out of the plane of more than rounding,
/// beside those in it and the weight.
bool leavesPlane(const Vector3r& force, const Vector3r& torque, Real mass, Real inertia, const Vector3r& gravity);

/// Refuses the force or the torque on such a body. Throws std::runtime_error that names the body, the value, where it
/// may come from and what would do.
[[noreturn]] void refuseForce(Scene& scene, Body::id_t id);

/// What else to say of a body that can leave the plane: the engine that overwrites its blockedDOFs; empty where there
/// is none.
string whoFrees(const Scene& scene, Body::id_t id);

} // namespace yade::nscd
