#include "block_kernels.inc"

namespace nonsmooth::contact {

const std::vector<const BlockKernels*>& availableKernels()
{
	static const BlockKernels portable = kernelsOf("portable");
	static const auto         kernels  = [] {
                std::vector<const BlockKernels*> found;
#ifdef NONSMOOTH_AVX
		// the first processors with AVX-512 slow down for it and have no VBMI2
		if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl")
		    && __builtin_cpu_supports("avx512vbmi2"))
			found.push_back(&avx512Kernels());
		if (__builtin_cpu_supports("avx2")) found.push_back(&avx2Kernels());
#endif
		found.push_back(&portable);
		return found;
	}();
	return kernels;
}

} // namespace nonsmooth::contact
