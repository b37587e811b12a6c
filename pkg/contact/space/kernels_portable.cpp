#include "kernels.inc"
#include <contact/block_kernels.hpp>
#include <cstring>

namespace nonsmooth::contact::space {

const std::vector<const BlockKernels*>& availableKernels()
{
	static const BlockKernels portable = kernelsOf("portable");
	static const auto         kernels  = [] {
                std::vector<const BlockKernels*> found;
#ifdef NONSMOOTH_AVX
		for (const contact::BlockKernels* plane : contact::availableKernels())
			for (const BlockKernels* own : { &avx512Kernels(), &avx2Kernels() })
				if (std::strcmp(plane->name, own->name) == 0) found.push_back(own);
#endif
		found.push_back(&portable);
		return found;
	}();
	return kernels;
}

} // namespace nonsmooth::contact::space
