// Parameters of laws as data: what there is to give, in which unit and range. One message names the law, the key, the
// value and what would do.
#pragma once

#include <limits>
#include <map>
#include <string>
#include <vector>

namespace nonsmooth::contact::slip {

/// What a parameter may be.
enum class Bound { positive, notNegative, finite };
constexpr double required = std::numeric_limits<double>::quiet_NaN();
constexpr double endless  = std::numeric_limits<double>::infinity();

struct Parameter {
	const char* key;
	const char* unit; // "-" for none
	const char* what; // symbol and meaning
	Bound       bound    = Bound::notNegative;
	double      fallback = required;
	double      most     = endless; // allowed itself
	bool        list     = false; // several numbers
};

/// Numbers by key; a single one is a list of one.
using Given = std::map<std::string, std::vector<double>>;

/// What was given to a law, read by its parameters. Throws std::invalid_argument for what is missing, out of range or
/// unknown.
class Values {
public:
	Values(std::string law, const Given& given)
	        : law(std::move(law))
	        , given(given)
	{
	}

	bool has(const std::string& key) const { return given.count(key) > 0; }
	/// A number that must be there, or its fallback.
	double number(const std::vector<Parameter>& of, const std::string& key) const;
	/// A list that must be there.
	const std::vector<double>& list(const std::vector<Parameter>& of, const std::string& key) const;
	/// Refuses keys that none of the parameters has.
	void knowAll(const std::vector<std::vector<Parameter>>& groups) const;
	/// Throws with the law's name before the text.
	[[noreturn]] void refuse(const std::string& text) const;
	/// Throws "key = value unit: it must be …" where `good` is false.
	void require(bool good, const std::string& key, double value, const std::string& what) const;

private:
	const Parameter& find(const std::vector<Parameter>& of, const std::string& key) const;
	void             check(const Parameter& parameter, double value) const;

	std::string  law;
	const Given& given;
};

/// A number as messages show it.
std::string shown(double value);

} // namespace nonsmooth::contact::slip
