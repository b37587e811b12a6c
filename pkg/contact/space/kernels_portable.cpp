#include "kernels.inc"
#include <contact/core/instruction_sets.hpp>

namespace nonsmooth::contact::space {

const std::vector<const BlockKernels*>& availableKernels()
{
	static const BlockKernels portable = kernelsOf("portable");
#ifdef NONSMOOTH_AVX
	static const auto kernels = runnable(&avx512Kernels(), &avx2Kernels(), portable);
#else
	static const auto kernels = runnable<BlockKernels>(nullptr, nullptr, portable);
#endif
	return kernels;
}

} // namespace nonsmooth::contact::space
