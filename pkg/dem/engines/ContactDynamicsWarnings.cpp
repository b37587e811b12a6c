// What the engine warns of: changes that scripts make, overlaps, long ways, driven bodies, lost restitution, steps that
// were not solved.
#include "ContactDynamicsEngine.hpp"
#include "../checks/Refusal.hpp"
#include "../checks/Seldom.hpp"
#include <contact/plane/mass_jumps.hpp>
#include <contact/plane/residual.hpp>
#include <algorithm>
#include <sstream>
#include <tuple>

namespace yade {

namespace contact = nonsmooth::contact;

void ContactDynamicsEngine::reportChanges(nscd::Resident& resident)
{
	for (const string& what : std::exchange(resident.sizesTold, {}))
		if (nscd::seldom(++sizesChanged))
			LOG_WARN(
			        "step " << scene->iter << ": " << what << " (" << sizesChanged
			                << " such bodies so far).");
	if (const string& what = seam.givenMotion.told; !what.empty() && nscd::seldom(++placedAgain))
		LOG_WARN("step " << scene->iter << ": " << what << " (" << placedAgain << " such moves so far).");
	if (seam.turningOut >= 0 && nscd::seldom(++turnedOut)) {
		const Vector3r& turn = Body::byId(seam.turningOut, scene)->state->angVel;
		LOG_WARN(
		        "step "
		        << scene->iter << ": body #" << seam.turningOut << " has state.angVel = (" << turn[0] << ", "
		        << turn[1] << ", " << turn[2]
		        << "), and rotation about x or y drags nothing, since contacts lie in the x-y plane ("
		        << turnedOut
		        << " such steps so far): set its first two numbers to 0, and the third one where the body is to turn in the plane.");
	}
	for (const auto& material : scene->materials) {
		auto* nscd = dynamic_cast<NscdMat*>(material.get());
		if (nscd && nscd->changesPeakAlone())
			LOG_WARN(
			        "step "
			        << scene->iter << ": the frictionAngle of " << nscd->getClassName() << " '"
			        << nscd->label << "' was changed to " << nscd->frictionAngle
			        << ", and its residualFrictionAngle = " << nscd->residualFrictionAngle
			        << " stays that of contacts to come that are not bonded: set it too, or to -1 to follow frictionAngle.");
	}
}

namespace {
	string pairsOf(int count)
	{
		return std::to_string(count) + (count == 1 ? " pair of bodies" : " pairs of bodies");
	}
}

void ContactDynamicsEngine::reportOverlap(const std::function<int(Real)>& pairsDeeperThan)
{
	if (overlapWorst < deepOverlap || !nscd::seldom(++overlappedSteps)) return;
	LOG_WARN(
	        "step "
	        << scene->iter << " began with " << pairsOf(pairsDeeperThan(deepOverlap))
	        << " deep in each other, the worst bodies #" << overlapWorstPair[0] << " and #" << overlapWorstPair[1]
	        << ", by " << 100 * overlapWorst << " % of their mean diameter (" << overlappedSteps
	        << " such steps so far). They were placed so, pressed by a wall that moves regardless of"
	           " what it meets, or met faster than the collider knew of: look at how they were placed, lower O.dt or "
	           "the wall's speed, or raise Law2's reach and the functors' factors."
	           " Where none of that is so, the solve leaves overlaps: lower tolerance (it is "
	        << tolerance << "), or raise maxIterations where steps end above it (" << unconverged << " so far).");
}

void ContactDynamicsEngine::reportWay()
{
	const auto& far = seam.longest;
	if (far.body < 0 || !nscd::seldom(++farSteps)) return;
	LOG_WARN(
	        "step "
	        << scene->iter << ": body #" << far.body << ", a disk of radius " << far.radius << " m, moves at "
	        << far.speed << " m/s, which is " << far.radii << " of its radii in a step of O.dt = " << scene->dt
	        << " s (" << farSteps
	        << " steps so far with a disk that moves by more than its radius). Such a disk may pass a thin wall or "
	           "another disk between two steps, and what it meets is known"
	           " too late. Set O.dt = "
	        << nscd::about(nscd::enoughStep(scene->dt, far.radii))
	        << " s or less, with which it moves by half its radius, unless nothing is in its way.");
}

void ContactDynamicsEngine::reportDriven()
{
	if (!(seam.drivenTogether > 0) || !nscd::seldom(++drivenSteps)) return;
	LOG_WARN(
	        "step "
	        << scene->iter << ": " << pairsOf(seam.drivenPairs)
	        << " with blocked DOFs are driven into each other, the fastest bodies #" << seam.drivenIds[0]
	        << " and #" << seam.drivenIds[1] << ", by " << seam.drivenTogether << " m/s (" << drivenSteps
	        << " such steps so far). No finite force answers that between rigid bodies, and their contact bears none. Free one of them"
	           " along the normal (state.blockedDOFs) and press it by O.forces.setPermF.");
}

/// `settling`: twice what gravity gives bodies at rest in a step [J]; those that are placed a little above their places
/// lose as much.
void ContactDynamicsEngine::reportRestitution(Real settling)
{
	if (seam.overrun() > 0 && nscd::seldom(++overrunSteps))
		LOG_WARN(
		        "step " << scene->iter << ": " << seam.overrun()
		                << " bodies had more than maxImpacts = " << maxImpacts << " impacts (" << overrunSteps
		                << " such steps so far); what came after was solved at once, and a part of it lost its"
		                   " restitution. Lower O.dt, give them more room, or raise maxImpacts.");
	constexpr Real matters = 0.01, again = 10;
	kineticMost = std::max(kineticMost, kineticEnergy);
	if (missedRestitution <= std::max({ matters * kineticMost, again * missedTold, again * settling })) return;
	missedTold = missedRestitution;
	LOG_WARN(
	        "step " << scene->iter << ": contacts with restitution that closed as others pushed have lost "
	                << missedRestitution
	                << " J so far that restitution would have given back; the largest kinetic energy was "
	                << kineticMost << " J. Lower O.dt, or accept it knowingly.");
}

namespace {
	string missedBy(Real value, Real bound)
	{
		std::ostringstream text;
		text << " " << value << ", wanted at most " << bound;
		return text.str();
	}
}

void ContactDynamicsEngine::report(const contact::SolverStatistics& statistics, Real meanWeight)
{
	iterations = lastIterations = statistics.iterations;
	lastUnsolved                = !statistics.converged;
	residual                    = statistics.residual.relative();
	residualForce               = statistics.residual.rms / scene->dt;
	residualSpeed               = statistics.residual.speed;
	residualSpeedWorst          = statistics.residual.largestSpeed;
	patches                     = statistics.patches;
	residualSpeedPair           = Vector2i(-1, -1);
	const string worstPair      = statistics.converged ? "" : wasInSpace ? tellWorstPairInSpace() : tellWorstPair();
	++steps;
	totalIterations += iterations;
	if (!statistics.converged) ++unconverged;
	const auto test   = contact::stoppingTestOf(stoppingTest.c_str());
	const bool ours   = test == contact::StoppingTest::NaturalMap;
	const Real figure = ours ? residual : statistics.changes.figure(test);
	// A step in which bodies meet hard may miss the tolerance, and so do forces that are next to nothing: that is
	// counted. What lasts, or outweighs a body, matters, and so does a body that keeps falling, however light.
	constexpr Real missed  = 10; // tolerances
	constexpr int  lasts   = 10; // steps
	constexpr Real falling = 0.3; // share of a contact's speed
	const bool     matters = !statistics.converged
	        && ((!(figure <= missed * tolerance) && !(residualForce <= missed * tolerance * meanWeight))
	            || (ours && residualSpeedWorst > falling));
	unsolvedOnEnd        = matters ? unsolvedOnEnd + 1 : 0;
	const bool outweighs = matters && meanWeight > 0 && residualForce > meanWeight;
	if ((unsolvedOnEnd != lasts && !outweighs) || !nscd::seldom(++unsolved)) return;
	LOG_WARN(
	        "step "
	        << scene->iter << " was not solved" << (unsolvedOnEnd >= lasts ? ", like those before it" : "") << ": "
	        << (ours ? tellMissed(statistics) : stoppingTest + missedBy(figure, tolerance)) << ", after "
	        << iterations << " sweeps; reactions miss the law by " << residualForce << " N (rms), a body weighs "
	        << meanWeight << " N (mean); " << worstPair << "; " << unconverged
	        << " steps so far ended above the tolerance. Raise maxIterations, lower O.dt, or accept it knowingly with a larger tolerance.");
}

/// The figures of a step that are above their bounds, with both.
string ContactDynamicsEngine::tellMissed(const contact::SolverStatistics& s) const
{
	const Real mean = contact::Residual::meanSpeed(tolerance, s.uneven);
	string     text;
	for (const auto& [name, value, bound] : { std::tuple("residual", s.residual.relative(), tolerance),
	                                          std::tuple("residualSpeed", s.residual.speed, mean),
	                                          std::tuple(
	                                                  "residualSpeedWorst", s.residual.largestSpeed,
	                                                  contact::Residual::mostSpeed(tolerance, s.uneven)),
	                                          std::tuple(
	                                                  "residualSpeed of a patch around a heavy body", s.patchSpeed,
	                                                  contact::Residual::meanSpeed(tolerance, true)) })
		if (!(value <= bound)) text += (text.empty() ? "" : ", and ") + (name + missedBy(value, bound));
	return text;
}

/// Finds the contact of the last solve that leaves most of its speed open, and says what helps it.
string ContactDynamicsEngine::tellWorstPair()
{
	const auto shares = contact::speedShares(seam.problem);
	if (shares.empty()) return "there are no contacts";
	const size_t worst = std::max_element(
	                             shares.begin(), shares.end(),
	                             [](const auto& a, const auto& b) { return a.point < b.point; })
	        - shares.begin();
	const auto& r     = seam.stateOf(seam.links[worst]);
	const auto& here  = seam.problem.contacts[worst];
	residualSpeedPair = Vector2i(std::min(r.first, r.second), std::max(r.first, r.second));
	std::ostringstream text;
	text << "worst are bodies #" << residualSpeedPair[0] << " and #" << residualSpeedPair[1] << ", which leave "
	     << 100 * std::sqrt(shares[worst].point) << " % of their speed open";
	Real lightest = 0, heaviest = 0; // inverse masses of the pair and of what it touches
	for (const auto& c : seam.problem.contacts) {
		if (c.i != here.i && c.j != here.j && c.i != here.j && c.j != here.i) continue;
		for (const int b : { c.i, c.j })
			if (const Real inverse = seam.problem.inverseMass[b].x + seam.problem.inverseMass[b].y;
			    inverse > 0) {
				lightest = std::max(lightest, inverse);
				heaviest = heaviest > 0 ? std::min(heaviest, inverse) : inverse;
			}
	}
	if (heaviest > 0 && lightest > contact::massJump * heaviest)
		text << "; among them and what they touch one body has " << lightest / heaviest
		     << " times the mass of another, which asks for more sweeps (a larger maxIterations lets it solve larger "
		        "patches of contacts, too) or for masses nearer to each other";
	return text.str();
}

} // namespace yade
