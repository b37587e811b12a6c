#include "ContactDynamicsEngine.hpp"
#include "BondEllipse.hpp"
#include "Gravity.hpp"
#include "NonsmoothTimeStepper.hpp"
#include "PlaneCheck.hpp"
#include "PythonBytes.hpp"
#include "Refusal.hpp"
#include "SceneCheck.hpp"
#include "Seldom.hpp"
#include "YadeFeatures.hpp"
#include <contact/mass_jumps.hpp>
#include <contact/problem_file.hpp>
#include <contact/residual.hpp>
#include <algorithm>
#include <optional>
#include <sstream>
#include <tuple>
#include <pkg/common/Sphere.hpp>
#include <pkg/dem/ScGeom.hpp>

namespace yade {

YADE_PLUGIN((ContactDynamicsEngine));
CREATE_LOGGER(ContactDynamicsEngine);

namespace contact = nonsmooth::contact;

void ContactDynamicsEngine::action()
{
	using nscd::Stage;
	nscd::StageTimer timer(&clock, Stage::Gather);
	const int        threads = nscd::threadsOf(*this);
	nscd::Turn       turn(*this, threads); // first: a refusal shows what the engines before have left in the arrays
	auto&            resident = turn.resident();
	validate();
	const auto gravity = nscd::gravityOf(*scene);
	nscd::checkGravity(*scene, gravity, gravityRamp > 0 ? finalGravity : Vector3r(Vector3r::Zero()));
	if (!resident.hasContacts()) resident.takeContacts(*scene);
	problemIsWhole = false;
	if (steps > 0 && !givenMotions.empty() && stepSolved == 0) seam.givenMotion.setNumbers(givenMotions); // loaded
	seam.gather(
	        *scene, resident, gravity, { scene->dt, relaxationRate, correctionSpeed, correctionSlack, openGap },
	        threads);
	stepSolved = scene->dt;
	reportChanges(resident);
	timer.next(Stage::Solve);
	impactsFollowed = seam.followImpacts(maxImpacts);
	auto statistics = contact::solve(seam.problem, settings(), &workspace);
	while (seam.recall() > 0) {
		const int before = statistics.iterations;
		statistics       = contact::solve(seam.problem, settings(), &workspace);
		statistics.iterations += before;
	}
	seam.answerGivenMotion();
	timer.next(Stage::Correct);
	seam.correct(settings(), workspace, correctionSweeps);
	seam.followWays(*scene);
	timer.next(Stage::Scatter);
	const bool adapts = std::any_of(scene->engines.begin(), scene->engines.end(), [](const auto& e) {
		return !e->dead && dynamic_cast<const NonsmoothTimeStepper*>(e.get());
	});
	const auto sums   = seam.scatter(*scene, gravity, threads, adapts);
	problemIsWhole    = true;
	account(sums, resident);
	reportRestitution(sums.mass * (scene->dt * scene->dt) * gravity.squaredNorm());
	report(statistics, sums.bodies > 0 ? sums.mass / sums.bodies * gravity.norm() : 0);
	turn.end();
}

void ContactDynamicsEngine::growGravity(NewtonIntegrator& newton, Real time)
{
	if (gravityRamp == 0) return;
	const auto refuse = [](const char* name, const string& value, const char* what) {
		nscd::fail(string(name) + " = " + value + ": it must be " + what);
	};
	using nscd::number;
	if (!(gravityRamp > 0) || !std::isfinite(gravityRamp))
		refuse("gravityRamp", number(gravityRamp), "0 or more, and finite [s]");
	if (!std::isfinite(gravityBegin)) refuse("gravityBegin", number(gravityBegin), "finite [s]");
	for (int i = 0; i < 3; ++i)
		if (!std::isfinite(finalGravity[i]))
			refuse("finalGravity",
			       number(finalGravity[0]) + ", " + number(finalGravity[1]) + ", "
			               + number(finalGravity[2]),
			       "finite [m/s²]");
	const Real share = std::max(Real(0), std::min(Real(1), (time - gravityBegin) / gravityRamp));
	newton.gravity   = share * finalGravity;
	if (share == 1) gravityRamp = 0;
}

void ContactDynamicsEngine::validate() const
{
	using nscd::fail, nscd::number;
	const auto refuse = [&](const char* name, Real value, const char* what) {
		fail(string(name) + " = " + number(value) + ": it must be " + what);
	};
	nscd::checkEngines(*scene, *this);
	// here and not where contacts are made: an exception in InteractionLoop's threads would end the program
	for (const auto& material : scene->materials)
		if (const auto* nscd = dynamic_cast<const NscdMat*>(material.get())) nscd->validate();
	if (scene->isPeriodic)
		fail("periodic scenes are not supported: set O.periodic = False and bound the scene by walls");
	if (!(scene->dt > 0) || !std::isfinite(scene->dt))
		fail("O.dt = " + number(scene->dt) + ": set a positive time step [s]");
	if (!(tolerance > 0 && nscd::isNumber(tolerance))) refuse("tolerance", tolerance, "positive and finite");
	if (maxIterations < 1) fail("maxIterations = " + std::to_string(maxIterations) + ": it must be at least 1");
	constexpr int most = 1000000; // of sweeps that are all made, whatever they leave
	if (correctionSweeps < 0 || correctionSweeps > most)
		fail("correctionSweeps = " + std::to_string(correctionSweeps) + ": it must be from 0 to "
		     + std::to_string(most));
	if (maxImpacts < 0) fail("maxImpacts = " + std::to_string(maxImpacts) + ": it must be 0 or more");
	if (checkEvery < 1) fail("checkEvery = " + std::to_string(checkEvery) + ": it must be at least 1");
	if (!(relaxationRate >= 0 && relaxationRate <= 1)) refuse("relaxationRate", relaxationRate, "from 0 to 1");
	if (!(correctionSpeed >= 0)) refuse("correctionSpeed", correctionSpeed, "0 or more [m/s]");
	if (!(correctionSlack >= 0 && correctionSlack < 1))
		refuse("correctionSlack", correctionSlack, "from 0 to less than 1 [ℓ]");
	if (!(openGap >= 0)) refuse("openGap", openGap, "0 or more [ℓ]");
	nscd::checkSureReach(*scene, openGap);
	const auto known = [&](const char* name, const auto& look) {
		try {
			look();
		} catch (const std::invalid_argument& error) {
			fail(string(name) + " = " + error.what());
		}
	};
	known("method", [&] { contact::methodOf(method.c_str()); });
	known("precision", [&] { contact::precisionOf(precision.c_str()); });
	known("stoppingTest", [&] { contact::stoppingTestOf(stoppingTest.c_str()); });
}

contact::SolverSettings ContactDynamicsEngine::settings() const
{
	contact::SolverSettings s;
	s.method        = contact::methodOf(method.c_str());
	s.precision     = contact::precisionOf(precision.c_str());
	s.tolerance     = tolerance;
	s.maxIterations = maxIterations;
	s.checkEvery    = checkEvery;
	s.threads       = nscd::threadsOf(*this);
	s.stopping      = contact::stoppingTestOf(stoppingTest.c_str());
	return s;
}

void ContactDynamicsEngine::account(const nscd::StepSums& s, const nscd::Resident& resident)
{
	kineticEnergy   = s.kinetic;
	potentialEnergy = s.potential;
	const Real now  = kineticEnergy + potentialEnergy;
	if (std::isnan(energyStart)) energyStart = now;
	else if (const Real brought = now - energyLeft; std::abs(brought) > 1e-12 * s.size) // more than rounding
		broughtEnergy += brought;
	energyLeft = s.kineticLeft + s.potentialLeft;
	// energies belong to the beginning of the step, the sums to the steps before it
	energyError = now - energyStart - broughtEnergy - externalWork - wallWork - correctionEnergy + slidingLoss
	        + rollingLoss + debondingLoss + impactLoss;
	externalWork += s.external;
	wallWork += s.wallWork;
	slidingLoss += s.sliding;
	for (const auto& [wall, energy] : s.slidingOnWalls) {
		if (size_t(wall) >= wallSlidingLoss.size()) wallSlidingLoss.resize(wall + 1, 0);
		wallSlidingLoss[wall] += energy;
	}
	rollingLoss += s.rolling;
	debondingLoss += s.debonding;
	impactLoss += s.impact;
	missedRestitution += s.missed;
	correctionEnergy += s.correction + s.heldWork;
	if (scene->trackEnergy) {
		const std::pair<const char*, Real> parts[] = { { "contactSliding", s.sliding },
			                                       { "contactRolling", s.rolling },
			                                       { "contactDebonding", s.debonding },
			                                       { "contactImpact", s.impact } };
		for (const auto& [name, part] : parts) {
			int place = -1; // looked up, since O.energy.clear() may have moved it
			scene->energy->add(part, name, place);
		}
	}
	candidates       = (int)seam.links.size();
	contacts         = s.touching;
	bonds            = s.bonds;
	overlapWorst     = s.worstOverlap;
	overlapMean      = s.touching > 0 ? s.overlap / s.touching : 0;
	overlapWorstEver = std::max(overlapWorstEver, overlapWorst);
	overlapWorstPair = Vector2i(s.worstIds[0], s.worstIds[1]);
	wayWorst         = seam.longest.radii;
	wayWorstEver     = std::max(wayWorstEver, wayWorst);
	reportOverlap();
	reportWay();
	reportDriven();
	brokenTension += s.broken[NscdPhys::Tension];
	brokenShear += s.broken[NscdPhys::Shear];
	brokenTorque += s.broken[NscdPhys::Torque];
	brokenMixed += s.broken[NscdPhys::Mixed];
	recordBreaks(resident);
	contactRate = s.contactRate;
	bondRate    = s.bondRate;
	meanSpeed   = s.bodies > 0 ? s.speed / s.bodies : 0;
	maxSpeed    = s.largestSpeed;
	centroid    = s.mass > 0 ? Vector3r(s.centre / s.mass) : Vector3r(Vector3r::Zero());
	momentum    = s.momentum;
}

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

void ContactDynamicsEngine::recordBreaks(const nscd::Resident& resident)
{
	for (const size_t k : seam.broken) {
		const nscd::Reading& r  = seam.readingOf(seam.links[k]);
		const Vector3r       at = resident.contactPoint(r);
		breakLog.insert(
		        breakLog.end(),
		        { Real(scene->iter), scene->time, Real(std::min(r.first, r.second)),
		          Real(std::max(r.first, r.second)), Real(r.broken), at[0], at[1] });
	}
}

void ContactDynamicsEngine::view() const { nscd::Resident::of(*Omega::instance().getScene())->showBetweenTurns(); }

void ContactDynamicsEngine::preSave(ContactDynamicsEngine&)
{
	const auto resident = nscd::Resident::of(*Omega::instance().getScene());
	const auto guard    = resident->betweenTurns();
	if (stepSolved != 0) givenMotions = seam.givenMotion.numbers();
	resident->showForSaving();
	for (const auto& i : *Omega::instance().getScene()->interactions)
		if (auto* phys = i->isReal() ? dynamic_cast<NscdPhys*>(i->phys.get()) : nullptr)
			phys->savedGap = phys->gapOf(static_cast<const ScGeom&>(*i->geom));
}

void ContactDynamicsEngine::dump(const std::string& path) const
{
	if (stepSolved == 0)
		throw std::runtime_error("ContactDynamicsEngine.dump: no step was made yet: call O.step() first");
	const auto guard = nscd::Resident::of(*Omega::instance().getScene())->betweenTurns();
	if (!problemIsWhole)
		throw std::runtime_error(
		        "ContactDynamicsEngine.dump: the last step was refused, and the problem of the one before is gone: mend what was refused, and call O.step() first");
	contact::write(path, { seam.problem, seam.warmStart, stepSolved });
}

namespace {
	string pairsOf(int count)
	{
		return std::to_string(count) + (count == 1 ? " pair of bodies" : " pairs of bodies");
	}
}

void ContactDynamicsEngine::reportOverlap()
{
	constexpr Real deep = 0.05; // ℓ; what a step of an ordinary run begins with is a hundredth of that
	if (overlapWorst < deep || !nscd::seldom(++overlappedSteps)) return;
	LOG_WARN(
	        "step "
	        << scene->iter << " began with " << pairsOf(seam.overlapsOf(deep))
	        << " deep in each other, the worst bodies #" << overlapWorstPair[0] << " and #" << overlapWorstPair[1]
	        << ", by " << 100 * overlapWorst << " % of their mean diameter (" << overlappedSteps
	        << " such steps so far). They were placed so, pressed by a wall that moves regardless of"
	           " what it meets, or met faster than the collider knew of: look at how they were placed, lower O.dt or the wall's speed, or raise Law2's reach and the functors' factors."
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
	        << " steps so far with a disk that moves by more than its radius). Such a disk may pass a thin wall or another disk between two steps, and what it meets is known"
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

/// `settling`: twice what gravity gives bodies at rest in a step [J]; those that are placed a little above their places lose as much.
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
	const string worstPair      = statistics.converged ? "" : tellWorstPair();
	++steps;
	totalIterations += iterations;
	if (!statistics.converged) ++unconverged;
	const auto test   = contact::stoppingTestOf(stoppingTest.c_str());
	const bool ours   = test == contact::StoppingTest::NaturalMap;
	const Real figure = ours ? residual : statistics.changes.figure(test);
	// A step in which bodies meet hard may miss the tolerance, and so do forces that are next to nothing: that is counted. What lasts, or outweighs a body, matters,
	// and so does a body that keeps falling, however light.
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
	const auto& r     = seam.readingOf(seam.links[worst]);
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
		     << " times the mass of another, which asks for more sweeps (a larger maxIterations lets it solve larger patches of contacts, too) or for masses nearer to each other";
	return text.str();
}

namespace {
	/// Whether an interaction's bodies are still there, with their shapes: YADE's loop takes it out in the next step where they are not.
	bool hasBodies(const Interaction& i, const Scene& scene)
	{
		const auto& bodies  = *scene.bodies;
		const auto  isThere = [&](Body::id_t id) { return bodies.exists(id) && bodies[id]->shape; };
		return isThere(i.getId1()) && isThere(i.getId2());
	}
}

int ContactDynamicsEngine::bond()
{
	scene             = Omega::instance().getScene().get();
	const auto guard  = nscd::Resident::of(*scene)->betweenTurns();
	auto [count, all] = nscd::Resident::of(*scene)->bondBare();
	for (const auto& i : *scene->interactions) {
		if (!i->isReal() || !hasBodies(*i, *scene)) continue;
		auto*       phys = dynamic_cast<NscdPhys*>(i->phys.get());
		const auto& geom = static_cast<const ScGeom&>(*i->geom);
		all += phys && phys->bonded;
		if (!phys || !phys->bondable || phys->bonded) continue;
		const Real gap = phys->gapOf(geom);
		if (!(gap <= phys->creationDistance)) continue;
		const auto pair = nscd::bondPair(*Body::byId(i->getId1(), scene), *Body::byId(i->getId2(), scene));
		nscd::markBond(*phys, pair, pair.swapped ? Vector3r(-geom.normal) : geom.normal, gap);
		phys->touched = true;
		++count;
		++all;
	}
	bonds = all;
	return count;
}

int ContactDynamicsEngine::unbond()
{
	scene            = Omega::instance().getScene().get();
	const auto guard = nscd::Resident::of(*scene)->betweenTurns();
	view();
	int count = 0;
	for (const auto& i : *scene->interactions) {
		auto* phys = i->isReal() ? dynamic_cast<NscdPhys*>(i->phys.get()) : nullptr;
		if (!phys || !phys->bonded) continue;
		phys->bonded = false;
		phys->axis   = Vector3r::Zero();
		++count;
	}
	bonds = 0;
	return count;
}

void ContactDynamicsEngine::updateStrengths()
{
	scene            = Omega::instance().getScene().get();
	const auto guard = nscd::Resident::of(*scene)->betweenTurns();
	view();
	const auto eachContact = [this](auto take) {
		for (const auto& i : *scene->interactions)
			if (i->isReal() && hasBodies(*i, *scene) && dynamic_cast<NscdPhys*>(i->phys.get()))
				take(*i, *Body::byId(i->getId1(), scene), *Body::byId(i->getId2(), scene));
	};
	// before anything is changed
	for (const auto& b : *scene->bodies)
		if (const auto* material = b ? dynamic_cast<const NscdMat*>(b->material.get()) : nullptr)
			material->validate();
	eachContact([](Interaction&, const Body& b1, const Body& b2) {
		Ip2_NscdMat_NscdMat_NscdPhys::checkMaterials(b1, b2);
	});
	eachContact(&Ip2_NscdMat_NscdMat_NscdPhys::renew);
}

void ContactDynamicsEngine::forgetBreaks()
{
	const auto guard = nscd::Resident::of(*Omega::instance().getScene())->betweenTurns();
	breakLog.clear();
}

void ContactDynamicsEngine::forgetEnergies()
{
	const auto guard = nscd::Resident::of(*Omega::instance().getScene())->betweenTurns();
	energyStart      = NaN;
	for (Real* value : { &externalWork, &wallWork, &slidingLoss, &rollingLoss, &debondingLoss, &impactLoss,
	                     &correctionEnergy, &broughtEnergy, &missedRestitution, &missedTold, &kineticMost })
		*value = 0;
	wallSlidingLoss.clear();
}

boost::python::dict ContactDynamicsEngine::energies() const
{
	const auto          guard = nscd::Resident::of(*Omega::instance().getScene())->betweenTurns();
	boost::python::dict d;
	d["kinetic"]    = kineticEnergy;
	d["potential"]  = potentialEnergy;
	d["external"]   = externalWork;
	d["wall"]       = wallWork;
	d["sliding"]    = slidingLoss;
	d["rolling"]    = rollingLoss;
	d["debonding"]  = debondingLoss;
	d["impact"]     = impactLoss;
	d["correction"] = correctionEnergy;
	d["brought"]    = broughtEnergy;
	d["error"]      = energyError;
	return d;
}

boost::python::dict ContactDynamicsEngine::stageSeconds() const
{
	boost::python::dict d;
	for (size_t k = 0; k < clock.seconds.size(); ++k)
		d[clock.names[k]] = clock.seconds[k];
	return d;
}

nscd::StageClock* nscd::StageClock::of(const Scene& scene)
{
	for (const auto& engine : scene.engines)
		if (auto* solver = engine->dead ? nullptr : dynamic_cast<ContactDynamicsEngine*>(engine.get()))
			return &solver->clock;
	return nullptr;
}

boost::python::object ContactDynamicsEngine::bodyTable() const
{
	std::optional<nscd::Bytes<double>> table;
	nscd::Resident::of(*Omega::instance().getScene())->disks([&](size_t count) {
		return table.emplace(count).data();
	});
	return table->object;
}

boost::python::object ContactDynamicsEngine::breakTable() const
{
	const auto guard = nscd::Resident::of(*Omega::instance().getScene())->betweenTurns();
	return nscd::asBytes<double>({ breakLog.begin(), breakLog.end() });
}

boost::python::object ContactDynamicsEngine::contactTable() const
{
	using Row                = std::array<double, 12>;
	Scene&              here = *Omega::instance().getScene();
	std::vector<double> rows;
	const auto          add   = [&](const Row& row) { rows.insert(rows.end(), row.begin(), row.end()); };
	const auto          guard = nscd::Resident::of(here)->betweenTurns();
	nscd::Resident::of(here)->showBare([&](const nscd::Reading& r, const Vector3r& at) {
		add({ double(r.first), double(r.second), r.normal, r.tangential, r.torque, r.nx, r.ny, r.gap,
		      double(r.bonded), double(NscdPhys::None), at[0], at[1] });
	});
	for (const auto& i : *here.interactions) {
		const auto* phys = i->isReal() ? dynamic_cast<const NscdPhys*>(i->phys.get()) : nullptr;
		if (!phys) continue;
		const auto& g = static_cast<const ScGeom&>(*i->geom);
		add({ double(i->getId1()), double(i->getId2()), double(phys->normal), double(phys->tangential),
		      double(phys->torque), double(g.normal[0]), double(g.normal[1]), double(phys->gapOf(g)),
		      double(phys->bonded), double(phys->brokenMode), double(g.contactPoint[0]),
		      double(g.contactPoint[1]) });
	}
	return nscd::asBytes(rows);
}

} // namespace yade
