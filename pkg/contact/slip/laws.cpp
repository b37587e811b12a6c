#include "laws.hpp"
#include "exponential.hpp"
#include "heated_zone.hpp"
#include "linear.hpp"
#include "none.hpp"
#include "step.hpp"
#include "tabulated.hpp"
#include <algorithm>
#include <stdexcept>

namespace nonsmooth::contact::slip {

namespace {
	const std::vector<Parameter> before { { "friction", "-", "f, before slip" } };
	const std::vector<Parameter> weakening {
		{ "friction", "-", "f, before slip" },
		{ "critical_slip", "m", "D_c", Bound::positive },
		{ "weakened_friction", "-", "f_w, that is left in the end", Bound::notNegative, 0 },
	};

	std::string names()
	{
		std::string all;
		for (const Entry& entry : entries())
			all += (all.empty() ? "" : ", ") + entry.name;
		return all;
	}

	template <class Kind> std::unique_ptr<Law> weakens(const Values& values)
	{
		return std::make_unique<Kind>(
		        values.number(weakening, "critical_slip"), values.number(weakening, "friction"),
		        values.number(weakening, "weakened_friction"));
	}
}

const std::vector<Entry>& entries()
{
	static const std::vector<Entry> all {
		{ "none", "nothing weakens", before },
		{ "step", "all of the strength, then none from the critical slip on", weakening },
		{ "linear", "to none at the critical slip", weakening },
		{ "exponential", "by exp(-slip/D_c)", weakening },
		{ "thermal_pressurization", "pore water expands as the zone heats", Pressurization::parameters(),
		  true },
		{ "flash_heating", "microcontacts weaken at high slip rates", FlashHeating::parameters(), true },
		{ "tabulated", "friction from a table of slip and velocity, with a slip lag", Tabulated::parameters() },
		{ "decomposition", "a reaction takes up heat and sets fluid free", Decomposition::parameters(), true },
		{ "shear_melting", "rock melts and flows as a viscous layer", ShearMelting::parameters(), true },
	};
	return all;
}

const std::vector<Parameter>& zoneParameters() { return HeatedZone::parameters(); }

std::unique_ptr<Law> makeLaw(const std::vector<std::string>& wanted, const Given& given)
{
	if (wanted.empty()) throw std::invalid_argument("no slip law is named: name one of " + names());
	std::string                         together;
	std::vector<std::vector<Parameter>> known;
	bool                                heats = true;
	for (const std::string& name : wanted) {
		const auto entry = std::find_if(entries().begin(), entries().end(), [&name](const Entry& one) {
			return one.name == name;
		});
		if (entry == entries().end())
			throw std::invalid_argument("slip law '" + name + "': it must be one of " + names());
		if (std::count(wanted.begin(), wanted.end(), name) > 1)
			throw std::invalid_argument("slip law '" + name + "' is named twice: name it once");
		together += (together.empty() ? "" : "+") + name;
		heats = heats && entry->heats;
		known.push_back(entry->parameters);
	}
	if (wanted.size() > 1 && !heats)
		throw std::invalid_argument(
		        "slip laws " + together
		        + " do not share a zone: only thermal_pressurization, flash_heating, decomposition and "
		          "shear_melting go together");
	if (heats) known.push_back(HeatedZone::parameters());
	const Values values(together, given);
	values.knowAll(known);

	const std::string& name = wanted.front();
	if (name == "none") return std::make_unique<None>(values.number(before, "friction"));
	if (name == "step") return weakens<Step>(values);
	if (name == "linear") return weakens<Linear>(values);
	if (name == "exponential") return weakens<Exponential>(values);
	if (name == "tabulated") return std::make_unique<Tabulated>(values);
	const auto named = [&wanted](const char* part) { return std::count(wanted.begin(), wanted.end(), part) > 0; };
	HeatedZone::Parts parts;
	if (named("thermal_pressurization")) parts.water = Pressurization(values);
	if (named("flash_heating")) parts.flash = FlashHeating(values);
	if (named("decomposition")) parts.reaction = Decomposition(values);
	if (named("shear_melting")) parts.melt = ShearMelting(values);
	return std::make_unique<HeatedZone>(values, parts);
}

bool knowsBySlip(const std::string& name) { return name == "step" || name == "linear" || name == "exponential"; }

std::unique_ptr<BySlip> makeBySlip(const std::string& name, double critical)
{
	positiveCriticalSlip(critical);
	if (name == "step") return std::make_unique<Step>(critical);
	if (name == "linear") return std::make_unique<Linear>(critical);
	if (name == "exponential") return std::make_unique<Exponential>(critical);
	throw std::invalid_argument("weakening = '" + name + "': it must be 'step', 'linear' or 'exponential'");
}

} // namespace nonsmooth::contact::slip
