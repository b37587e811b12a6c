// A slip zone that heats, alone: closed forms of diffusion, pressurization, flash heating, decomposition and melting,
// and that heat is kept.
#include <cmath>
#include <contact/slip/heated_zone.hpp>
#include <contact/slip/laws.hpp>
#include <contact/slip/water.hpp>
#include <gtest/gtest.h>

using namespace nonsmooth::contact::slip;

namespace {

Given with(Given values, const Given& more)
{
	for (const auto& [key, value] : more)
		values[key] = value;
	return values;
}

/// The adiabatic, undrained zone of a slide like that of Vaiont.
Given adiabatic()
{
	return { { "friction", { 0.4 } },           { "thickness", { 0.01 } },
		 { "heat_capacity", { 2.85e6 } },   { "thermal_diffusivity", { 0 } },
		 { "temperature", { 20 } },         { "pressurization_coefficient", { 6.7e4 } },
		 { "hydraulic_diffusivity", { 0 } } };
}

struct Driven {
	std::unique_ptr<Law> law;
	Cells                cells;
	double               made = 0; // heat [J/m²]

	Driven(const std::vector<std::string>& names, const Given& values, double sigma)
	        : law(makeLaw(names, values))
	        , cells(law->cells(1, sigma))
	{
	}
	const HeatedZone& zone() const { return dynamic_cast<const HeatedZone&>(*law); }
	/// Slips at V [m/s] for some steps of h [s].
	void slip(double v, double h, int steps)
	{
		law->prepare(h);
		cells.slipRate[0] = v;
		for (int k = 0; k < steps; ++k) {
			law->strength(cells, cells.all());
			cells.path[0] = v * h;
			cells.heat[0] = cells.strength[0] * v * h;
			made += cells.heat[0];
			law->advance(cells, cells.all());
		}
	}
	const double* column(const std::string& name)
	{
		for (const StateColumn& column : law->columns())
			if (column.name == name) return cells.stateOf(0) + column.offset;
		throw std::out_of_range(name);
	}
	double mean(const std::string& name) { return zone().nodes().mean(column(name)); }
	double kept() { return zone().heatIn(cells.stateOf(0)) / made; }
};

TEST(SlipProfile, HeatOfAPlaneSpreadsAsTheErrorFunctionHasIt)
{
	Nodes     nodes = nodesOf({ 0, 1e-5, 1.2, 0.1 });
	Diffusion diffusion;
	diffusion.prepare(nodes, 1e-6, 1e-3);
	std::vector<double> u(nodes.count(), 0);
	for (int k = 0; k < 1000; ++k) {
		u[0] += 1e-3 / nodes.width[0]; // 1 K m/s into this half
		diffusion.apply(u.data(), u.data());
	}
	const double root = std::sqrt(4e-6);
	for (std::size_t k = 0; k < nodes.count() && nodes.place(k) < 2e-3; ++k) {
		const double y = nodes.place(k), z = y / root;
		const double exact = 2 * std::sqrt(1 / (M_PI * 1e-6)) * std::exp(-z * z) - y / 1e-6 * std::erfc(z);
		EXPECT_NEAR(u[k] / exact, 1, 0.02) << y; // first order in h, and nodes that grow by 1.2
	}
	double sum = 0;
	for (std::size_t k = 0; k < nodes.count(); ++k)
		sum += nodes.width[k] * u[k];
	EXPECT_NEAR(sum, 1, 1e-12); // nothing leaves
}

TEST(SlipProfile, NodesFillTheZoneAndAreFinestAtItsEdge)
{
	const Nodes nodes = nodesOf({ 0.01, 5e-5, 1.4, 0.02 });
	double      half  = 0;
	for (std::size_t k = 0; k < nodes.inside; ++k)
		half += nodes.width[k];
	EXPECT_NEAR(half, 0.005, 1e-17);
	EXPECT_LE(nodes.width[nodes.inside - 1], 5e-5);
	EXPECT_EQ(nodes.width[nodes.inside], nodes.width[nodes.inside - 1]);
	EXPECT_GE(nodes.place(nodes.count() - 1) + 0.5 * nodes.width.back(), 0.025);
	EXPECT_EQ(nodesOf({ 0.01, 5e-5, 1.4, 0 }).count(), 1u); // nothing diffuses: one node
}

TEST(SlipPressurization, WithoutDiffusionStrengthDecaysExponentially)
{
	Driven       one({ "thermal_pressurization" }, adiabatic(), 2.183e6);
	const double critical = undrainedCriticalSlip(2.85e6, 0.01, 0.4, 6.7e4);
	EXPECT_NEAR(critical, 1.0634, 5e-5);
	one.slip(1, 1e-4, 24487); // to 10 % of it
	one.law->strength(one.cells, one.cells.all());
	EXPECT_NEAR(one.cells.strength[0] / (0.4 * 2.183e6) / std::exp(-2.4487 / critical), 1, 1e-4); // h V/D_c = 1e-4
	EXPECT_NEAR((one.mean("temperature") - 20) / (2.183e6 / 6.7e4 * (1 - std::exp(-2.4487 / critical))), 1, 1e-4);
	EXPECT_NEAR(one.kept(), 1, 1e-12);
	one.slip(1, 1, 1000); // however long steps are, strength is never negative
	EXPECT_GE(one.cells.strength[0], 0);
	EXPECT_LT(one.cells.strength[0], 1);
}

TEST(SlipPressurization, AStepForeseesTheHeatThatItMakes)
{
	Driven       one({ "thermal_pressurization" }, adiabatic(), 2.183e6);
	const double critical = undrainedCriticalSlip(2.85e6, 0.01, 0.4, 6.7e4);
	one.slip(1, 0.1 * critical, 10);
	// the integral of the strength over the slip; of second order in h V/D_c = 0.1, without foresight 3 % too much
	EXPECT_NEAR(one.made / (0.4 * 2.183e6 * critical * (1 - std::exp(-1))), 1, 2e-3);
}

TEST(SlipPressurization, WeakensLessWhereWaterLeaves)
{
	const Given drained = with(
	        adiabatic(), { { "thermal_diffusivity", { 1.45e-7 } }, { "hydraulic_diffusivity", { 1e-4 } } });
	Driven one({ "thermal_pressurization" }, adiabatic(), 2.183e6),
	        two({ "thermal_pressurization" }, drained, 2.183e6);
	one.slip(1, 1e-3, 1000);
	two.slip(1, 1e-3, 1000);
	EXPECT_GT(two.cells.strength[0], 1.5 * one.cells.strength[0]);
	EXPECT_GT(two.mean("temperature"), one.mean("temperature"));
	EXPECT_NEAR(two.kept(), 1, 1e-10); // temperatures of 1 K on nodes of up to 0.3 m
}

TEST(SlipPressurization, WhereWaterBoilsItNoLongerPressesAsALiquid)
{
	const Given leaves = with(
	        adiabatic(), { { "hydraulic_diffusivity", { 1 } }, { "friction", { 0.8 } }, { "duration", { 1 } } });
	Driven one({ "thermal_pressurization" }, leaves, 2.183e6);
	one.slip(1, 1e-3, 100);
	EXPECT_EQ(*one.column("vapour"), 0);
	EXPECT_GT(one.mean("pressure"), 0);
	one.slip(1, 1e-3, 3000);
	EXPECT_GT(one.mean("temperature"), boilingTemperature(101325));
	EXPECT_EQ(*one.column("vapour"), 1);
	one.slip(1, 1e-2, 500);
	EXPECT_NEAR(one.cells.strength[0], 0.8 * 2.183e6, 6e3); // what was made spreads over 12 m; else it were 2.7e4
}

TEST(SlipWater, BoilsOnTheLineOfEquation14)
{
	EXPECT_NEAR(
	        boilingTemperature(100 * 2500 * 9.81), 219.9, 0.05); // a column of rock of 100 m: the paper says 220 °C
	EXPECT_NEAR(vapourPressure(100) / 0.0896e6, 1, 1e-3);
	EXPECT_NEAR(vapourPressure(300) / 10.65e6, 1, 1e-3);
	for (const double t : { 5.0, 60.0, 150.0, 320.0 })
		EXPECT_NEAR(boilingTemperature(vapourPressure(t)), t, 1e-9);
}

Given flash(double temperature)
{
	return { { "friction", { 0.6 } },
		 { "thickness", { 0.005 } },
		 { "heat_capacity", { 2.7e6 } },
		 { "thermal_diffusivity", { 0.5e-6 } },
		 { "temperature", { temperature } },
		 { "weakened_friction", { 0.12 } },
		 { "weakening_temperature", { 920 } },
		 { "asperity_slip", { 5e-6 } },
		 { "contact_strength", { 3e9 } } };
}

TEST(SlipFlash, FrictionFallsBeyondThePapersVelocity)
{
	Driven one({ "flash_heating" }, flash(20), 1);
	EXPECT_NEAR(one.zone().flashVelocity(20), 0.20612, 5e-6); // eq. (15) with the paper's values
	const double v[] = { 0.1, 0.5, 1, 2, 10, 30 }, f[] = { 0.6, 0.3179, 0.2189, 0.1695, 0.1299, 0.1233 };
	for (int k = 0; k < 6; ++k) {
		one.cells.slipRate[0] = v[k];
		one.law->prepare(1e-9);
		one.law->strength(one.cells, one.cells.all());
		EXPECT_NEAR(one.cells.strength[0], f[k], 5e-5) << v[k];
	}
	EXPECT_NEAR(one.zone().flashVelocity(470), 0.25 * 0.20612, 2e-6); // half-way to T_w
	EXPECT_EQ(one.zone().flashVelocity(950), 0);
}

TEST(SlipFlash, TheZonesHeatLowersItsVelocity)
{
	Driven one({ "flash_heating" }, flash(20), 5e6);
	one.slip(0.19, 1e-3, 200);
	EXPECT_NEAR(one.cells.strength[0], 0.6 * 5e6, 1e-6); // below V_w still
	one.slip(0.19, 1e-3, 5000);
	EXPECT_LT(one.cells.strength[0], 0.5 * 5e6);
	EXPECT_NEAR(one.kept(), 1, 1e-12);
}

TEST(SlipFlash, ALagIsBySlip)
{
	Driven one({ "flash_heating" }, with(flash(20), { { "slip_lag", { 0.1 } } }), 1); // a stress that heats nothing
	one.slip(2, 1e-2, 5);
	EXPECT_NEAR(*one.column("friction"), 0.16947 + (0.6 - 0.16947) / std::exp(1), 1e-4); // 0.1 m: one lag
}

TEST(SlipFlash, WeakensTheZoneThatIsPressed)
{
	const Given both = with(
	        flash(20), { { "pressurization_coefficient", { 1e5 } }, { "hydraulic_diffusivity", { 1e-7 } } });
	Driven one({ "thermal_pressurization", "flash_heating" }, both, 2e6);
	one.law->prepare(1e-3);
	one.cells.slipRate[0] = 1;
	one.law->strength(one.cells, one.cells.all());
	EXPECT_NEAR(one.cells.strength[0], 0.2189 * 2e6, 0.01 * 0.2189 * 2e6); // what the step's own heat takes
	one.slip(1, 1e-3, 2000);
	EXPECT_NEAR(one.cells.strength[0], *one.column("friction") * (2e6 - one.mean("pressure")), 0.01 * 0.2189 * 2e6);
	EXPECT_GT(one.mean("pressure"), 1e5);
}

Given calcite(int order)
{
	return { { "friction", { 0.5 } },          { "thickness", { 1e-3 } },
		 { "heat_capacity", { 2.7e6 } },   { "thermal_diffusivity", { 0 } },
		 { "temperature", { 20 } },        { "activation_energy", { 319e3 } },
		 { "reaction_rate", { 2.95e15 } }, { "reacting_density", { 2700 } },
		 { "reaction_heat", { 3.19e6 } },  { "reaction_order", { double(order) } } };
}

TEST(SlipDecomposition, TheReactionCapsTheTemperature)
{
	for (const auto& [v, cap] : { std::pair(1.0, 753.57), std::pair(10.0, 820.99) })
		for (const int order : { 0, 1 }) {
			Driven one({ "decomposition" }, calcite(order), 3e6); // τ = 1.5 MPa
			for (int k = 0; k < 100000 && one.mean("reacted") < 0.1; ++k)
				one.slip(v, 1e-3 / v, 1);
			// that 10 % less is left to react lifts it by 3 K
			EXPECT_NEAR(one.mean("temperature"), cap + (order ? 2.8 : 0), order ? 0.4 : 0.01);
			EXPECT_NEAR(one.kept(), 1, 1e-12);
		}
}

TEST(SlipDecomposition, EndsWhereAllHasReacted)
{
	for (const int order : { 0, 1 }) {
		Driven one({ "decomposition" }, calcite(order), 3e6);
		one.slip(10, 1e-3, 2000);
		EXPECT_LE(one.mean("reacted"), 1);
		EXPECT_GT(one.mean("reacted"), 0.99);
		EXPECT_GT(one.mean("temperature"), 900); // nothing takes the heat any more
		EXPECT_NEAR(one.kept(), 1, 1e-12);
	}
}

TEST(SlipDecomposition, ItsFluidPresses)
{
	const Given fluid = with(
	        calcite(1),
	        { { "reaction_pressure", { 2e7 } },
	          { "pressurization_coefficient", { 0 } },
	          { "hydraulic_diffusivity", { 0 } },
	          { "water_pressure", { 2e7 } } });
	Driven one({ "thermal_pressurization", "decomposition" }, fluid, 3e6);
	one.slip(1, 1e-3, 3000);
	EXPECT_EQ(*one.column("vapour"), 1); // at 650 °C: what the reaction makes presses on
	EXPECT_NEAR(one.mean("pressure"), 2e7 * one.mean("reacted"), 1e-6);
	EXPECT_GT(one.mean("reacted"), 0.02);
	EXPECT_LT(one.cells.strength[0], 0.9 * 1.5e6);
}

Given gabbro(double decay)
{
	const double melting = 1100 + 273.15;
	return { { "friction", { 0.6 } },         { "thickness", { 0 } },
		 { "heat_capacity", { 3.2e6 } },  { "thermal_diffusivity", { 0.9e-6 } },
		 { "temperature", { 0 } },        { "duration", { 60 } },
		 { "finest_node", { 2e-5 } },     { "melting_temperature", { 1100 } },
		 { "melt_viscosity", { 100 } },   { "activation_temperature", { decay * melting * melting } },
		 { "melt_conductivity", { 2 } },  { "melting_heat", { 3.24e9 } },
		 { "squeezing_length", { 0.01 } } };
}

TEST(SlipMelting, ALayerBearsWhatABoundaryValueSolverFinds)
{
	const ShearMelting melt(Values("shear_melting", gabbro(0.02)));
	const double       w = 2.8284271247461903; // √(8K/(b η₀)), K = 2, b = 0.02
	EXPECT_NEAR(melt.strength(w, 1e-4, 1e9), 1.7627e6, 100);
	EXPECT_NEAR(melt.hottest(w) - 1100, 34.66, 0.005);
	EXPECT_NEAR(melt.strength(10 * w, 1e-4, 1e9), 8.438e5, 50);
	EXPECT_NEAR(melt.hottest(10 * w) - 1100, 230.8, 0.05);
	EXPECT_NEAR(melt.strength(0.1 * w, 1e-4, 1e9), 2.810e5, 50);
	EXPECT_NEAR(melt.strength(1e-9, 1e-4, 1e9), 1e-3, 1e-9); // η₀ V/m where nothing heats
	EXPECT_EQ(melt.strength(1, 0, 5), 5); // no layer yet: the peak friction
	EXPECT_EQ(melt.strength(1, 1e-9, 5), 5); // a thin one grips
}

TEST(SlipMelting, HeatsThenBrakesThenLubricates)
{
	const double sigma = 16e6;
	Driven       one({ "shear_melting" }, gabbro(0.02), sigma);
	double       slip = 0, most = 0;
	while (*one.column("melt_thickness") == 0 && slip < 10) {
		one.slip(1, 1e-3, 1);
		slip += 1e-3;
	}
	// τ V √t = ΔT ρc √(π α): heat of a plane
	const double heating = 1100 * 3.2e6 / 9.6e6;
	EXPECT_NEAR(
	        slip, M_PI * 0.9e-6 * heating * heating, 0.05 * slip); // the first node is 4 % of the depth that heats
	for (int k = 0; k < 5; ++k) {
		one.slip(1, 1e-3, 1);
		most = std::max(most, one.cells.strength[0]);
	}
	EXPECT_GT(most, 0.6 * sigma); // more than rock has
	one.slip(1, 1e-3, 2000);
	const double s = std::asinh(1 / 2.8284271247461903), bears = 100 * s / (std::sinh(s) * std::cosh(s));
	const double steady = std::pow(3.24e9 * sigma / 4, 0.25) * std::sqrt(bears / 0.01);
	EXPECT_NEAR(one.cells.strength[0], steady, 1e-6 * steady);
	EXPECT_LT(steady, 0.1 * sigma);
	EXPECT_NEAR(one.kept(), 1, 1e-9); // but for the first 1e-12 m
}

TEST(SlipMelting, FollowsPressurization)
{
	const Given wet = with(
	        with(gabbro(0.02), { { "thickness", { 1e-3 } } }),
	        { { "pressurization_coefficient", { 1e5 } }, { "hydraulic_diffusivity", { 1e-3 } } });
	Driven one({ "thermal_pressurization", "shear_melting" }, wet, 16e6);
	one.slip(1, 1e-3, 20);
	EXPECT_LT(one.cells.strength[0], 0.6 * 16e6);
	EXPECT_GT(one.cells.strength[0], 0.3 * 16e6);
	one.slip(1, 1e-3, 3000);
	EXPECT_GT(*one.column("melt_thickness"), 1e-5);
}

} // namespace
