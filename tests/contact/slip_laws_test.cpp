// Laws of slip surfaces by name: functions of slip alone, tables, what is refused, and that ranges of cells do not
// matter.
#include <cmath>
#include <contact/slip/by_slip.hpp>
#include <contact/slip/laws.hpp>
#include <gtest/gtest.h>
#include <stdexcept>

using namespace nonsmooth::contact::slip;

namespace {

double left(const char* law, double slip, double critical) { return makeBySlip(law, critical)->left(slip); }

TEST(SlipLaws, StepKeepsAllThenNothing)
{
	EXPECT_EQ(left("step", 0, 5), 1);
	EXPECT_EQ(left("step", std::nextafter(5, 0), 5), 1);
	EXPECT_EQ(left("step", 5, 5), 0);
	EXPECT_EQ(left("step", 50, 5), 0);
}

TEST(SlipLaws, LinearAndExponential)
{
	EXPECT_EQ(left("linear", 0, 4), 1);
	EXPECT_DOUBLE_EQ(left("linear", 1, 4), 0.75);
	EXPECT_EQ(left("linear", 4, 4), 0);
	EXPECT_EQ(left("linear", 9, 4), 0);
	EXPECT_EQ(left("exponential", 0, 4), 1);
	EXPECT_DOUBLE_EQ(left("exponential", 4, 4), std::exp(-1));
}

TEST(SlipLaws, RefusesWhatItDoesNotKnow)
{
	EXPECT_THROW(makeBySlip("linear", 0), std::invalid_argument);
	EXPECT_THROW(makeBySlip("linear", -1), std::invalid_argument);
	EXPECT_THROW(makeBySlip("linear", std::nan("")), std::invalid_argument);
	EXPECT_FALSE(knowsBySlip("quadratic"));
	try {
		makeBySlip("quadratic", 1);
		FAIL() << "an unknown function was taken";
	} catch (const std::invalid_argument& error) {
		EXPECT_NE(std::string(error.what()).find("'quadratic'"), std::string::npos);
	}
}

TEST(SlipLaws, CellsFallFromFrictionToWhatIsLeft)
{
	const auto law = makeLaw(
	        { "linear" },
	        { { "friction", { 0.5 } }, { "weakened_friction", { 0.1 } }, { "critical_slip", { 2 } } });
	Cells cells = law->cells(4, 100);
	cells.path  = { 0, 1, 2, 3 };
	law->prepare(0.1);
	law->strength(cells, cells.all());
	law->advance(cells, cells.all());
	law->strength(cells, cells.all());
	EXPECT_DOUBLE_EQ(cells.strength[0], 50);
	EXPECT_DOUBLE_EQ(cells.strength[1], 30); // half-way from 0.5 to 0.1
	EXPECT_DOUBLE_EQ(cells.strength[2], 10);
	EXPECT_DOUBLE_EQ(cells.strength[3], 10);
	cells.normalStress.assign(4, -100); // nothing presses
	law->strength(cells, cells.all());
	EXPECT_EQ(cells.strength[0], 0);
	const auto none = makeLaw({ "none" }, { { "friction", { 0.3 } } });
	Cells      same = none->cells(1, 100);
	same.slip[0]    = 1e6;
	none->strength(same, same.all());
	EXPECT_DOUBLE_EQ(same.strength[0], 30);
	const auto rises = makeLaw(
	        { "step" }, { { "friction", { 0.1 } }, { "weakened_friction", { 0.5 } }, { "critical_slip", { 2 } } });
	same.slip[0] = 5;
	rises->strength(same, same.all());
	EXPECT_DOUBLE_EQ(same.strength[0], 10); // what is left is no more than what was there
}

// ---- tables

Given silicaGel()
{
	return { { "slips", { 0 } },
		 { "velocities", { 0.03, 0.1, 1 } },
		 { "friction_table", { 0.6, 0.2, 0 } },
		 { "slip_lag", { 0.3 } },
		 { "initial_friction", { 0.6 } } };
}

TEST(SlipTable, IsLinearInSlipAndInTheLogarithmOfVelocity)
{
	const auto law = makeLaw(
	        { "tabulated" },
	        { { "slips", { 0, 2 } }, { "velocities", { 1, 100 } }, { "friction_table", { 0.8, 0.4, 0.6, 0 } } });
	Cells cells    = law->cells(6, 1);
	cells.slip     = { 0, 2, 1, 0, 9, 1 };
	cells.slipRate = { 0, 1e9, 1, 10, 0.1, 10 };
	law->strength(cells, cells.all());
	const double expected[] = { 0.8, 0, 0.7, 0.6, 0.6, 0.45 }; // edges go on; 10 is half-way from 1 to 100
	for (int k = 0; k < 6; ++k)
		EXPECT_NEAR(cells.strength[k], expected[k], 1e-14) << k; // rounding
}

TEST(SlipTable, FrictionFollowsBySlip)
{
	const auto law    = makeLaw({ "tabulated" }, silicaGel());
	Cells      cells  = law->cells(1, 1);
	cells.slipRate[0] = 0.1;
	law->prepare(0.01);
	for (const double path : { 0.1, 0.05, 0.15 }) { // exact in steps of any length
		law->strength(cells, cells.all());
		cells.path[0] = path;
		law->advance(cells, cells.all());
	}
	law->strength(cells, cells.all());
	EXPECT_NEAR(cells.strength[0], 0.2 + 0.4 / std::exp(1), 1e-12); // 0.3472, Di Toro's numbers
}

// ---- refusals

Given zone()
{
	return { { "friction", { 0.4 } },
		 { "thickness", { 0.01 } },
		 { "heat_capacity", { 2.85e6 } },
		 { "thermal_diffusivity", { 1.45e-7 } },
		 { "temperature", { 20 } } };
}

Given with(Given values, const Given& more)
{
	for (const auto& [key, value] : more)
		values[key] = value;
	return values;
}

Given water()
{
	return with(zone(), { { "pressurization_coefficient", { 6.7e4 } }, { "hydraulic_diffusivity", { 7e-8 } } });
}

Given flash()
{
	return { { "weakened_friction", { 0.12 } },
		 { "weakening_temperature", { 920 } },
		 { "asperity_slip", { 5e-6 } },
		 { "contact_strength", { 3e9 } } };
}

Given calcite()
{
	return { { "activation_energy", { 319e3 } },
		 { "reaction_rate", { 2.95e15 } },
		 { "reacting_density", { 2700 } },
		 { "reaction_heat", { 3.19e6 } } };
}

Given melt()
{
	return { { "melting_temperature", { 1100 } },   { "melt_viscosity", { 100 } },
		 { "activation_temperature", { 4e4 } }, { "melt_conductivity", { 2 } },
		 { "melting_heat", { 3.2e9 } },         { "squeezing_length", { 0.01 } } };
}

std::string refusal(const std::vector<std::string>& names, const Given& values)
{
	try {
		makeLaw(names, values);
	} catch (const std::invalid_argument& error) {
		return error.what();
	}
	return "taken";
}

TEST(SlipRefusals, OneMessageNamesKeyValueAndRemedy)
{
	using Names                                                 = std::vector<std::string>;
	const Names                                              tp = { "thermal_pressurization" };
	const std::vector<std::tuple<Names, Given, std::string>> cases {
		{ tp, water(), "taken" },
		{ {}, {}, "no slip law is named" },
		{ { "gel" }, {}, "slip law 'gel': it must be one of none, step" },
		{ { "flash_heating", "flash_heating" }, {}, "'flash_heating' is named twice" },
		{ { "step", "thermal_pressurization" },
		  {},
		  "slip laws step+thermal_pressurization do not share a zone" },
		{ { "step" },
		  { { "friction", { 0.3 } } },
		  "slip law step: critical_slip [m] is missing: give it, D_c" },
		{ { "step" },
		  { { "friction", { 0.3 } }, { "critical_slip", { 0 } } },
		  "critical_slip = 0 m, it must be positive and finite" },
		{ tp, with(water(), { { "hydraulic_diffusivity", { -1 } } }),
		  "slip law thermal_pressurization: hydraulic_diffusivity = -1 m²/s, it must be 0 or more and finite" },
		{ tp, with(water(), { { "thickness", { std::nan("") } } }), "thickness = nan m, it must be 0 or more" },
		{ tp, with(water(), { { "thickness", { 1, 2 } } }), "thickness is a list: give one number [m]" },
		{ tp, with(water(), { { "permeability", { 1e-19 } } }),
		  "it has no permeability; it takes pressurization_coefficient" },
		{ tp, with(water(), { { "temperature", { 120 } } }), "temperature = 120, it must be below 103.4" },
		{ tp, with(water(), { { "temperature", { -300 } } }), "above absolute zero" },
		{ tp, with(water(), { { "node_growth", { 0.5 } } }), "node_growth = 0.5, it must be 1 or more" },
		{ tp, with(water(), { { "node_growth", { 1 } }, { "finest_node", { 1e-9 } } }),
		  "above 1.01 with so fine" },
		{ { "flash_heating" },
		  with(with(zone(), flash()), { { "weakened_friction", { 0.5 } } }),
		  "weakened_friction = 0.5, it must be at most friction = 0.4" },
		{ { "flash_heating" },
		  with(with(zone(), flash()), { { "temperature", { 930 } } }),
		  "below weakening_temperature = 920" },
		{ { "flash_heating" },
		  with(with(zone(), flash()), { { "thermal_diffusivity", { 0 } } }),
		  "positive, since contacts cool" },
		{ { "decomposition" },
		  with(with(zone(), calcite()), { { "reaction_pressure", { 1e6 } } }),
		  "name thermal_pressurization beside decomposition" },
		{ { "decomposition" },
		  with(with(zone(), calcite()), { { "reaction_order", { 0.5 } } }),
		  "reaction_order = 0.5, it must be 1 or 0" },
		{ { "decomposition", "shear_melting" }, with(with(zone(), calcite()), melt()), "exclude each other" },
		{ { "shear_melting" },
		  with(with(zone(), melt()), { { "peak_friction", { 0.2 } } }),
		  "at least friction = 0.4" },
		{ { "shear_melting" },
		  with(with(zone(), melt()), { { "temperature", { 1200 } } }),
		  "below melting_temperature = 1100" },
		{ { "tabulated" },
		  with(silicaGel(), { { "velocities", { 0.03, 0.03, 1 } } }),
		  "velocities must rise, and 0.03 follows 0.03" },
		{ { "tabulated" },
		  with(silicaGel(), { { "friction_table", { 0.6 } } }),
		  "friction_table has 1 numbers: give 1 slips times 3" },
		{ { "tabulated" },
		  with(silicaGel(), { { "velocities", {} } }),
		  "velocities [m/s] is missing: give a list" },
	};
	for (const auto& [names, values, message] : cases)
		EXPECT_NE(refusal(names, values).find(message), std::string::npos)
		        << refusal(names, values) << "\nand not\n"
		        << message;
	EXPECT_THROW(makeLaw(tp, water())->prepare(0), std::invalid_argument);
}

// ---- ranges

TEST(SlipCells, RangesDoNotMatter)
{
	const Given all = with(with(water(), flash()), { { "slip_lag", { 0.05 } } });
	const auto  law = makeLaw({ "thermal_pressurization", "flash_heating" }, all);
	law->prepare(0.01);
	Cells whole = law->cells(7, 2e6), parts = whole;
	for (int step = 0; step < 50; ++step) {
		for (Cells* cells : { &whole, &parts })
			for (std::size_t k = 0; k < 7; ++k)
				cells->slipRate[k] = 0.3 * double(k);
		law->strength(whole, whole.all());
		for (const Range range : { Range { 3, 7 }, Range { 0, 1 }, Range { 1, 3 } })
			law->strength(parts, range);
		for (Cells* cells : { &whole, &parts })
			for (std::size_t k = 0; k < 7; ++k) {
				cells->path[k] = cells->slipRate[k] * 0.01;
				cells->heat[k] = cells->strength[k] * cells->path[k];
			}
		law->advance(whole, whole.all());
		for (const Range range : { Range { 5, 7 }, Range { 0, 5 } })
			law->advance(parts, range);
	}
	EXPECT_EQ(whole.strength, parts.strength);
	EXPECT_EQ(whole.state, parts.state);
	EXPECT_EQ(whole.slip, parts.slip);
	EXPECT_LT(whole.strength[6], 0.5 * whole.strength[0]);
}

} // namespace
