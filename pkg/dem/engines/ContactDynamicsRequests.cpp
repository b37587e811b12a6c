// What scripts ask of the engine between steps: bonds, strengths, and tables of bodies, contacts, breaks and energies.
#include "../materials/BondEllipse.hpp"
#include "ContactDynamicsEngine.hpp"
#include "../seam/PythonBytes.hpp"
#include "../space/SpaceBond.hpp"
#include <optional>
#include <pkg/dem/ScGeom.hpp>

namespace yade {

namespace {
	/// Whether an interaction's bodies are still there, with their shapes: YADE's loop takes it out in the next
	/// step where they are not.
	bool hasBodies(const Interaction& i, const Scene& scene)
	{
		const auto& bodies  = *scene.bodies;
		const auto  isThere = [&](Body::id_t id) { return bodies.exists(id) && bodies[id]->shape; };
		return isThere(i.getId1()) && isThere(i.getId2());
	}
}

boost::python::dict ContactDynamicsEngine::contactForms()
{
	using namespace nonsmooth::contact;
	boost::python::dict bytes;
	const auto          tell = [&bytes](const char* form, size_t size) { bytes[form] = size; };
	tell("order", sizeof(nscd::Resident::Place));
	tell("state", sizeof(nscd::ContactState));
	tell("bond", sizeof(nscd::BondState));
	tell("strain", sizeof(nscd::BondStrain));
	tell("link", sizeof(nscd::Link));
	tell("contact", sizeof(Contact));
	tell("impulse", sizeof(Impulse));
	tell("pair", sizeof(MovablePair));
	tell("lane", sizeof(std::int32_t));
	tell("block", sizeof(Block<double>) / lanes);
	tell("rounded block", sizeof(Block<float>) / lanes);
	tell("error", sizeof(PositionError));
	return bytes;
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
		const auto     pair = nscd::bondPair(*Body::byId(i->getId1(), scene), *Body::byId(i->getId2(), scene));
		const Vector3r normal = pair.swapped ? Vector3r(-geom.normal) : geom.normal;
		if (auto* inSpace = dynamic_cast<NscdSpacePhys*>(phys))
			nscd::markBondInSpace(*inSpace, pair, normal, gap);
		else
			nscd::markBond(*phys, pair, normal, gap);
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
	nscd::Resident::of(here)->showBare([&](const nscd::ContactState& r, const Vector3r& at) {
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
