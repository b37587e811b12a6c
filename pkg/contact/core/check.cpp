#include <contact/core/check.hpp>
#include <contact/core/settings.hpp>

namespace nonsmooth::contact {
namespace {

	template <class Number> void checkRange(const char* name, Number value, Number least, Number most)
	{
		if (value < least || value > most)
			refuse(name, " = ", value, ": it must be from ", least, " to ", most);
	}

	/// The value of two that has a name.
	template <class Value> Value named(const char* name, const char* first, const char* second, Value a, Value b)
	{
		const std::string given(name);
		if (given != first && given != second)
			refuse("'", given, "': it must be '", first, "' or '", second, "'");
		return given == first ? a : b;
	}

} // namespace

Method methodOf(const char* name)
{
	return named(name, "accelerated", "gaussSeidel", Method::Accelerated, Method::GaussSeidel);
}

Precision precisionOf(const char* name) { return named(name, "mixed", "double", Precision::Mixed, Precision::Double); }

void check(const SweepSettings& s)
{
	if (!(s.tolerance > 0) || !finite(s.tolerance))
		refuse("tolerance = ", s.tolerance, ": it must be positive and finite");
	if (s.maxIterations < 0) refuse("maxIterations = ", s.maxIterations, ": it must not be negative");
	checkRange("checkEvery", s.checkEvery, 1, mostCheckEvery);
	checkRange("threads", s.threads, 1, mostThreads);
}

void refuseBodies(const std::string& it, std::int32_t i, std::int32_t j, std::int32_t bodies)
{
	if (i < 0 || j < 0 || i >= bodies || j >= bodies)
		refuse(it, " names a body that is not there: there are ", bodies, ", counted from 0");
	if (i == j) refuse(it, " is one of a body with itself: it must name two");
}

} // namespace nonsmooth::contact
