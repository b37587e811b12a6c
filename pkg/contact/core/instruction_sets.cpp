#include <contact/core/instruction_sets.hpp>

namespace nonsmooth::contact {

bool runs(InstructionSet set)
{
#ifdef NONSMOOTH_AVX
	if (set == InstructionSet::Avx2) return __builtin_cpu_supports("avx2");
	// the first processors with AVX-512 slow down for it and have no VBMI2
	return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl")
	        && __builtin_cpu_supports("avx512vbmi2");
#else
	(void)set;
	return false;
#endif
}

} // namespace nonsmooth::contact
