#include <algorithm>
#include <contact/plane/law.hpp>
#include <contact/plane/patch_solver.hpp>

namespace nonsmooth::contact {

PatchSolver::PatchSolver(Sweeper<Plane, double>& sweeper_)
        : sweeper(sweeper_)
        , patches(massPatches(sweeper_.problem))
{
	if (!any()) return;
	const ContactBlocks& laidOut = sweeper.laidOut;
	laneOf.resize(sweeper.problem.contactCount());
	placeIn.resize(sweeper.problem.bodyCount());
	for (std::size_t l = 0; l < laidOut.contactOf.size(); ++l)
		if (laidOut.contactOf[l] != ContactBlocks::none)
			laneOf[laidOut.contactOf[l]] = static_cast<std::int32_t>(l);
	for (std::size_t k = 0; k < laidOut.others.size(); ++k)
		laneOf[laidOut.others[k]] = ~static_cast<std::int32_t>(k);
}

void PatchSolver::readContact(std::int32_t index, PatchProblem& to) const
{
	const Problem&         problem = sweeper.problem;
	Contact                c       = problem.contacts[index];
	const RelativeVelocity u       = relativeVelocity(c, problem.freeVelocity[c.i], problem.freeVelocity[c.j]);
	if (!(inverseDelassus(c, problem.inverseMass[c.i], problem.inverseMass[c.j]).n > 0)) return;
	addBias(c, u);
	const auto place = [&](std::int32_t b) {
		return problem.inverseMass[b].isFixed() ? static_cast<std::int32_t>(to.masses.size()) : placeIn[b];
	};
	c.i = place(c.i);
	c.j = place(c.j);
	to.contacts.push_back(c);
	const std::int32_t lane = laneOf[index];
	if (lane < 0) to.impulses.push_back(sweeper.rows[~lane].p);
	else {
		const Block<double>& block = sweeper.own.blocks[lane / lanes];
		const std::size_t    l     = lane % lanes;
		to.impulses.push_back({ block.n.v[l], block.t.v[l], block.r.v[l] });
	}
}

PatchProblem PatchSolver::read(const MassPatch& patch) const
{
	PatchProblem result;
	result.hubs  = patch.hubs;
	result.width = patch.width;
	for (std::size_t k = 0; k < patch.bodies.size(); ++k) {
		const std::int32_t b = patch.bodies[k];
		placeIn[b]           = static_cast<std::int32_t>(k);
		result.masses.push_back(sweeper.problem.inverseMass[b]);
		result.changes.push_back(sweeper.twistAt(sweeper.laidOut.placeOf[b]));
	}
	for (const std::int32_t c : patch.contacts)
		readContact(c, result);
	return result;
}

void PatchSolver::write(const MassPatch& patch, const PatchProblem& solved)
{
	std::size_t at = 0;
	for (const std::int32_t index : patch.contacts) {
		const Contact& c = sweeper.problem.contacts[index];
		if (!(inverseDelassus(c, sweeper.problem.inverseMass[c.i], sweeper.problem.inverseMass[c.j]).n > 0))
			continue;
		const Impulse&     p    = solved.impulses[at++];
		const std::int32_t lane = laneOf[index];
		if (lane < 0) {
			sweeper.rows[~lane].p = sweeper.rows[~lane].before = p;
			continue;
		}
		Block<double>&    block = sweeper.own.blocks[lane / lanes];
		const std::size_t l     = lane % lanes;
		block.n.v[l] = block.beforeN.v[l] = p.n;
		block.t.v[l] = block.beforeT.v[l] = p.t;
		block.r.v[l] = block.beforeR.v[l] = p.r;
	}
	for (std::size_t k = 0; k < patch.bodies.size(); ++k) {
		auto&        motion = sweeper.bodies[sweeper.laidOut.placeOf[patch.bodies[k]]].v;
		const Twist& v      = solved.changes[k];
		motion[0]           = v.x;
		motion[1]           = v.y;
		motion[2]           = v.w;
	}
}

bool PatchSolver::settle(double tolerance, double most)
{
	// a chain of some ten contacts adds up what each of them misses
	constexpr double asked = 0.1, reached = 0.01; // of the tolerance
	bool             changed = false;
	worst                    = 0;
	for (const MassPatch& patch : patches) {
		PatchProblem at   = read(patch);
		double       left = residualOf(at, sweeper.scale).speed;
		if (left > asked * tolerance && patch.work() <= most
		    && solvePatch(at, reached * tolerance, sweeper.scale)) {
			write(patch, at);
			left    = residualOf(at, sweeper.scale).speed;
			changed = true;
			++count;
		}
		worst = std::max(worst, left);
	}
	return changed;
}

} // namespace nonsmooth::contact
