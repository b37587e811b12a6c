// The laws by name: what a script, a section file or a material asks for.
#pragma once

#include <contact/slip/by_slip.hpp>
#include <contact/slip/parameters.hpp>
#include <memory>

namespace nonsmooth::contact::slip {

/// What one name stands for.
struct Entry {
	std::string            name;
	std::string            what;
	std::vector<Parameter> parameters; // of this law alone
	bool                   heats = false; // shares a heated zone with others, and takes its parameters too
};
const std::vector<Entry>& entries();
/// Parameters of the zone that all laws with `heats` share.
const std::vector<Parameter>& zoneParameters();

/// A law, or several that share a heated zone, by their names. Throws std::invalid_argument, one message for what
/// does not fit.
std::unique_ptr<Law> makeLaw(const std::vector<std::string>& names, const Given& values);

/// Whether a function of slip alone has this name.
bool knowsBySlip(const std::string& name);
/// A function of slip alone with the critical slip D_c [m]. Throws std::invalid_argument for an unknown name or a D_c
/// that is not positive.
std::unique_ptr<BySlip> makeBySlip(const std::string& name, double critical);

} // namespace nonsmooth::contact::slip
