#include "parameters.hpp"
#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace nonsmooth::contact::slip {

std::string shown(double value)
{
	std::ostringstream text;
	text << value;
	return text.str();
}

void Values::refuse(const std::string& text) const { throw std::invalid_argument("slip law " + law + ": " + text); }

void Values::require(bool good, const std::string& key, double value, const std::string& what) const
{
	if (!good) refuse(key + " = " + shown(value) + ", it must be " + what);
}

const Parameter& Values::find(const std::vector<Parameter>& of, const std::string& key) const
{
	const auto found = std::find_if(of.begin(), of.end(), [&key](const Parameter& one) { return one.key == key; });
	if (found == of.end()) throw std::logic_error("slip law " + law + " has no parameter " + key);
	return *found;
}

void Values::check(const Parameter& p, double value) const
{
	const bool        low  = p.bound == Bound::finite || (p.bound == Bound::positive ? value > 0 : value >= 0);
	const bool        good = std::isfinite(value) && low && value <= p.most;
	const std::string unit = std::string(p.unit) == "-" ? "" : std::string(" ") + p.unit;
	std::string what = p.bound == Bound::positive ? "positive" : p.bound == Bound::finite ? "finite" : "0 or more";
	what += p.most < endless ? " and at most " + shown(p.most) : p.bound == Bound::finite ? "" : " and finite";
	if (!good) refuse(std::string(p.key) + " = " + shown(value) + unit + ", it must be " + what);
}

double Values::number(const std::vector<Parameter>& of, const std::string& key) const
{
	const Parameter& p     = find(of, key);
	const auto       value = given.find(key);
	if (value == given.end()) {
		if (std::isnan(p.fallback)) refuse(key + " [" + p.unit + "] is missing: give it, " + p.what);
		return p.fallback;
	}
	if (value->second.size() != 1) refuse(key + " is a list: give one number [" + p.unit + "]");
	check(p, value->second.front());
	return value->second.front();
}

const std::vector<double>& Values::list(const std::vector<Parameter>& of, const std::string& key) const
{
	const Parameter& p     = find(of, key);
	const auto       value = given.find(key);
	if (value == given.end() || value->second.empty())
		refuse(key + " [" + p.unit + "] is missing: give a list, " + p.what);
	for (const double one : value->second)
		check(p, one);
	return value->second;
}

void Values::knowAll(const std::vector<std::vector<Parameter>>& groups) const
{
	std::string all;
	for (const auto& group : groups)
		for (const Parameter& p : group)
			all += (all.empty() ? "" : ", ") + std::string(p.key);
	for (const auto& [key, value] : given)
		if ((", " + all + ", ").find(", " + key + ", ") == std::string::npos)
			refuse("it has no " + key + "; it takes " + all);
}

} // namespace nonsmooth::contact::slip
