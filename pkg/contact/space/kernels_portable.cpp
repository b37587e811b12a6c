#include "kernels.inc"
#include <contact/core/instruction_sets.hpp>

namespace nonsmooth::contact::space {

const std::vector<const BlockKernels*>& availableKernels()
{
	static const BlockKernels portable = kernelsOf("portable");
	static const auto         kernels  = [] {
                std::vector<const BlockKernels*> found;
#ifdef NONSMOOTH_AVX
		if (runs(InstructionSet::Avx512)) found.push_back(&avx512Kernels());
		if (runs(InstructionSet::Avx2)) found.push_back(&avx2Kernels());
#endif
		found.push_back(&portable);
		return found;
	}();
	return kernels;
}

} // namespace nonsmooth::contact::space
