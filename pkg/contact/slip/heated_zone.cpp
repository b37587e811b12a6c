#include "heated_zone.hpp"
#include "water.hpp"
#include <algorithm>
#include <cmath>

namespace nonsmooth::contact::slip {

const std::vector<Parameter>& HeatedZone::parameters()
{
	static const std::vector<Parameter> all {
		{ "friction", "-", "f, of the slip surface before it heats" },
		{ "thickness", "m", "h of the zone that shears; 0: slip on a plane" },
		{ "heat_capacity", "J/(m³ K)", "ρc", Bound::positive },
		{ "thermal_diffusivity", "m²/s", "α_th = K/ρc" },
		{ "temperature", "°C", "T₀, before slip", Bound::finite, 15 },
		{ "duration", "s", "for how long profiles are followed without their feeling the edge", Bound::positive,
		  60 },
		{ "finest_node", "m", "at the edge of the zone (0.05 mm, 0.03 mm in zones below 5 mm)", Bound::positive,
		  5e-5 },
		{ "node_growth", "-", "of a node over its neighbour (1.4; 1.3 in zones below 5 mm)", Bound::positive,
		  1.4, 3 },
	};
	return all;
}

HeatedZone::HeatedZone(const Values& values, Parts given)
        : coefficient(values.number(parameters(), "friction"))
        , thickness(values.number(parameters(), "thickness"))
        , heatCapacity(values.number(parameters(), "heat_capacity"))
        , diffusivity(values.number(parameters(), "thermal_diffusivity"))
        , start(values.number(parameters(), "temperature"))
        , parts(std::move(given))
{
	values.require(start > -zeroCelsius, "temperature", start, "above absolute zero [°C]");
	const double duration = values.number(parameters(), "duration");
	const bool   thin     = thickness < 5e-3;
	const double fastest  = std::max(diffusivity, parts.water ? parts.water->diffusivity : 0);
	NodeSizes    sizes;
	sizes.thickness = thickness;
	sizes.finest    = thin && !values.has("finest_node") ? 3e-5 : values.number(parameters(), "finest_node");
	sizes.growth    = thin && !values.has("node_growth") ? 1.3 : values.number(parameters(), "node_growth");
	sizes.reach     = 6 * std::sqrt(fastest * duration);
	values.require(sizes.growth >= 1, "node_growth", sizes.growth, "1 or more");
	const double uniform = (0.5 * thickness + sizes.reach) / sizes.finest;
	values.require(
	        sizes.growth > 1.01 || uniform < 1e5, "node_growth", sizes.growth,
	        "above 1.01 with so fine a first node");
	mesh = nodesOf(sizes);

	if (parts.water) {
		const double boils = boilingTemperature(parts.water->waterPressure);
		values.require(
		        start < boils, "temperature", start,
		        "below " + shown(boils) + " °C, where its water boils at water_pressure = "
		                + shown(parts.water->waterPressure) + " Pa");
	}
	if (parts.flash) {
		values.require(
		        parts.flash->weakened <= coefficient, "weakened_friction", parts.flash->weakened,
		        "at most friction = " + shown(coefficient));
		values.require(
		        start < parts.flash->temperature, "temperature", start,
		        "below weakening_temperature = " + shown(parts.flash->temperature) + " °C");
		values.require(
		        diffusivity > 0, "thermal_diffusivity", diffusivity, "positive, since contacts cool by it");
	}
	if (parts.reaction && parts.reaction->pressure > 0 && !parts.water)
		values.refuse(
		        "reaction_pressure = " + shown(parts.reaction->pressure)
		        + " Pa acts in pore water: name thermal_pressurization beside decomposition, or leave it out");
	if (parts.melt) {
		if (parts.reaction)
			values.refuse(
			        "decomposition and shear_melting exclude each other: what decomposes does not melt, "
			        "choose one");
		values.require(
		        start < parts.melt->temperature, "temperature", start,
		        "below melting_temperature = " + shown(parts.melt->temperature) + " °C");
		values.require(
		        parts.melt->peak >= coefficient, "peak_friction", parts.melt->peak,
		        "at least friction = " + shown(coefficient));
	}
}

/// Where a cell's columns begin; null where the law has no such part.
struct HeatedZone::State {
	double *temperature = nullptr, *pressure = nullptr, *vapour = nullptr, *reacted = nullptr, *friction = nullptr,
	       *melt = nullptr, *squeezed = nullptr;
};

std::vector<StateColumn> HeatedZone::columns() const
{
	std::vector<StateColumn> all;
	std::size_t              offset = 0;
	const auto               add    = [&](const char* name, const char* unit, bool across = false) {
                all.push_back({ name, unit, offset, across ? mesh.count() : 1, across });
                offset += all.back().width;
	};
	add("temperature", "°C", true);
	if (parts.water) {
		add("pressure", "Pa", true);
		add("vapour", "-");
	}
	if (parts.reaction) add("reacted", "-", true);
	if (parts.flash) add("friction", "-");
	if (parts.melt) {
		add("melt_thickness", "m");
		add("squeezed_out", "m");
	}
	return all;
}

HeatedZone::State HeatedZone::of(double* state) const
{
	State      s;
	const auto next = [&state](std::size_t width) {
		double* const column = state;
		state += width;
		return column;
	};
	s.temperature = next(mesh.count());
	if (parts.water) {
		s.pressure = next(mesh.count());
		s.vapour   = next(1);
	}
	if (parts.reaction) s.reacted = next(mesh.count());
	if (parts.flash) s.friction = next(1);
	if (parts.melt) {
		s.melt     = next(1);
		s.squeezed = next(1);
	}
	return s;
}

void HeatedZone::begin(double* state) const
{
	const State s = of(state);
	std::fill_n(s.temperature, mesh.count(), start);
	if (parts.flash) *s.friction = coefficient;
}

void HeatedZone::prepare(double h)
{
	Law::prepare(h);
	if (h == prepared) return;
	const std::size_t n = mesh.count();
	ofHeat.prepare(mesh, diffusivity, h);
	heatResponse.assign(n, 0);
	std::fill_n(heatResponse.begin(), mesh.inside, 1 / (heatCapacity * width()));
	ofHeat.apply(heatResponse.data(), heatResponse.data());
	if (parts.water) {
		ofWater.prepare(mesh, parts.water->diffusivity, h);
		pressureResponse.assign(n, 0);
		for (std::size_t k = 0; k < n; ++k)
			pressureResponse[k] = parts.water->coefficient * heatResponse[k];
		ofWater.apply(pressureResponse.data(), pressureResponse.data());
		meanPressure = mesh.mean(pressureResponse.data());
	}
	prepared = h;
}

double HeatedZone::width() const { return thickness > 0 ? thickness : 2 * mesh.width.front(); }

double HeatedZone::friction(const State& s, double slipRate) const
{
	if (!parts.flash) return coefficient;
	if (parts.flash->lag > 0) return *s.friction;
	const double fast  = flashVelocity(mesh.mean(s.temperature));
	return *s.friction = parts.flash->coefficient(slipRate, fast, coefficient);
}

double HeatedZone::flashVelocity(double temperature) const
{
	return parts.flash->velocity(temperature, diffusivity, heatCapacity);
}

void HeatedZone::strength(Cells& cells, Range range) const
{
	const std::size_t n = mesh.count();
	for (std::size_t c = range.begin; c < range.end; ++c) {
		const State   s     = of(cells.stateOf(c));
		const double  sigma = cells.normalStress[c], v = cells.slipRate[c];
		double* const T = cells.betweenOf(c); // T*
		if (parts.melt && *s.melt > 0) {
			cells.strength[c] = parts.melt->strength(v, *s.melt, sigma);
			continue;
		}
		ofHeat.apply(s.temperature, T);
		const double f = friction(s, v);
		if (!parts.water) {
			cells.strength[c] = f * std::max(sigma, 0.0);
			continue;
		}
		double* const u      = T + n; // u*
		const double  expand = *s.vapour > 0 ? 0 : parts.water->coefficient;
		for (std::size_t k = 0; k < n; ++k)
			u[k] = s.pressure[k] + expand * (T[k] - s.temperature[k]);
		ofWater.apply(u, u);
		const double x   = *s.vapour > 0 ? 0 : f * meanPressure * v * step;
		const double now = f * std::max(sigma - mesh.mean(s.pressure), 0.0), B = f * (sigma - mesh.mean(u));
		const double end  = (B - 0.5 * x * now) / (1 + 0.5 * x);
		cells.strength[c] = end < 0 || x > 2 ? std::max(B, 0.0) / (1 + x) : 0.5 * (now + end);
	}
}

void HeatedZone::advance(Cells& cells, Range range) const
{
	const std::size_t n = mesh.count();
	for (std::size_t c = range.begin; c < range.end; ++c) {
		const State         s = of(cells.stateOf(c));
		const double        q = cells.heat[c], v = cells.slipRate[c];
		const double* const T = cells.betweenOf(c);
		if (parts.melt && *s.melt > 0) {
			melts(s, q, v, cells.normalStress[c]);
			continue;
		}
		for (std::size_t k = 0; k < n; ++k)
			s.temperature[k] = T[k] + heatResponse[k] * q;
		if (parts.water) {
			const double* const u       = T + n;
			const double        expands = *s.vapour > 0 ? 0 : q;
			for (std::size_t k = 0; k < n; ++k)
				s.pressure[k] = u[k] + pressureResponse[k] * expands;
		}
		if (parts.reaction) react(s);
		const double warm = mesh.mean(s.temperature);
		if (parts.water && vapourPressure(warm) > parts.water->waterPressure + mesh.mean(s.pressure))
			*s.vapour = 1;
		if (parts.flash && parts.flash->lag > 0) {
			const double steady = parts.flash->coefficient(v, flashVelocity(warm), coefficient);
			*s.friction += (steady - *s.friction) * -std::expm1(-cells.path[c] / parts.flash->lag);
		}
		if (parts.melt && warm >= parts.melt->temperature) melts(s, 0, v, cells.normalStress[c]);
	}
	Law::advance(cells, range);
}

void HeatedZone::react(const State& s) const
{
	const Decomposition& reaction = *parts.reaction;
	for (std::size_t k = 0; k < mesh.count(); ++k) {
		const double amount = reaction.reacts(s.temperature[k], s.reacted[k], heatCapacity, step);
		s.reacted[k] += amount;
		s.temperature[k] -= reaction.heat / heatCapacity * amount;
		if (parts.water) s.pressure[k] += reaction.pressure * amount;
	}
}

/// What the zone is hotter than its melting point goes into the first melt.
void HeatedZone::melts(const State& s, double heat, double slipRate, double normalStress) const
{
	const ShearMelting& melt     = *parts.melt;
	double              excess   = heat;
	const double        thinnest = 1e-12; // m; tells a layer from none
	for (std::size_t k = 0; *s.melt == 0 && k < mesh.inside; ++k) {
		excess += 2 * mesh.width[k] * heatCapacity * (s.temperature[k] - melt.temperature);
		s.temperature[k] = melt.temperature;
	}
	const double molten = *s.melt + excess / melt.heat;
	*s.melt = std::max(melt.squeezed(*s.melt, excess / melt.heat, slipRate, normalStress, step), thinnest);
	*s.squeezed += molten - *s.melt;
}

double HeatedZone::heatIn(const double* state) const
{
	const State s   = of(const_cast<double*>(state)); // read alone
	double      sum = 0;
	for (std::size_t k = 0; k < mesh.count(); ++k) {
		sum += 2 * mesh.width[k] * heatCapacity * (s.temperature[k] - start);
		if (parts.reaction) sum += 2 * mesh.width[k] * parts.reaction->heat * s.reacted[k];
	}
	if (parts.melt) sum += parts.melt->heat * (*s.melt + *s.squeezed);
	return sum;
}

} // namespace nonsmooth::contact::slip
