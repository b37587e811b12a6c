#include "PorePressureEngine.hpp"
#include "Gravity.hpp"
#include "Prefetch.hpp"
#include <core/Scene.hpp>
#include <lib/high-precision/Constants.hpp>
#include <pkg/common/Sphere.hpp>

namespace yade {

YADE_PLUGIN((PorePressureEngine));

Real PorePressureEngine::heightAt(Real time) const
{
	if (times.size() != heights.size())
		throw std::invalid_argument(
		        "PorePressureEngine: times has " + std::to_string(times.size()) + " entries and heights " + std::to_string(heights.size())
		        + ": give as many of both");
	if (times.empty()) return 0;
	if (!std::is_sorted(times.begin(), times.end())) throw std::invalid_argument("PorePressureEngine: times must rise");
	if (time <= times.front()) return heights.front();
	if (time >= times.back()) return heights.back();
	const size_t k = std::upper_bound(times.begin(), times.end(), time) - times.begin();
	return heights[k - 1] + (heights[k] - heights[k - 1]) * (time - times[k - 1]) / (times[k] - times[k - 1]);
}

void PorePressureEngine::action()
{
	const Vector3r gravity  = nscd::gravityOf(*scene);
	const Vector3r normal   = planeNormal.normalized();
	const Real     cosDip   = gravity.norm() > 0 ? -gravity.normalized().dot(normal) : 1;
	const Vector3r down     = gravity - gravity.dot(normal) * normal;
	const Vector3r downhill = down.norm() > 1e-9 * gravity.norm() ? Vector3r(down.normalized()) : Vector3r(Vector3r::Zero());
	const Vector3r slope    = gradient != Vector3r::Zero() ? gradient : Vector3r(unitWeight * cosDip * normal);
	height                  = heightAt(scene->time);
	wetCount                = 0;
	releasedCount           = 0;
	totalForce              = Vector3r::Zero();

	const size_t size = scene->bodies->size();
	released.resize(size, 0);
	wet.assign(size, 0);
	for (size_t id = reference.size(); id < size; ++id) {
		const auto& body = (*scene->bodies)[id];
		reference.push_back(body ? body->state->pos : Vector3r(Vector3r::Zero()));
	}
	const auto& bodies = *scene->bodies;
	for (size_t id = 0; id < size; ++id) {
		if (id + nscd::later < size) nscd::fetch<sizeof(Body)>(bodies[id + nscd::later].get());
		if (id + nscd::soon < size && bodies[id + nscd::soon]) {
			nscd::fetch<64>(bodies[id + nscd::soon]->state.get());
			nscd::fetch<sizeof(Sphere)>(bodies[id + nscd::soon]->shape.get());
		}
		const auto& body = bodies[id];
		if (!body || !body->isDynamic() || (mask != 0 && !body->maskOk(mask))) continue;
		const Shape* shape = body->shape.get();
		if (!shape || (typeid(*shape) != typeid(Sphere) && !dynamic_cast<const Sphere*>(shape))) continue;
		const auto* sphere = static_cast<const Sphere*>(shape);
		const Vector3r& pos = body->state->pos;
		if (!released[id] && (pos - reference[id]).dot(downhill) > releaseDistance) released[id] = 1;
		releasedCount += released[id];
		if (released[id] || height <= 0 || (pos - planePoint).dot(normal) >= height) continue;
		const Vector3r force = slope * (volumeFactor * Mathr::PI * sphere->radius * sphere->radius * thickness);
		scene->forces.addForce(id, force);
		wet[id] = 1;
		++wetCount;
		totalForce += force;
	}
}

} // namespace yade
