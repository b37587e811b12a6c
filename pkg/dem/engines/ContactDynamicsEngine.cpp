#include "ContactDynamicsEngine.hpp"
#include "../seam/EngineRoles.hpp"
#include "../seam/Recall.hpp"
#include "Gravity.hpp"
#include "NonsmoothTimeStepper.hpp"
#include "../checks/PlaneCheck.hpp"
#include "../checks/Refusal.hpp"
#include "../checks/SceneCheck.hpp"
#include "../checks/YadeFeatures.hpp"
#include <contact/plane/problem_file.hpp>
#include <contact/space/problem_file.hpp>
#include <algorithm>
#include <pkg/dem/ScGeom.hpp>

namespace yade {

YADE_PLUGIN((ContactDynamicsEngine));
CREATE_LOGGER(ContactDynamicsEngine);
[[maybe_unused]] static const bool contactDynamicsEngineRole = nscd::giveRole(
        typeid(ContactDynamicsEngine), nscd::EngineRole::TakesTurns);

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
	if (nscd::isInSpace(*scene, resident)) {
		nscd::Resident::Look look { "the step in space" };
		look.inSpace = false; // contacts are taken from where they are
		resident.show(look);
		stepInSpace(resident, timer, gravity, threads);
		turn.end();
		return;
	}
	wasInSpace = false;
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
	impactsFollowed       = seam.followImpacts(maxImpacts);
	const auto statistics = nscd::solveWithRecalls(seam, [&] {
		return contact::solve(seam.problem, settings(), &workspace);
	});
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
	candidates        = (int)seam.links.size();
	wayWorst          = seam.longest.radii;
	account(sums);
	reportOverlap([this](Real depth) { return seam.overlapsOf(depth); });
	reportWay();
	reportDriven();
	recordBreaks(resident);
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

void ContactDynamicsEngine::account(const nscd::StepSums& s)
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
	contacts         = s.touching;
	bonds            = s.bonds;
	overlapWorst     = s.worstOverlap;
	overlapMean      = s.touching > 0 ? s.overlap / s.touching : 0;
	overlapWorstEver = std::max(overlapWorstEver, overlapWorst);
	overlapWorstPair = Vector2i(s.worstIds[0], s.worstIds[1]);
	wayWorstEver     = std::max(wayWorstEver, wayWorst);
	brokenTension += s.broken[NscdPhys::Tension];
	brokenShear += s.broken[NscdPhys::Shear];
	brokenTorque += s.broken[NscdPhys::Torque];
	brokenTwisting += s.broken[NscdPhys::Twisting];
	brokenMixed += s.broken[NscdPhys::Mixed];
	contactRate = s.contactRate;
	bondRate    = s.bondRate;
	meanSpeed   = s.bodies > 0 ? s.speed / s.bodies : 0;
	maxSpeed    = s.largestSpeed;
	centroid    = s.mass > 0 ? Vector3r(s.centre / s.mass) : Vector3r(Vector3r::Zero());
	momentum    = s.momentum;
}

void ContactDynamicsEngine::recordBreaks(const nscd::Resident& resident)
{
	for (const size_t k : seam.broken) {
		const nscd::ContactState& r  = seam.stateOf(seam.links[k]);
		const Vector3r            at = resident.contactPoint(r);
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
		        "ContactDynamicsEngine.dump: the last step was refused, and the problem of the one before is gone: "
		        "mend what was refused, and call O.step() first");
	if (wasInSpace) contact::space::write(path, { inSpace.problem, inSpace.warmStart, stepSolved });
	else
		contact::write(path, { seam.problem, seam.warmStart, stepSolved });
}

} // namespace yade
