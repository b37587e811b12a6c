// Which pairs the collider lists, when it lists them anew, and which of them are near.
#include "PlanarGridCollider.hpp"
#include "../checks/YadeFeatures.hpp"
#include "../seam/Resident.hpp"
#include <algorithm>
#include <boost/make_shared.hpp>
#include <core/Scene.hpp>
#include <neighbours/thread_part.hpp>

namespace yade {

namespace {
	using nonsmooth::neighbours::Disk;
	using nonsmooth::neighbours::isNear;
	using nonsmooth::neighbours::partOfThread;
}

/// D and D' of all regions.
void PlanarGridCollider::boundSpeeds()
{
	regions.differences(threads, velocities, rates);
	if (listed() < factor) regions.largestAround(rates, widestRates);
	else
		widestRates.assign(rates.size(), 0); // all within the reach are wanted, slow or fast
}

/// Whether pairs may be wanted that are not in the list.
bool PlanarGridCollider::moved()
{
	for (const Side& s : sides)
		for (const Real d : { s.box.xMin - s.reference.xMin, s.box.yMin - s.reference.yMin,
		                      s.box.xMax - s.reference.xMax, s.box.yMax - s.reference.yMax })
			if (!(std::abs(d) <= farPath)) return true;
	const long size  = (long)disks.size();
	bool       other = false;
	paths.resize(size);
#pragma omp parallel for schedule(static) num_threads(threads) reduction(|| : other)
	for (long id = 0; id < size; ++id) {
		paths[id] = { disks[id].x - reference[id].x, disks[id].y - reference[id].y };
		// one that had no place when the lists were made, as one that was no number, and has one now has come
		// from farther than any bound
		other = other || disks[id].r != reference[id].r
		        || (isThere(disks[id])
		            && !(std::abs(paths[id].x) <= farPath && std::abs(paths[id].y) <= farPath));
	}
	if (other) return true;
	boundSpeeds();
	regions.differences(threads, paths, spreads);
	for (int s = 0; s < regions.count(); ++s)
		if (!(spreads[s] + foresight * scene->dt * widestRates[s] <= allowances[s])) return true;
	return false;
}

/// Looks pairs up, and keeps what is known of those that were there before.
void PlanarGridCollider::search()
{
	++searches;
	std::swap(pairs, before);
	std::swap(known, knownBefore);
	Real smallest = std::numeric_limits<Real>::max(), largest = 0;
	for (const Disk& d : disks)
		if (d.r > 0) {
			smallest = std::min(smallest, d.r);
			largest  = std::max(largest, d.r);
		}
	const Real farthest = largest > 0 ? 2 * factor * largest : 1;
	const Real margin   = largest > 0 && verletDist < 0 ? -verletDist * smallest : std::max(Real(0), verletDist);
	farPath             = farthest / 4;
	regions.build(disks, farthest + 2 * farPath);
	boundSpeeds();
	allowances.resize(regions.count());
	for (int s = 0; s < regions.count(); ++s)
		allowances[s] = margin + scene->dt * (ahead * rates[s] + foresight * widestRates[s]);
	for (size_t id = 0; id < disks.size(); ++id)
		if (regions.of(int(id)) >= 0) disks[id].margin = allowances[regions.of(int(id))];
	reference = disks;
	grid.build(disks, listed() * (1 + 1e-8)); // more than rounding takes away
	grid.pairs(threads, pairs);
	known.assign(pairs.second.size(), 0);
	const long size = (long)std::min(disks.size(), before.begin.empty() ? 0 : before.begin.size() - 1);
#pragma omp parallel for schedule(static) num_threads(threads)
	for (long i = 0; i < size; ++i)
		for (int k = pairs.begin[i], b = before.begin[i]; k < pairs.begin[i + 1] && b < before.begin[i + 1];) {
			if (pairs.second[k] == before.second[b]) known[k++] = knownBefore[b++];
			else if (pairs.second[k] < before.second[b])
				++k;
			else
				++b;
		}
	searchSides();
	candidates = int(pairs.second.size() + sidePairs.size());
}

void PlanarGridCollider::searchSides()
{
	std::vector<SidePair> old;
	old.swap(sidePairs);
	std::vector<int> disksNear;
	for (size_t s = 0; s < sides.size(); ++s) {
		sides[s].reference = sides[s].box;
		grid.near(sides[s].box, reachAround(factor), 2 * farPath, disksNear);
		for (const int disk : disksNear)
			sidePairs.push_back({ int(s), disk, false });
	}
	const auto key = [](const SidePair& p) { return std::make_pair(p.side, p.disk); };
	auto       now = sidePairs.begin();
	for (const SidePair& pair : old) {
		while (now != sidePairs.end() && key(*now) < key(pair))
			++now;
		if (now != sidePairs.end() && key(*now) == key(pair)) now->known = pair.known;
		else if (pair.known)
			eraseIfUnreal(sides[pair.side].id, pair.disk);
	}
	resident->forgetErased(*scene->interactions);
}

/// Finds the pairs of disks within reach that are wanted and that O.interactions has not; and, where that decides it,
/// how fast each disk is against those near it.
void PlanarGridCollider::findNear()
{
	const long size    = (long)disks.size();
	const bool decides = listed() < factor;
	fastest.assign(size, 0);
	near.resize(threads);
	fastestOf.resize(threads);
	for (int part = 0; part < threads; ++part) { // there may be fewer threads than asked for
		near[part].clear();
		if (decides) fastestOf[part].assign(size, 0);
	}
#pragma omp parallel num_threads(threads)
	{
		auto& comes = partOfThread(near);
		auto& speed = partOfThread(fastestOf);
#pragma omp for schedule(static)
		for (long i = 0; i < size; ++i) {
			const Disk a    = disks[i];
			const auto v    = velocities[i];
			Real       most = decides ? speed[i] : 0;
			for (int k = pairs.begin[i]; k < pairs.begin[i + 1]; ++k) {
				const int   j     = pairs.second[k];
				const Disk& b     = disks[j];
				const Real  reach = factor * (a.r + b.r), dx = b.x - a.x, dy = b.y - a.y,
				           apart = dx * dx + dy * dy;
				if (!(apart <= reach * reach * (1 + 1e-9))) {
					known[k] = 0; // the functor decides, with rounding of its own
					if (apart > reach * reach) continue;
				} else if (!known[k])
					comes.emplace_back(int(i), k);
				if (!decides) continue;
				const Real x = velocities[j].x - v.x, y = velocities[j].y - v.y, square = x * x + y * y;
				if (square <= std::min(most, speed[j]) || apart > reach * reach) continue;
				// by itself it must be wanted, so that it does not matter when pairs were looked up
				const Real sure = wantedWithin(int(i), j, 0); // most are within it, which needs no root
				if (apart > sure * sure) {
					const Real wanted = wantedWithin(int(i), j, std::sqrt(square));
					if (apart > wanted * wanted) continue;
				}
				most     = std::max(most, square);
				speed[j] = std::max(speed[j], square);
			}
			if (decides) speed[i] = most;
		}
		if (decides) {
#pragma omp for schedule(static)
			for (long i = 0; i < size; ++i) {
				for (const auto& p : fastestOf)
					fastest[i] = std::max(fastest[i], p[i]);
				fastest[i] = std::sqrt(fastest[i]);
			}
		}
		comes.erase(
		        std::remove_if(
		                comes.begin(), comes.end(),
		                [this](const auto& pair) { return !isWanted(pair.first, pair.second); }),
		        comes.end());
	}
}

/// Whether the pair at that place of its first disk is wanted now.
bool PlanarGridCollider::isWanted(int i, int place) const
{
	const int   j = pairs.second[place];
	const Disk &a = disks[i], &b = disks[j];
	const Real  x = b.x - a.x, y = b.y - a.y;
	return wants(i, j, std::sqrt(x * x + y * y));
}

/// Gives O.interactions the pairs of disks that were found.
void PlanarGridCollider::takeDisks()
{
	for (const auto& part : near) // threads have stretches of the list, one after the other
		for (const auto& [i, k] : part) {
			insert(i, pairs.second[k]);
			known[k] = 1;
		}
}

void PlanarGridCollider::takeSides()
{
	for (SidePair& pair : sidePairs) {
		const Disk& d = disks[pair.disk];
		if (pair.known || !isNear(sides[pair.side].box, d.x, d.y, reachAround(factor) * d.r)) continue;
		insert(std::min(sides[pair.side].id, pair.disk), std::max(sides[pair.side].id, pair.disk));
		pair.known = true;
	}
}

void PlanarGridCollider::insert(Body::id_t a, Body::id_t b)
{
	if (resident->bare > 0 && resident->isContact(std::min(a, b), std::max(a, b))) return;
	if (!nscd::mayCollide(*this, *Body::byId(a, scene), *Body::byId(b, scene)) || scene->interactions->found(a, b))
		return;
	if (mayBeBare(a, b)) {
		resident->proposed.push_back({ std::min(a, b), std::max(a, b), int(scene->iter) });
		return;
	}
	const auto interaction = boost::make_shared<Interaction>(a, b);
	scene->interactions->insert(interaction);
	if (resident->hasContacts()) resident->addPotential(interaction);
}

/// Whether the contact of a pair may do without an interaction, as far as its bodies tell: see NscdInteractionLoop.
bool PlanarGridCollider::mayBeBare(Body::id_t a, Body::id_t b) const
{
	const auto &first = resident->bodies[a], &second = resident->bodies[b];
	return resident->hasContacts() && first.plain && second.plain && first.planar && second.planar
	        && first.z == second.z && scene->iter <= std::numeric_limits<int>::max();
}

} // namespace yade
